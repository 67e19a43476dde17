// SPDX-License-Identifier: Apache-2.0
// Projects of which no scene can be made as they are: read for who can mend them, refused by who cannot, with the value
// to blame; and scenes once that value is mended.
#include "core/io/projectio.h"
#include "core/io/textfile.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "core/simulation/engine.h"
#include "core/simulation/enginethread.h"
#include "core/simulation/sceneproblem.h"
#include "tests/shared/scenes.h"

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include <chrono>
#include <functional>
#include <thread>

using namespace ps;

namespace {

constexpr const char* kRelated = "fixture.constraint";
const Address kSpacing{Owner::Solver, "", "particle_spacing"};
const Address kBoiling{Owner::Material, "water", "boiling_temperature"};

/// One thing that is wrong, and what mends it.
struct Wrong {
  const char* name;
  std::function<void(Project&)> make;
  const char* pointer;  ///< where the file has it; "" for what only building finds
  Address culprit;
  Value mended;
};

const std::vector<Wrong>& allWrongs() {
  static const std::vector<Wrong> wrongs{
      {"no room for images",
       [](Project& p) {
         p.environment.walls.clear();
         p.environment.periodic = {true, false, false};
         p.solver.parameters.values["particle_spacing"] = 1.0;
       },
       "/environment/bounds/maximum/0", kSpacing, 0.02},
      {"too many particles",
       [](Project& p) {
         std::get<BoxShape>(p.bodies[0].shape).size = {0.3, 0.3, 0.3};
         p.solver.parameters.values["particle_spacing"] = 0.0005;
       },
       "/bodies/0/shape/box/size", kSpacing, 0.03},
      {"boiling below melting", [](Project& p) { p.materials[0].properties.values["boiling_temperature"] = 200.0; },
       "/materials/0/properties/boiling_temperature", kBoiling, 373.15},
      {"a law below zero",
       [](Project& p) {
         Response law;
         law.kind = Response::Kind::Law;
         law.law = "linear";
         law.coefficients = {-5, 0, 300};
         p.materials[0].properties.values["density_liquid"] = law;
       },
       "/materials/0/properties/density_liquid",
       {Owner::Material, "water", "density_liquid"},
       Response(1000.0)},
      {"a plugin's rule",
       [](Project& p) {
         BodyConstraint constraint{kRelated, {}, {}};
         constraint.parameters.values["cold"] = 400.0;
         p.bodies[0].constraints = {constraint};
       },
       "/bodies/0/constraints/0/parameters/cold",
       {Owner::Constraint, "ice", "cold", kRelated},
       250.0},
      {"colder than anything",
       [](Project& p) {
         p.bodies[0].temperatureGradient = {0, 8000, 0};
       },
       "/bodies/0/temperature_gradient",
       {Owner::Body, "ice", "temperature"},
       1000.0},
  };
  return wrongs;
}

Project withWrong(const Wrong& wrong) {
  Project project = scenes::iceOnPlate(4, 300);
  wrong.make(project);
  return project;
}

}  // namespace

