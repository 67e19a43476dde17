// SPDX-License-Identifier: Apache-2.0
// Matter in and around walls that are cylinders and spheres: liquid at rest and in flow, what
// slides and strikes.
#include "curvedscene.h"
#include "onehash.h"
#include "rigidscene.h"

#include <QTest>

#include <numbers>

using namespace mechanics;
using curvedwalls::curved;
using curvedwalls::rings;
using ps::Solver;
using ps::SolverSettings;
using ps::Vector3;
using ps::vectorOf;
using ps::Wall;
using ps::WallForm;

namespace {

constexpr double kPi = std::numbers::pi, kGravity = 9.81, kSpacing = 0.02;

/// A floor at the height y.
Wall floorAt(double y) {
  Wall wall;
  wall.offset = y;
  wall.friction = 0;
  return wall;
}

/// Cells of a lattice within a box that a particle may stand in before all walls.
std::vector<ps::api::Double3> filled(const std::vector<Wall>& walls, const Vector3& low, const Vector3& high) {
  std::vector<ps::api::Double3> points;
  for (double y = low.y() + kSpacing / 2; y < high.y(); y += kSpacing) {
    for (double z = low.z() + kSpacing / 2; z < high.z(); z += kSpacing) {
      for (double x = low.x() + kSpacing / 2; x < high.x(); x += kSpacing) {
        const ps::api::Double3 place{x, y, z};
        if (std::all_of(walls.begin(), walls.end(),
                        [&](const Wall& wall) { return heightOver(wall, place) > 0.45 * kSpacing; }))
          points.push_back(place);
      }
    }
  }
  return points;
}

/// m, of the particle that is deepest in a wall; -0.5 spacings where it just touches one.
double deepest(const Solver& solver, const std::vector<Wall>& walls) {
  double most = -1;
  for (size_t i = 0; i < solver.particles().size(); ++i) {
    for (const Wall& wall : walls) most = std::max(most, -heightOver(wall, solver.particles().position()[i]));
  }
  return most;
}

/// m, height of the middle of a liquid of that volume in m3 that lies still before all walls.
double middleOf(const std::vector<Wall>& walls, double volume) {
  constexpr double kCell = kSpacing / 4, kHalf = 0.26;
  double sum = 0, filled = 0;
  for (double y = -0.1 + kCell / 2; filled < volume; y += kCell) {
    double layer = 0;
    for (double x = -kHalf + kCell / 2; x < kHalf; x += kCell) {
      for (double z = -kHalf + kCell / 2; z < kHalf; z += kCell) {
        const ps::api::Double3 place{x, y, z};
        const bool before =
            std::all_of(walls.begin(), walls.end(), [&](const Wall& wall) { return heightOver(wall, place) > 0; });
        layer += before ? kCell * kCell * kCell : 0;
      }
    }
    layer = std::min(layer, volume - filled);
    filled += layer;
    sum += y * layer;
  }
  return sum / volume;
}

/// s, mean period of what swings about x = 0, from its crossings there while a scene runs.
template <class Place>
double periodOf(Solver& solver, const SolverSettings& settings, int frames, const Place& place) {
  double before = place(), first = -1, last = -1;
  int count = 0;
  for (int f = 1; f <= frames; ++f) {
    if (!run(solver, 1)) return -1;
    const double now = place();
    if (before * now < 0) {
      last = settings.dt * (f - now / (now - before));
      if (first < 0) first = last;
      ++count;
    }
    before = now;
  }
  return count > 1 ? 2 * (last - first) / (count - 1) : -1;
}

}  // namespace

