// SPDX-License-Identifier: Apache-2.0
// Layers of particles are whole; what that makes of a body's volume is told.
#include "core/simulation/filling.h"

#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/lattice.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <random>

using namespace ps;

namespace {

Body boxOf(const char* id, const Vector3& size) {
  Body body;
  body.id = id;
  body.material = "water";
  body.shape = BoxShape{{0, 1, 0}, size};
  return body;
}

Project projectOf(const std::vector<Body>& bodies, double spacing) {
  Project project;
  project.materials.push_back({.id = "water",
                               .label = {},
                               .base = "water",
                               .properties = {},
                               .parameters = {},
                               .adheresTo = {},
                               .unknown = {}});
  project.bodies = bodies;
  project.solver.parameters.values["particle_spacing"] = spacing;
  project.environment.boundsMinimum = {-5, -5, -5};
  project.environment.boundsMaximum = {5, 5, 5};
  return project;
}

}  // namespace

class TstFilling : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void wholeLayersAreTold_data() {
    QTest::addColumn<double>("height");   // m, of a block 160 mm wide
    QTest::addColumn<double>("spacing");  // m
    QTest::addColumn<double>("share");    // filled of asked; 1: nothing is told
    QTest::newRow("whole layers") << 0.06 << 0.02 << 1.0;
    QTest::newRow("nearly whole ones") << 0.0615 << 0.02 << 1.0;
    QTest::newRow("2.5 layers are 3") << 0.05 << 0.02 << 1.2;
    QTest::newRow("3.4 layers are 3") << 0.068 << 0.02 << 3 / 3.4;
    QTest::newRow("a quarter of one is one") << 0.005 << 0.02 << 4.0;
    QTest::newRow("12.5 layers are 13") << 0.25 << 0.02 << 1.0;
  }
  void wholeLayersAreTold() {
    QFETCH(double, height);
    QFETCH(double, spacing);
    QFETCH(double, share);
    const Project project = projectOf({boxOf("film", {0.16, height, 0.16})}, spacing);
    const std::optional<Limit> limit = fillLimit(project, spacing);
    QCOMPARE(limit.has_value(), share != 1);
    if (!limit) return;
    QCOMPARE(limit->what, std::string(kFillLimit));
    QVERIFY(std::abs(limit->asked / (0.16 * 0.16 * height) - 1) < 1e-12);
    QVERIFY(std::abs(limit->delivered / limit->asked / share - 1) < 1e-12);
    QVERIFY2(limit->why.find("'film'") != std::string::npos, limit->why.c_str());
  }

  /// What is advised is below the present spacing, not below half of it, and nothing is told of it any more.
  void theAdvisedSpacingFits_data() {
    QTest::addColumn<QStringList>("sizes");
    QTest::addColumn<double>("advised");  // m; 0: none
    QTest::newRow("of a film") << QStringList{"0.16 0.05 0.16"} << 0.016;
    QTest::newRow("of a cube") << QStringList{"0.05 0.05 0.05"} << 0.05 / 3;
    QTest::newRow("of two bodies") << QStringList{"0.2 0.05 0.2", "0.1 0.1 0.06"} << 0.0125;
    QTest::newRow("thinner than the finest") << QStringList{"0.2 0.005 0.2"} << 0.0;
  }
  void theAdvisedSpacingFits() {
    QFETCH(QStringList, sizes);
    QFETCH(double, advised);
    std::vector<Body> bodies;
    for (const QString& size : sizes) {
      const QStringList edges = size.split(' ');
      bodies.push_back(boxOf("b", {edges[0].toDouble(), edges[1].toDouble(), edges[2].toDouble()}));
    }
    const Project project = projectOf(bodies, 0.02);
    const std::optional<Limit> limit = fillLimit(project, 0.02);
    QVERIFY(limit);
    QCOMPARE(QString::fromStdString(limit->use),
             advised > 0 ? QString::fromStdString(useOf("solver/particle_spacing", advised)) : QString());
    if (advised > 0) QVERIFY(!fillLimit(project, advised));
  }

  void sketchesAreCountedAsTheyAreFilled_data() {
    QTest::addColumn<double>("spacing");
    for (const double spacing : {0.02, 0.01, 0.03, 0.013, 0.027}) QTest::addRow("%g m", spacing) << spacing;
  }
  void sketchesAreCountedAsTheyAreFilled() {
    QFETCH(double, spacing);
    Body body = boxOf("sketch", {1, 1, 1});
    VoxelShape voxels;
    voxels.spacing = 0.02;
    voxels.palette.push_back({.material = "water", .temperature = 293.15, .unknown = {}});
    for (int y = -2; y < 3; ++y) voxels.runs.push_back({.x = -3 + y, .y = y, .z = 1, .length = 5, .palette = 0});
    body.shape = voxels;
    const Filling filling = fillingOf(body, spacing);
    const size_t centres = cellCentres(voxels, spacing, cellsOf(voxels, 0)).size();
    QVERIFY(std::abs(filling.asked - 25 * std::pow(0.02, 3)) < 1e-12);
    QVERIFY(std::abs(filling.filled - static_cast<double>(centres) * std::pow(spacing, 3)) < 1e-12);
  }

  /// What a box leaves out has no say in whether places are free, also across the faces of a box that repeats.
  void whatIsFarHasNoSay_data() {
    QTest::addColumn<bool>("repeats");
    QTest::newRow("open") << false;
    QTest::newRow("periodic") << true;
  }
  void whatIsFarHasNoSay() {
    QFETCH(bool, repeats);
    const Period period({0, 0, 0}, {1, 1, 1}, {repeats, false, false});
    constexpr double kClearance = 0.03;
    std::mt19937 random(7);
    const auto place = [&] { return static_cast<double>(random()) / 4294967296.0; };
    std::vector<api::Double3> asked;
    for (int k = 0; k < 400; ++k) asked.push_back({0.15 * place(), 0.4 + 0.1 * place(), 0.2 * place()});
    const NearBox near(asked, kClearance, period);
    OccupiedPlaces all(kClearance, 16, period), some(kClearance, 16, period);
    int left = 0;
    for (int k = 0; k < 20000; ++k) {
      const api::Double3 p{place(), place(), place()};
      all.add(p);
      if (near.holds({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 0}))
        some.add(p);
      else
        ++left;
    }
    QVERIFY(left > 10000);
    int free = 0;
    for (const api::Double3& p : asked) {
      QCOMPARE(some.isFree(p), all.isFree(p));
      free += all.isFree(p);
    }
    QVERIFY(free > 20 && free < 380);
  }

  /// With the worst body's name, until the scene has another spacing or shape.
  void theEngineTellsIt() {
    PluginRegistry plugins;
    Project project = projectOf({boxOf("cube", {0.1, 0.1, 0.1}), boxOf("slab", {0.3, 0.05, 0.3})}, 0.02);
    std::get<BoxShape>(project.bodies[1].shape).center = {0, 2, 0};
    Engine engine(project, plugins);
    const auto told = [&]() -> std::string {
      const std::vector<Limit> limits = engine.limits();
      const auto found =
          std::find_if(limits.begin(), limits.end(), [](const Limit& l) { return l.what == kFillLimit; });
      return found == limits.end() ? "" : found->why;
    };
    QCOMPARE(told(), std::string("whole layers of particles make 'slab' 20 % more than its shape"));
    engine.step();
    QVERIFY(!told().empty());
    // Acts at the next reset, and so it is told until then.
    (void)engine.setParameter({Owner::Solver, "", "particle_spacing"}, 0.01);
    QVERIFY(!told().empty());
    engine.reset();
    QCOMPARE(told(), std::string());
  }
};

QTEST_APPLESS_MAIN(TstFilling)
#include "tst_filling.moc"
