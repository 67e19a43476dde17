// SPDX-License-Identifier: Apache-2.0
// Swept collision, restitution and friction of particles that belong to no rigid body.
#include "core/solver/contact/solidcontact.h"
#include "softscene.h"

#include <QTest>

#include <array>
#include <numbers>

using namespace mechanics;
using ps::Solver;
using ps::SolverSettings;
using ps::api::Double3;

namespace {

constexpr double kSize = 0.05, kFrame = 1.0 / 60, kGravity = 9.81;

/// Ice as hard matter: neither melts in these scenes.
ps::Material grain(double restitution, double resting = 0.3, double sliding = 0.2) {
  ps::Material m = water();
  m.properties["restitution"] = restitution;
  m.properties["friction_static"] = resting;
  m.properties["friction_kinetic"] = sliding;
  return m;
}

ps::Spawn solids(std::vector<Double3> points, Double3 velocity = {0, 0, 0}) {
  ps::Spawn spawn = liquid(std::move(points), 263.15);
  spawn.phase = ps::api::Phase::Solid;
  spawn.velocity.assign(spawn.position.size(), velocity);
  return spawn;
}

SolverSettings weightless(double spacing, int substeps = 4) {
  SolverSettings settings = settingsOf(spacing);
  settings.gravity = {0, 0, 0};
  settings.substeps = substeps;
  return settings;
}

void prepareWide(Solver& solver, const SolverSettings& settings, const ps::Material& material) {
  prepare(solver, settings, material);
  ps::Bounds bounds;
  bounds.minimum = {-50, -50, -50};
  bounds.maximum = {50, 50, 50};
  solver.setBounds(bounds);
}

/// Where particle `id` is, and its velocity, in double precision.
Double3 positionOf(const Solver& solver, uint32_t id) {
  const ps::api::Float4 p = solver.particles().position()[solver.particles().indexOf(id)];
  return {p.x, p.y, p.z};
}
Double3 velocityOf(const Solver& solver, uint32_t id) {
  const ps::api::Float4 v = solver.particles().velocity()[solver.particles().indexOf(id)];
  return {v.x, v.y, v.z};
}

/// Case l3's wall: 21 x 21 static particles in the plane x = 0, around the origin.
std::vector<Double3> sheet() {
  std::vector<Double3> points;
  for (int y = -10; y <= 10; ++y) {
    for (int z = -10; z <= 10; ++z) points.push_back({0, y * kSize, z * kSize});
  }
  return points;
}

ps::Wall slope(double lean, double friction) {
  ps::Wall wall;
  wall.normal = {std::sin(lean), std::cos(lean), 0};
  wall.friction = friction;
  return wall;
}

}  // namespace