class TestCurvedWalls : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { ps::setThreadCount(2); }
  void cleanup() { ps::setInstructionSet(""); }

  void waterRests_data() {
    QTest::addColumn<QString>("vessel");
    for (const char* vessel : {"tray", "glass", "bowl", "around a pillar", "over a ball"})
      QTest::newRow(vessel) << QString::fromLatin1(vessel);
  }
  /// Nothing leaks, it comes to rest, is nowhere too dense, lies as high as its volume says, and the walls carry its
  /// weight. The tray is what planes do.
  void waterRests() {
    QFETCH(QString, vessel);
    std::vector<Wall> walls = tray(0.4);
    if (vessel == QStringLiteral("glass")) walls = {floorAt(0), curved(WallForm::Cylinder, 0.2)};
    if (vessel == QStringLiteral("bowl")) walls = {curved(WallForm::Sphere, 0.25)}, walls[0].centre = {0, 0.25, 0};
    if (vessel == QStringLiteral("around a pillar")) walls.push_back(curved(WallForm::Cylinder, 0.08, false));
    if (vessel == QStringLiteral("over a ball")) walls.push_back(curved(WallForm::Sphere, 0.1, false));
    Solver solver;
    prepare(solver, settingsOf(kSpacing));
    solver.setWalls(walls);
    const std::vector<uint32_t> watched{0, 1, 2, 3, 4, 5};
    solver.watchForces(std::span(watched).first(walls.size()), {});
    solver.spawn(liquid(filled(walls, {-0.26, 0, -0.26}, {0.26, 0.2, 0.26})));
    QVERIFY(run(solver, 240));
    double error = 0, most = 0, force = 0;
    constexpr int kFrames = 30;
    for (int f = 0; f < kFrames; ++f) {
      const ps::StepReport report = solver.step();
      error = std::max(error, report.densityErrorMean);
      most = std::max(most, report.densityErrorMax);
      for (size_t w = 0; w < walls.size(); ++w) force += solver.forceOnWall(w)->force.y() / kFrames;
    }
    const Motion motion = motionOf(solver, 0);
    const ps::ParticleStore& p = solver.particles();
    double weight = 0, height = 0;
    for (size_t i = 0; i < p.size(); ++i) {
      weight += kGravity * double{p.mass()[i]};
      height += double{p.position()[i].y} / static_cast<double>(p.size());
    }
    const double expected = middleOf(walls, weight / kGravity / 998);
    qInfo("%s: error %.4f, most %.4f, rms %.4f, weight %.4f, middle %.4f of %.4f", qPrintable(vessel), error, most,
          motion.rms, -force / weight, height, expected);
    QVERIFY(deepest(solver, walls) < -0.5 * kSpacing + 1e-6);
    QVERIFY(error < 0.015);
    QVERIFY(motion.rms < 0.02);
    QVERIFY(std::abs(force / weight + 1) < 0.02);
    QVERIFY(most < 0.06);
    QVERIFY(std::abs(height / expected - 1) < 0.03);  // as the level in a tray: tst_mechanics
  }

  void slidesWithThePeriodOfItsCurve_data() {
    QTest::addColumn<int>("form");
    QTest::newRow("in a trough") << static_cast<int>(WallForm::Cylinder);
    QTest::newRow("in a bowl") << static_cast<int>(WallForm::Sphere);
  }
  /// A single particle without friction: 2 pi sqrt(L/g) with L from the middle to its centre, and T = T0 (1 + a2/16)
  /// for a swing of a = 0.2.
  void slidesWithThePeriodOfItsCurve() {
    QFETCH(int, form);
    const double radius = 0.5, length = radius - kSpacing / 2, swing = 0.2;
    Wall wall = curved(static_cast<WallForm>(form), radius);
    wall.normal = {0, 0, 1};
    wall.centre = {0, radius, 0};
    Solver solver;
    const SolverSettings settings = settingsOf(kSpacing);
    prepare(solver, settings);
    solver.setWalls({wall});
    ps::Spawn grain = ice({{length * std::sin(swing), radius - length * std::cos(swing), 0}}, 0);
    grain.constraintSets.clear();
    solver.spawn(grain);
    const double period = periodOf(solver, settings, 600, [&] { return double{solver.particles().position()[0].x}; });
    const double expected = 2 * kPi * std::sqrt(length / kGravity) * (1 + swing * swing / 16);
    qInfo("%.5f s for %.5f, height over the wall %.5f spacings", period, expected,
          heightOver(wall, solver.particles().position()[0]) / kSpacing);
    QVERIFY(std::abs(period / expected - 1) < 0.005);
    QVERIFY(std::abs(heightOver(wall, solver.particles().position()[0]) / kSpacing - 0.5) < 1e-3);
  }

  void frictionBrakesOnACurve_data() {
    QTest::addColumn<double>("friction");
    QTest::newRow("none") << 0.0;
    QTest::newRow("ice on steel") << 0.02;
  }
  /// Each half of a swing is 2 mu less wide (Coulomb), and 2 % of that more, since what moves presses harder: the mean
  /// of a^2 - t^2/2 over a swing of a = 0.2. Without friction none of it is lost.
  void frictionBrakesOnACurve() {
    QFETCH(double, friction);
    const double radius = 0.5, length = radius - kSpacing / 2, swing = 0.2;
    Wall wall = curved(WallForm::Cylinder, radius);
    wall.normal = {0, 0, 1};
    wall.centre = {0, radius, 0};
    wall.friction = friction;
    Solver solver;
    prepare(solver, settingsOf(kSpacing));
    solver.setWalls({wall});
    ps::Spawn grain = ice({{length * std::sin(swing), radius - length * std::cos(swing), 0}}, 0);
    grain.constraintSets.clear();
    solver.spawn(grain);
    double least = swing;
    for (int f = 0; f < 55; ++f) {  // a half is 42
      QVERIFY(run(solver, 1));
      least = std::min(least, std::asin(double{solver.particles().position()[0].x} / length));
    }
    QVERIFY2(std::abs(swing + least - 2.04 * friction) < 1e-3, qPrintable(QString::number(swing + least)));
  }

  /// A rigid block without friction in a bowl turns about its middle, as a pendulum: 2 pi sqrt(I/(m g l)).
  void aBlockSwingsAsAPendulum() {
    const double radius = 0.5;
    Wall wall = curved(WallForm::Sphere, radius);
    wall.centre = {0, radius, 0};
    Solver solver;
    const SolverSettings settings = settingsOf(kSpacing);
    ps::Material slippery = water(1000, 1000);
    slippery.properties["friction_static"] = slippery.properties["friction_kinetic"] = 0.0;
    slippery.properties["restitution"] = 0.0;
    prepare(solver, settings, slippery);
    solver.setWalls({wall});
    // Four corners touch it: 5 spacings apart, of a centre that far off the middle.
    const double half = 2.5 * kSpacing,
                 away = std::sqrt((radius - kSpacing / 2) * (radius - kSpacing / 2) - 2 * half * half);
    std::vector<ps::api::Double3> points = lattice(6, 4, 6, kSpacing, radius - away - kSpacing / 2);
    const double swing = 0.1;
    const Eigen::AngleAxisd turn(swing, Vector3(0, 0, 1));
    for (ps::api::Double3& p : points) {
      const Vector3 from = vectorOf(p) - vectorOf(wall.centre);
      p = ps::double3Of(vectorOf(wall.centre) + Vector3(turn * from));
    }
    static const ps::constraint::RigidModel model;
    ps::Spawn block = ice(points, solver.addConstraintSet(&model, "rigid", rigid::rigidParameters()));
    solver.spawn(block);
    const rigid::Sums sums = rigid::sumsOf(solver);
    const double arm = (sums.centre - vectorOf(wall.centre)).norm();
    const double inertia = sums.inertia(2, 2) + sums.mass * arm * arm;
    const double expected = 2 * kPi * std::sqrt(inertia / (sums.mass * kGravity * arm)) * (1 + swing * swing / 16);
    const double period = periodOf(solver, settings, 600, [&] { return rigid::sumsOf(solver).centre.x(); });
    qInfo("%.5f s for %.5f, deepest %.4f spacings", period, expected, deepest(solver, {wall}) / kSpacing);
    QVERIFY(std::abs(period / expected - 1) < 0.01);
    QVERIFY(deepest(solver, {wall}) < -0.4 * kSpacing);
  }

  /// Fast grains stay within a vessel and do not pass a pillar; they come back with their restitution.
  void nothingPasses_data() {
    QTest::addColumn<int>("form");
    QTest::addColumn<bool>("inside");
    QTest::addColumn<double>("speed");
    for (const double speed : {2.0, 20.0, 200.0}) {
      QTest::addRow("in a pipe at %g m/s", speed) << static_cast<int>(WallForm::Cylinder) << true << speed;
      QTest::addRow("in a ball at %g m/s", speed) << static_cast<int>(WallForm::Sphere) << true << speed;
      QTest::addRow("at a pillar at %g m/s", speed) << static_cast<int>(WallForm::Cylinder) << false << speed;
      QTest::addRow("at a ball at %g m/s", speed) << static_cast<int>(WallForm::Sphere) << false << speed;
    }
  }
  void nothingPasses() {
    QFETCH(int, form);
    QFETCH(bool, inside);
    QFETCH(double, speed);
    const Wall wall = curved(static_cast<WallForm>(form), 0.1, inside);
    for (const bool isLiquid : {false, true}) {
      Solver solver;
      SolverSettings settings = settingsOf(kSpacing);
      settings.gravity = {0, 0, 0};
      ps::Material matter = water(1000, 1000);
      matter.properties["restitution"] = 0.8;
      prepare(solver, settings, matter);
      solver.setWalls({wall});
      std::vector<ps::api::Double3> points;
      for (int k = 0; k < 5; ++k) points.push_back({inside ? 0.03 : -0.3, 0.03 * (k - 2), 0.013});
      ps::Spawn grains = isLiquid ? liquid(points) : ice(points, 0);
      grains.constraintSets.clear();
      grains.velocity.assign(points.size(), {speed, 0, 0});
      solver.spawn(grains);
      double farthest = -1;
      for (int f = 0; f < (speed < 10 ? 20 : 1); ++f) {
        QVERIFY(run(solver, 1));
        farthest = std::max(farthest, deepest(solver, {wall}));
      }
      QVERIFY2(farthest < -0.5 * kSpacing + 1e-5, qPrintable(QString::number(farthest)));
      const ps::api::Float4 middle = solver.particles().position()[solver.particles().indexOf(2)];
      if (!inside) QVERIFY2(middle.x < 0, qPrintable(QStringLiteral("%1 %2").arg(isLiquid).arg(double(middle.x))));
    }
  }

  /// Dropped at the bottom of a bowl it comes back as from a plane, to e2 of its height but for what substeps leave.
  void bouncesOffABowl() {
    double tops[2] = {0, 0};
    for (const bool isBowl : {false, true}) {
      Wall wall = isBowl ? curved(WallForm::Sphere, 0.5) : floorAt(0);
      wall.centre = {0, 0.5, 0};
      Solver solver;
      ps::Material matter = water(1000, 1000);
      matter.properties["restitution"] = 0.8;
      prepare(solver, settingsOf(kSpacing), matter);
      solver.setWalls({wall});
      ps::Spawn grain = ice({{0, 0.2 + kSpacing / 2, 0}}, 0);
      grain.constraintSets.clear();
      solver.spawn(grain);
      bool met = false;
      for (int f = 0; f < 32; ++f) {  // 0.2 s down, and 0.16 s up again
        QVERIFY(run(solver, 1));
        met = met || solver.particles().velocity()[0].y > 0.1f;
        if (met) tops[isBowl] = std::max(tops[isBowl], double{solver.particles().position()[0].y} - kSpacing / 2);
      }
    }
    QVERIFY2(std::abs(tops[1] / tops[0] - 1) < 1e-3, qPrintable(QString::number(tops[1] / tops[0])));
    QVERIFY2(std::abs(tops[1] / (0.64 * 0.2) - 1) < 0.1, qPrintable(QString::number(tops[1])));
  }

  /// Hagen and Poiseuille: what clings to an endless pipe flows by rho g R2/(8 mu) on average, and keeps within it.
  void syrupFlowsThroughAPipe() {
    constexpr double kRadius = 0.1, kViscosity = 10, kPull = 1;
    Wall pipe = curved(WallForm::Cylinder, kRadius);
    pipe.normal = {0, 0, 1};
    Solver solver;
    SolverSettings settings = settingsOf(kSpacing);
    settings.gravity = {0, 0, kPull};
    settings.viscosityModel = ps::ViscosityModel::Implicit;
    ps::Material syrup = water(1000, 1000);
    syrup.properties["melting_temperature"] = syrup.properties["boiling_temperature"] = 0.0;
    syrup.properties["viscosity"] = kViscosity;
    prepare(solver, settings, syrup);
    ps::Bounds bounds;
    bounds.minimum = {-0.2, -0.2, -0.1}, bounds.maximum = {0.2, 0.2, 0.1};
    bounds.periodic = {false, false, true};
    solver.setBounds(bounds);
    solver.setWalls({pipe});
    solver.spawn(liquid(rings(0, 5, 10, kSpacing, -0.1)));
    QVERIFY(run(solver, 60));
    double mean = 0;
    for (size_t i = 0; i < solver.particles().size(); ++i)
      mean += double{solver.particles().velocity()[i].z} / static_cast<double>(solver.particles().size());
    const double expected = 1000 * kPull * kRadius * kRadius / (8 * kViscosity);
    qInfo("%.4f of the flow, deepest %.3f spacings", mean / expected, deepest(solver, {pipe}) / kSpacing);
    QVERIFY(std::abs(mean / expected - 1) < 0.1);
    QVERIFY(deepest(solver, {pipe}) < -0.5 * kSpacing + 1e-6);
  }

  void theSameOnAllThreads_data() { onehash::addRows(); }
  void theSameOnAllThreads() {
    onehash::verify([]() -> uint64_t {
      Solver solver;
      prepare(solver, settingsOf(kSpacing));
      std::vector<Wall> walls{floorAt(-0.1), curved(WallForm::Cylinder, 0.2), curved(WallForm::Sphere, 0.08, false)};
      solver.setWalls(walls);
      static const ps::constraint::RigidModel model;
      const uint32_t set = solver.addConstraintSet(&model, "rigid", rigid::rigidParameters());
      solver.spawn(liquid(filled(walls, {-0.2, -0.1, -0.2}, {0.2, 0.1, 0.2})));
      solver.spawn(ice(lattice(4, 3, 4, kSpacing, 0.15), set));
      return run(solver, 40) ? solver.stateHash() : 0;
    });
  }
};

QTEST_APPLESS_MAIN(TestCurvedWalls)
#include "tst_curvedwalls.moc"
