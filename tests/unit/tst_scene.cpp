// SPDX-License-Identifier: Apache-2.0
#include "core/scene/project.h"
#include "tests/shared/scenes.h"

#include <QTest>

#include <cmath>
#include <limits>
#include <set>

using namespace ps;

class TestScene : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void declarationsAreSound_data();
  void declarationsAreSound();
  void wrongValuesAreExplained_data();
  void wrongValuesAreExplained();
  void addressesReadBack_data();
  void addressesReadBack();
  void brokenAddressesAreRefused_data();
  void brokenAddressesAreRefused();
  void addressesFindTheirSet();
  void absentValuesAreDefaults();
};

namespace {

const char* text(const std::string& s) { return s.c_str(); }

Project scene() {
  Project project;
  project.solver.thermalModel = "enthalpy";
  project.materials.push_back(scenes::water());
  project.bodies.push_back(scenes::block("ice", 3, 0.02, {0, 0.1, 0}, 260));
  project.environment = scenes::tray(0.2, 0.5);
  return project;
}

}  // namespace

void TestScene::declarationsAreSound_data() {
  QTest::addColumn<int>("list");
  QTest::newRow("environment") << 0;
  QTest::newRow("solver") << 1;
  QTest::newRow("wall") << 2;
  QTest::newRow("body") << 3;
}

void TestScene::declarationsAreSound() {
  QFETCH(int, list);
  const api::ParameterList lists[] = {environmentParameters(), solverParameters(), wallParameters(), bodyParameters()};
  std::set<std::string> keys;
  QVERIFY(lists[list].count > 0);
  for (size_t i = 0; i < lists[list].count; ++i) {
    const api::ParameterDeclaration& d = lists[list][i];
    QVERIFY2(keys.insert(d.key).second, d.key);
    QVERIFY2(*d.label && *d.help && *d.example && *d.group, d.key);
    QVERIFY2(d.hardMinimum <= d.minimum && d.minimum < d.maximum && d.maximum <= d.hardMaximum, d.key);
    QVERIFY2(d.defaultValue >= d.minimum && d.defaultValue <= d.maximum, d.key);
    QVERIFY2(d.scale == api::Scale::Linear || d.minimum > 0, d.key);  // a logarithmic slider cannot begin at 0
    QVERIFY2((d.kind == api::ParameterKind::Choice) == !choicesOf(d).empty(), d.key);
    QVERIFY2(d.displayScale != 0, d.key);
    if (keys.contains("particle_spacing")) QVERIFY(findDeclaration(lists[list], "particle_spacing")->minimum <= 0.001);
    QCOMPARE(text(problemOf(valueOf({}, d), d)), "");
    QVERIFY2(!problemOf(Value(Response(0.5)), d).empty() || d.kind == api::ParameterKind::Response, d.key);
  }
}

void TestScene::wrongValuesAreExplained_data() {
  QTest::addColumn<double>("value");
  QTest::addColumn<QString>("key");
  QTest::addColumn<QString>("problem");
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  QTest::newRow("fine") << 0.02 << "particle_spacing"
                        << "";
  QTest::newRow("too small") << -0.02 << "particle_spacing"
                             << "must be at least 0.0005 m, not −0.02";
  QTest::newRow("too large") << 50.0 << "particle_spacing"
                             << "must be at most 10 m, not 50";
  QTest::newRow("NaN") << nan << "particle_spacing"
                       << "must be a finite number, not NaN";
  QTest::newRow("infinite") << infinity << "particle_spacing"
                            << "must be a finite number, not inf";
  QTest::newRow("half a step") << 2.5 << "substeps"
                               << "must be a whole number, not 2.5";
  QTest::newRow("number for a name") << 1.0 << "kernel"
                                     << "must be one of cubic_spline, wendland_c2";
  QTest::newRow("number for a switch") << 1.0 << "moment_correction"
                                       << "must be true or false";
}

void TestScene::wrongValuesAreExplained() {
  QFETCH(double, value);
  QFETCH(QString, key);
  QFETCH(QString, problem);
  const auto* declaration = findDeclaration(solverParameters(), key.toStdString());
  QVERIFY(declaration);
  QCOMPARE(QString::fromStdString(problemOf(Value(value), *declaration)), problem);
}

void TestScene::addressesReadBack_data() {
  QTest::addColumn<QString>("address");
  for (const char* address :
       {"material/water/conductivity_solid", "wall/floor/temperature", "environment/ambient_pressure",
        "solver/substeps", "thermal/undercooling", "body/ice/temperature", "constraint/ice/bonds/stiffness"}) {
    QTest::newRow(address) << address;
  }
}

void TestScene::addressesReadBack() {
  QFETCH(QString, address);
  const auto parsed = Address::parse(address.toStdString());
  QVERIFY(parsed);
  QCOMPARE(QString::fromStdString(parsed->text()), address);
}

void TestScene::brokenAddressesAreRefused_data() {
  QTest::addColumn<QString>("address");
  for (const char* address : {"", "/", "solver", "solver/", "solver/a/b", "wall/temperature", "wall//temperature",
                              "constraint/ice/bonds", "planet/earth/mass", "material/water/a/b"}) {
    QTest::newRow(*address ? address : "empty") << address;
  }
}

void TestScene::brokenAddressesAreRefused() {
  QFETCH(QString, address);
  QVERIFY(!Address::parse(address.toStdString()));
}

void TestScene::addressesFindTheirSet() {
  Project project = scene();
  const auto set = [&](const char* address) { return findSet(project, *Address::parse(address)); };
  QCOMPARE(set("environment/ambient_pressure"), &project.environment.parameters);
  QCOMPARE(set("solver/substeps"), &project.solver.parameters);
  QCOMPARE(set("thermal/undercooling"), &project.solver.thermalParameters);
  QCOMPARE(set("material/water/conductivity_solid"), &project.materials[0].properties);
  QCOMPARE(set("material/water/salt"), &project.materials[0].parameters);
  QCOMPARE(set("wall/lid/temperature"), &project.environment.walls[1].parameters);
  QCOMPARE(set("body/ice/temperature"), &project.bodies[0].parameters);
  QCOMPARE(set("constraint/ice/bonds/stiffness"), &project.bodies[0].constraints[0].parameters);
  QCOMPARE(set("wall/ceiling/temperature"), nullptr);
  QCOMPARE(set("material/wax/density_solid"), nullptr);
  QCOMPARE(set("constraint/ice/cloth/stiffness"), nullptr);
}

void TestScene::absentValuesAreDefaults() {
  ParameterSet set;
  QCOMPARE(numberOf(set, solverParameters(), "substeps"), 4.0);
  QCOMPARE(text(choiceOf(set, solverParameters(), "density_solver")), "chebyshev");
  QVERIFY(toggleOf(set, solverParameters(), "moment_correction"));
  set.values["substeps"] = 7.0;
  set.values["density_solver"] = std::string("jacobi");
  set.values["moment_correction"] = false;
  const std::vector<double> numbers = numbersOf(set, solverParameters());
  QCOMPARE(numbers.size(), solverParameters().count);
  for (size_t i = 0; i < numbers.size(); ++i) {
    const std::string key = solverParameters()[i].key;
    const double expected = key == "substeps" ? 7
                            : key == "density_solver" || key == "moment_correction"
                                ? 0
                                : solverParameters()[i].defaultValue;
    QCOMPARE(numbers[i], expected);
  }
}

QTEST_APPLESS_MAIN(TestScene)
#include "tst_scene.moc"