class TestImpacts : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { ps::setThreadCount(2); }
  void cleanup() { ps::setInstructionSet(""); }

  /// Case l3, with liquid too. Solids meet the wall as spheres of 0.955 d, so that centres come no nearer than the
  /// case's 0.05 d of tolerance allow, to rounding; liquid stops at 0.75 d, at which the largest opening is closed.
  void nothingPassesALayer_data() {
    QTest::addColumn<double>("speed");  // d/dt
    QTest::addColumn<double>("lean");   // degrees
    QTest::addColumn<bool>("hole");
    QTest::addColumn<bool>("solid");
    for (const double speed : {0.5, 1.0, 2.0, 5.0, 10.0, 100.0}) {
      for (const double lean : {0.0, 30.0}) {
        for (const bool hole : {false, true}) {
          for (const bool solid : {true, false})
            QTest::addRow("%g d/dt, %g degrees, %s, %s", speed, lean, hole ? "hole" : "centre",
                          solid ? "solid" : "liquid")
                << speed << lean << hole << solid;
        }
      }
    }
  }
  void nothingPassesALayer() {
    QFETCH(double, speed);
    QFETCH(double, lean);
    QFETCH(bool, hole);
    QFETCH(bool, solid);
    const double angle = lean * std::numbers::pi / 180, v = speed * kSize / kFrame;
    const Double3 aim{0, hole ? kSize / 2 : 0, hole ? kSize / 2 : 0};
    const Double3 start{-std::cos(angle), aim.y - std::sin(angle), aim.z};  // 1 m away
    Solver solver;
    prepareWide(solver, weightless(kSize, 1), grain(0));
    solver.spawn(fixedPoints(sheet()));
    ps::Spawn shot = solid ? solids({start}) : liquid({start});
    shot.velocity = {{v * std::cos(angle), v * std::sin(angle), 0}};
    const uint32_t id = solver.spawn(shot)[0];
    double nearest = 1e30;
    const int frames = static_cast<int>(std::ceil(1 / v / kFrame)) + 3;
    for (int f = 0; f < frames; ++f) {
      QCOMPARE(solver.step().flags, 0u);
      const Double3 p = positionOf(solver, id);
      QVERIFY2(p.x < 0, qPrintable(QString("frame %1: x = %2 m").arg(f).arg(p.x)));
      for (const Double3& w : sheet())
        nearest = std::min(nearest, std::hypot(std::hypot(p.x - w.x, p.y - w.y), p.z - w.z));
      if (nearest < 1.3 * kSize && std::abs(p.y) > 9 * kSize) break;  // slides off
    }
    const double expected = (solid ? ps::kContactDiameter : 0.75) * kSize;
    QVERIFY2(nearest > expected - 1e-6, qPrintable(QString::number(nearest / kSize)));
    QVERIFY2(nearest < 1.3 * kSize, qPrintable(QString::number(nearest / kSize)));
  }

  /// Case l4.
  void pairsMeetHeadOn_data() {
    QTest::addColumn<double>("speed");  // d/dt
    QTest::addColumn<double>("restitution");
    QTest::addColumn<int>("substeps");
    for (const double speed : {1.0, 10.0, 100.0}) {
      for (const double restitution : {0.0, 0.5, 1.0}) {
        for (const int substeps : {1, 4})
          QTest::addRow("%g d/dt, e = %g, %d substeps", speed, restitution, substeps)
              << speed << restitution << substeps;
      }
    }
  }
  void pairsMeetHeadOn() {
    QFETCH(double, speed);
    QFETCH(double, restitution);
    QFETCH(int, substeps);
    const double v = speed * kSize / kFrame;
    Solver solver;
    prepareWide(solver, weightless(kSize, substeps), grain(restitution));
    ps::Spawn pair = solids({{-0.5, 0.1, 0.2}, {0.52, 0.1, 0.2}});
    pair.velocity = {{v, 0, 0}, {-v, 0, 0}};
    const std::vector<uint32_t> id = solver.spawn(pair);
    const int frames = static_cast<int>(std::ceil(0.51 / v / kFrame)) + 2;
    for (int f = 0; f < frames; ++f) {
      QCOMPARE(solver.step().flags, 0u);
      QVERIFY(positionOf(solver, id[0]).x < positionOf(solver, id[1]).x);
    }
    const double a = velocityOf(solver, id[0]).x, b = velocityOf(solver, id[1]).x;
    qInfo("velocities %.6f, %.6f of %.3f m/s, sum %.1e of them", a, b, v, (a + b) / (2 * v));
    QVERIFY(std::abs(a + restitution * v) < 0.02 * v);
    QVERIFY(std::abs(b - restitution * v) < 0.02 * v);
    // Impulses are equal and opposite in double; each velocity then rounds to 6e-8 of itself, and follows from
    // positions that do: 1e-12 holds of the impulses, not of a state in single precision.
    QVERIFY(std::abs(a + b) < 2e-5 * v);
  }

  /// Unequal masses, off the line of centres, one at rest: the common centre goes on, the energy stays with e = 1.
  void pairsOfUnequalMassKeepMomentum() {
    ps::Material heavy = grain(1), light = grain(1);
    heavy.id = "heavy";
    heavy.properties["density_solid"] = 3000.0;
    for (ps::Material* m : {&heavy, &light}) m->properties["friction_static"] = m->properties["friction_kinetic"] = 0.0;
    Solver solver;
    prepareWide(solver, weightless(kSize), light);
    solver.setMaterials({ps::BakedMaterial(light, 101325), ps::BakedMaterial(heavy, 101325)});
    const uint32_t a = solver.spawn(solids({{-0.6, 0.02, 0}}, {40, 0, 0}))[0];
    ps::Spawn target = solids({{0, 0, 0}});
    target.material = 1;
    const uint32_t b = solver.spawn(target)[0];
    for (int f = 0; f < 4; ++f) QCOMPARE(solver.step().flags, 0u);
    const double ma = 917, mb = 3000;
    const Double3 va = velocityOf(solver, a), vb = velocityOf(solver, b);
    QVERIFY(vb.x > 1 && vb.y < -0.1);
    QVERIFY(std::abs((ma * va.x + mb * vb.x) / (ma * 40) - 1) < 1e-4);
    QVERIFY(std::abs(ma * va.y + mb * vb.y) / (ma * 40) < 1e-4);
    const auto square = [](const Double3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; };
    QVERIFY(std::abs((ma * square(va) + mb * square(vb)) / (ma * 1600) - 1) < 0.02);
  }

  /// A fast grain does not hit what lies behind the one that it hits.
  void whatIsHiddenIsNotHit() {
    Solver solver;
    prepareWide(solver, weightless(kSize, 1), grain(1));
    const std::vector<uint32_t> row = solver.spawn(solids({{0, 0, 0}, {0.2, 0, 0}}));
    const uint32_t shot = solver.spawn(solids({{-0.5, 0, 0}}, {60, 0, 0}))[0];  // 1 m in a substep
    QCOMPARE(solver.step().flags, 0u);
    QVERIFY(std::abs(velocityOf(solver, shot).x) < 0.02 * 60);
    QVERIFY(std::abs(velocityOf(solver, row[0]).x - 60) < 0.02 * 60);
    QCOMPARE(velocityOf(solver, row[1]).x, 0.0);
  }

  /// A plate of particles that moves faster than its own thickness in a substep sweeps liquid before it: none leaks.
  void movingPlatesStopLiquid_data() {
    QTest::addColumn<double>("speed");  // m/s
    QTest::newRow("4.5 m/s") << 4.5;
    QTest::newRow("15 m/s") << 15.0;
    QTest::newRow("60 m/s, 12 d a substep") << 60.0;
  }
  void movingPlatesStopLiquid() {
    QFETCH(double, speed);
    Solver solver;
    SolverSettings settings = settingsOf(0.02);
    prepareWide(solver, settings, water());
    std::vector<ps::Wall> walls = tray(0.2);
    walls.erase(walls.begin());
    solver.setWalls(walls);
    ps::Spawn plate = fixedPoints(lattice(10, 1, 10, 0.02, -0.01));
    plate.velocity.assign(plate.position.size(), {0, speed, 0});
    plate.body = 1;
    solver.spawn(plate);
    solver.spawn(liquid(lattice(10, 3, 10, 0.02, 0.02)));
    for (int f = 0; f < 20; ++f) {
      QCOMPARE(solver.step().flags, 0u);
      double height = 0;
      const ps::ParticleStore& p = solver.particles();
      for (size_t i = 0; i < p.size(); ++i) {
        if (p.body()[i] == 1) height = double{p.position()[i].y};
      }
      QVERIFY(std::abs(height - speed * (f + 1) * kFrame) < 1e-3);
      const double bottom = motionOf(solver, 0).bottom;
      QVERIFY2(bottom > height, qPrintable(QString("frame %1: %2 below %3").arg(f).arg(bottom).arg(height)));
    }
  }

  /// Dropped from 0.5 m: it comes back to e2 of the way. Discrete time costs up to one substep of the fall.
  void dropsBounceAsHighAsTheySay_data() {
    QTest::addColumn<double>("restitution");
    QTest::addColumn<bool>("particles");
    for (const double e : {0.0, 0.3, 0.7, 1.0}) {
      QTest::addRow("e = %g, wall", e) << e << false;
      QTest::addRow("e = %g, particles", e) << e << true;
    }
  }
  void dropsBounceAsHighAsTheySay() {
    QFETCH(double, restitution);
    QFETCH(bool, particles);
    Solver solver;
    prepareWide(solver, settingsOf(0.02), grain(restitution));
    double rest = 0.01;
    if (particles) {
      solver.spawn(fixedPoints({{0, 0, 0}}));
      rest = ps::kContactDiameter * 0.02;
    } else {
      solver.setWalls({slope(0, 0.3)});
    }
    const double height = 0.5;
    const uint32_t id = solver.spawn(solids({{0, rest + height, 0}}))[0];
    double top = 0;
    bool met = false;
    for (int f = 0; f < 60; ++f) {
      QCOMPARE(solver.step().flags, 0u);
      met = met || velocityOf(solver, id).y > -1e-6 || positionOf(solver, id).y < rest + 1e-3;
      if (met) top = std::max(top, positionOf(solver, id).y - rest);
      if (met && velocityOf(solver, id).y < -0.2) break;
    }
    qInfo("back to %.4f of %.4f m", top, restitution * restitution * height);
    QVERIFY(std::abs(top - restitution * restitution * height) < 0.04 * height);
  }

  /// On a slope a grain stands below atan(mu_s); once it slides, mu_k brakes it.
  void grainsStandUpToTheAngleOfFriction_data() {
    QTest::addColumn<double>("lean");  // degrees; friction of the wall 0.5: 26.57 degrees
    QTest::addColumn<bool>("bonded");
    QTest::newRow("24 degrees") << 24.0 << false;
    QTest::newRow("26 degrees") << 26.0 << false;
    QTest::newRow("27.5 degrees") << 27.5 << false;
    QTest::newRow("30 degrees") << 30.0 << false;
    QTest::newRow("block, 22 degrees") << 22.0 << true;
    QTest::newRow("block, 32 degrees") << 32.0 << true;
  }
  void grainsStandUpToTheAngleOfFriction() {
    QFETCH(double, lean);
    QFETCH(bool, bonded);
    static const ps::constraint::BondModel bonds;
    const double angle = lean * std::numbers::pi / 180, mu = 0.5, seconds = 1;
    Solver solver;
    SolverSettings settings = settingsOf(0.02);
    settings.gravity = {kGravity * std::sin(angle), -kGravity * std::cos(angle), 0};
    prepareWide(solver, settings, grain(0));
    solver.setWalls({slope(0, mu)});
    ps::Spawn block = solids(bonded ? lattice(6, 3, 6, 0.02, 0) : std::vector<Double3>{{0, 0.01, 0}});
    if (bonded) block.constraintSets = {solver.addConstraintSet(&bonds, "bonds", bondParameters())};
    solver.spawn(block);
    const auto meanX = [&] {
      double sum = 0;
      for (size_t i = 0; i < solver.particles().size(); ++i) sum += double{solver.particles().position()[i].x};
      return sum / static_cast<double>(solver.particles().size());
    };
    const double from = meanX();
    QVERIFY(run(solver, static_cast<int>(std::lround(60 * seconds))));
    const double way = meanX() - from;
    const double expected =
        std::max(0.0, 0.5 * kGravity * (std::sin(angle) - mu * std::cos(angle)) * seconds * seconds);
    qInfo("slid %.4f of %.4f m", way, expected);
    QVERIFY(std::abs(way - expected) < (bonded ? 0.03 : 0.002) + 0.05 * expected);
  }

  /// A grain on top of a static one, pressed by gravity and pulled across; so short that its curvature does not tell.
  void restingGripIsMoreThanSlidingGrip_data() {
    QTest::addColumn<double>("pull");  // share of the pressing acceleration, along the surface
    QTest::addColumn<bool>("slides");
    QTest::newRow("below both") << 0.15 << false;
    QTest::newRow("between the two, from rest") << 0.45 << false;
    QTest::newRow("above both") << 0.8 << true;
  }
  void restingGripIsMoreThanSlidingGrip() {
    QFETCH(double, pull);
    QFETCH(bool, slides);
    Solver solver;
    SolverSettings settings = settingsOf(0.02);
    settings.gravity = {kGravity * pull, -kGravity, 0};
    prepareWide(solver, settings, grain(0, 0.6, 0.3));
    solver.spawn(fixedPoints({{0, 0, 0}}));
    const uint32_t id = solver.spawn(solids({{0, ps::kContactDiameter * 0.02, 0}}))[0];
    QVERIFY(run(solver, 1));
    const double way = positionOf(solver, id).x, free = 0.5 * kGravity * pull * kFrame * kFrame * 1.25;  // 4 substeps
    qInfo("moved %.2e of %.2e m", way, free);
    if (slides) {
      const double expected = free * (pull - 0.3) / pull;
      QVERIFY2(way > 0.9 * expected && way < 1.1 * expected, qPrintable(QString::number(way / expected)));
    } else {
      QVERIFY2(way < 0.02 * free, qPrintable(QString::number(way / free)));
    }
  }

  /// A belt of particles at 1 m/s takes nothing along without friction: not where it goes most of a spacing in a
  /// substep (spheres that sweep past each other did), nor where what fell on it has sunk in a little (the swept clamp
  /// did).
  void smoothBeltCarriesNothing_data() {
    QTest::addColumn<int>("substeps");
    QTest::addColumn<double>("drop");  // m
    QTest::addColumn<int>("layers");
    QTest::newRow("at rest, 0.83 spacings in a substep") << 1 << 0.0 << 2;
    QTest::newRow("falls 0.2 m") << 4 << 0.2 << 2;
    QTest::newRow("falls 0.1 m, 0.42 spacings in a substep") << 4 << 0.1 << 4;
    QTest::newRow("falls 0.2 m on a single layer") << 4 << 0.2 << 1;
  }
  void smoothBeltCarriesNothing() {
    QFETCH(int, substeps);
    QFETCH(double, drop);
    QFETCH(int, layers);
    const double spacing = layers == 4 ? 0.01 : 0.02;
    const int edge = static_cast<int>(std::lround(0.1 / spacing)), wide = edge + 2;
    Solver solver;
    ps::Material material = soft::matter(1000, 1e6);
    for (const char* smooth : {"friction_static", "friction_kinetic", "restitution"}) material.properties[smooth] = 0.0;
    SolverSettings settings = settingsOf(spacing);
    settings.substeps = substeps;
    prepareWide(solver, settings, material);
    std::vector<Double3> points = lattice(static_cast<int>(std::lround(1 / spacing)), layers, wide, spacing, 0);
    for (Double3& p : points) p.x -= 0.25;
    ps::Spawn belt = fixedPoints(std::move(points));
    belt.velocity.assign(belt.position.size(), {1, 0, 0});
    solver.spawn(belt);
    const ps::constraint::ClusterModel clusters;
    const uint32_t set = solver.addConstraintSet(&clusters, "clusters", soft::parametersOf(clusters));
    solver.spawn(soft::solid(lattice(edge, edge, edge, spacing, layers * spacing + drop), set, 1));
    QVERIFY(run(solver, 30));
    const rigid::Sums block = rigid::sumsOf(solver, 1);
    QVERIFY(block.centre.y() < layers * spacing + 0.06 && block.centre.y() > layers * spacing + 0.04);  // lies on it
    const double carried = block.momentum.x() / block.mass;
    QVERIFY2(std::abs(carried) < 0.05, qPrintable(QString("%1 m/s").arg(carried)));
  }

  void everyThreadCountGivesOneHash() {
    const auto hashOf = [](int threads) {
      ps::setThreadCount(threads);
      static const ps::constraint::BondModel bonds;
      Solver solver;
      prepareWide(solver, settingsOf(0.02), grain(0.6));
      solver.setWalls(tray(0.5));
      const uint32_t set = solver.addConstraintSet(&bonds, "bonds", bondParameters());
      ps::Spawn block = ice(lattice(5, 5, 5, 0.02, 0.1), set);
      block.velocity.assign(block.position.size(), {0, -30, 0});
      solver.spawn(block);
      ps::Spawn shots = solids(lattice(6, 3, 6, 0.03, 0.4), {0, -60, 3});
      solver.spawn(shots);
      solver.spawn(fixedPoints(lattice(8, 1, 8, 0.02, 0.02)));
      for (int f = 0; f < 10; ++f) solver.step();
      return solver.stateHash();
    };
    const uint64_t reference = hashOf(1);
    QCOMPARE(hashOf(2), reference);
    QCOMPARE(hashOf(8), reference);
  }
};

QTEST_APPLESS_MAIN(TestImpacts)
#include "tst_impacts.moc"