class TestMending : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    QVERIFY(m_scratch.isValid());
    QVERIFY(QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + "/fixture_constraint.so",
                        m_scratch.filePath("related_constraint.so")));
    PluginRegistry::Options options;
    options.extraPaths = {m_scratch.path().toStdString()};
    m_plugins = std::make_unique<PluginRegistry>(options);
    QVERIFY(m_plugins->constraint(kRelated));
  }

  void isReadByWhoMendsIt_data() { rows(); }
  void isReadByWhoMendsIt() {
    QFETCH(int, row);
    const Wrong& wrong = allWrongs()[static_cast<size_t>(row)];
    const QString path = m_scratch.filePath("wrong.json");
    const Project project = withWrong(wrong);
    saveProject(project, path.toStdString());
    const LoadedProject read =
        readProject(readFile(path.toStdString(), kMaximumProjectBytes), path.toStdString(), *m_plugins);
    QCOMPARE(writeProject(read.project), writeProject(project));
    QCOMPARE(read.problems.size(), *wrong.pointer ? size_t{1} : size_t{0});
    if (read.problems.empty()) return;
    QVERIFY2(read.problems[0].text.find(std::string(wrong.pointer) + ": ") != std::string::npos,
             read.problems[0].text.c_str());
    try {
      loadProject(path.toStdString(), *m_plugins);
      QFAIL("it was opened by who cannot mend it");
    } catch (const InputError& error) {
      QCOMPARE(std::string(error.what()), read.problems[0].text);
    }
  }

  void isNoSceneUntilItIsMended_data() { rows(); }
  void isNoSceneUntilItIsMended() {
    QFETCH(int, row);
    const Wrong& wrong = allWrongs()[static_cast<size_t>(row)];
    Project project = withWrong(wrong);
    try {
      const Engine engine(project, *m_plugins);
      QFAIL("a scene was made of it");
    } catch (const SceneError& error) {
      QCOMPARE(error.culprit.text(), wrong.culprit.text());
      QVERIFY(declarationOf(project, m_plugins.get(), error.culprit));
    }
    EngineThread thread(*m_plugins, {});
    thread.open(project, true);
    QTRY_VERIFY(!thread.events(0).empty());
    QVERIFY(thread.events(0).back().kind == EngineEvent::Kind::NotOpened);
    QCOMPARE(thread.events(0).back().culprit->text(), wrong.culprit.text());
    QCOMPARE(problemWith(project, m_plugins.get(), wrong.culprit, wrong.mended), std::string());
    findSet(project, wrong.culprit)->values[wrong.culprit.key] = wrong.mended;
    Engine engine(project, *m_plugins);
    QCOMPARE(engine.step().flags & static_cast<StepFlags>(StepFlag::NotFinite), 0u);
  }

  /// Of two values that are wrong each can be mended before the other.
  void twoWrongValuesAreMendedOneByOne() {
    Project project = scenes::iceOnPlate(4, 300);
    auto& values = project.materials[0].properties.values;
    const Address critical{Owner::Material, "water", "critical_temperature"};
    values["boiling_temperature"] = 200.0;
    values["critical_temperature"] = 100.0;
    QVERIFY(!problemWith(project, m_plugins.get(), kBoiling, 210.0).empty());
    for (const auto& [address, good] : {std::pair{kBoiling, 373.15}, std::pair{critical, 647.1}})
      QCOMPARE(problemWith(project, m_plugins.get(), address, good), std::string());
    values.erase("critical_temperature");
    QCOMPARE(problemWith(project, m_plugins.get(), kBoiling, 373.15), std::string());
    values.erase("boiling_temperature");
    QVERIFY(!problemWith(project, m_plugins.get(), kBoiling, 200.0).empty());
  }

  /// Whoever asks finds the refusal, though the reset before it was not shown yet when it came.
  void whatIsRefusedBehindAResetStands() {
    EngineThread thread(*m_plugins, {});
    thread.open(scenes::iceOnPlate(4, 300), true);
    QTRY_VERIFY(thread.snapshot() && thread.snapshot()->stats.frame > 3);
    thread.ask([](const Engine&) { std::this_thread::sleep_for(std::chrono::milliseconds(100)); });
    thread.reset();
    thread.setParameter(kSpacing, 1e-5);
    thread.setParameter({Owner::Solver, "", "damping"}, 0.1);
    QTRY_VERIFY(!thread.events(0).empty());
    QTest::qWait(200);
    const EngineEvent last = thread.events(0).back();
    QVERIFY(last.kind == EngineEvent::Kind::Refused);
    QCOMPARE(last.culprit->text(), kSpacing.text());
    QCOMPARE(*last.asked, Value(1e-5));
    QCOMPARE(*last.kept, Value(0.03));
  }

 private:
  static void rows() {
    QTest::addColumn<int>("row");
    for (size_t k = 0; k < allWrongs().size(); ++k) QTest::newRow(allWrongs()[k].name) << static_cast<int>(k);
  }
  QTemporaryDir m_scratch;
  std::unique_ptr<PluginRegistry> m_plugins;
};

QTEST_GUILESS_MAIN(TestMending)
#include "tst_mending.moc"
