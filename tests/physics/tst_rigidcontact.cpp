// SPDX-License-Identifier: Apache-2.0
// Rigid bodies against walls, each other and other matter.
#include "rigidscene.h"

#include <QTest>

#include <numbers>

using namespace mechanics;
using namespace rigid;
using ps::Solver;
using ps::SolverSettings;

namespace {

ps::Material matter(double staticFriction, double kineticFriction, double restitution) {
  ps::Material m = water();
  m.properties["friction_static"] = staticFriction;
  m.properties["friction_kinetic"] = kineticFriction;
  m.properties["restitution"] = restitution;
  return m;
}

/// A plane tilted by `degrees`, as gravity that leans.
SolverSettings incline(double degrees, double spacing, int substeps) {
  SolverSettings settings = settingsOf(spacing);
  const double angle = degrees * std::numbers::pi / 180;
  settings.gravity = {9.81 * std::sin(angle), -9.81 * std::cos(angle), 0};
  settings.substeps = substeps;
  return settings;
}

std::vector<ps::Wall> plane(double friction) {
  std::vector<ps::Wall> walls(1);
  walls[0].friction = friction;
  return walls;
}

std::vector<ps::api::Double3> moved(std::vector<ps::api::Double3> points, const Vector3& by) {
  for (ps::api::Double3& p : points) p = ps::double3Of(vectorOf(p) + by);
  return points;
}

}  // namespace

class TestRigidContact : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { ps::setThreadCount(2); }

  /// Case m3: friction 0.5 holds up to 26.57 degrees.
  void boxRestsOrSlides_data() {
    QTest::addColumn<double>("degrees");
    QTest::addColumn<bool>("onStones");
    QTest::addColumn<double>("least");
    QTest::addColumn<double>("most");
    // a t^2/2 with a = g (sin - 0.5 cos)
    QTest::newRow("24 degrees") << 24.0 << false << -0.001 << 0.001;
    QTest::newRow("26 degrees") << 26.0 << false << -0.002 << 0.002;
    QTest::newRow("30 degrees") << 30.0 << false << 1.31429 * 0.99 << 1.31429 * 1.01;
    QTest::newRow("24 degrees, on particles") << 24.0 << true << -0.001 << 0.001;
    // The box crosses from one row of stones to the next: 10 %, as the case allows.
    QTest::newRow("30 degrees, on particles") << 30.0 << true << 1.31429 * 0.9 << 1.31429 * 1.1;
  }
  void boxRestsOrSlides() {
    QFETCH(double, degrees);
    QFETCH(bool, onStones);
    QFETCH(double, least);
    QFETCH(double, most);
    Solver solver;
    prepare(solver, incline(degrees, 0.05, 10), matter(0.5, 0.5, 0));
    if (onStones)
      solver.spawn(fixedPoints(moved(lattice(40, 1, 8, 0.05, -0.05), {0.7, 0, 0})));
    else
      solver.setWalls(plane(0.5));
    spawnRigid(solver, lattice(6, 3, 6, 0.05, 0), 1);
    const double start = sumsOf(solver, 1).centre.x();
    QVERIFY(run(solver, 120));
    const double way = sumsOf(solver, 1).centre.x() - start;
    QVERIFY2(way > least && way < most, qPrintable(QString::number(way)));
  }

  void restingGripIsStronger() {
    // 0.6 holds at 28 degrees (tangent 0.53), 0.3 does not; a push breaks it loose and it keeps sliding.
    for (const bool pushed : {false, true}) {
      Solver solver;
      prepare(solver, incline(28, 0.05, 8), matter(0.6, 0.3, 0));
      solver.spawn(fixedPoints(moved(lattice(30, 1, 6, 0.05, -0.05), {0.5, 0, 0})));
      spawnRigid(solver, lattice(4, 2, 4, 0.05, 0), 1, {pushed ? 0.5 : 0, 0, 0});
      const double start = sumsOf(solver, 1).centre.x();
      QVERIFY(run(solver, 45));
      const double way = sumsOf(solver, 1).centre.x() - start, t = 0.75;
      const double angle = 28 * std::numbers::pi / 180;
      const double slid = 0.5 * t + 0.5 * 9.81 * (std::sin(angle) - 0.3 * std::cos(angle)) * t * t;
      QVERIFY2(pushed ? std::abs(way / slid - 1) < 0.1 : std::abs(way) < 0.001, qPrintable(QString::number(way)));
    }
  }

  /// Case m2: a box of 0.2 m base, measured between its outermost contacts, and 0.6 m height tips at 18.4 degrees.
  void boxTips_data() {
    QTest::addColumn<double>("degrees");
    QTest::addColumn<bool>("tips");
    QTest::newRow("16.4 degrees") << 16.4 << false;
    QTest::newRow("20.4 degrees") << 20.4 << true;
  }
  void boxTips() {
    QFETCH(double, degrees);
    QFETCH(bool, tips);
    Solver solver;
    prepare(solver, incline(degrees, 0.05, 10));
    solver.setWalls(plane(5));
    spawnRigid(solver, lattice(5, 12, 5, 0.05, 0));
    const Vector3 start = sumsOf(solver).centre;
    QVERIFY(run(solver, 180));
    const Vector3 way = sumsOf(solver).centre - start;
    if (tips)
      QVERIFY2(way.y() < -0.15, qPrintable(QString::number(way.y())));
    else
      QVERIFY2(way.norm() < 0.001, qPrintable(QString::number(way.norm())));
  }

  void towerStands() {
    Solver solver;
    prepare(solver, settingsOf(0.02), matter(0.5, 0.4, 0.1));
    solver.setWalls(tray(0.6));
    for (uint32_t k = 0; k < 5; ++k) spawnRigid(solver, lattice(5, 5, 5, 0.02, 0.1 * k), k);
    const Vector3 start = sumsOf(solver, 4).centre;
    QVERIFY(run(solver, 600));
    QVERIFY2((sumsOf(solver, 4).centre - start).norm() < 0.001,
             qPrintable(QString::number((sumsOf(solver, 4).centre - start).norm())));
    for (uint32_t k = 0; k < 5; ++k) {
      const Sums s = sumsOf(solver, k);
      QVERIFY2(s.momentum.norm() < 0.002 * s.mass, qPrintable(QString::number(s.momentum.norm() / s.mass)));
    }
  }

  void boxBouncesUpright_data() {
    QTest::addColumn<double>("restitution");
    QTest::newRow("clay") << 0.0;
    QTest::newRow("wood") << 0.5;
    QTest::newRow("rubber ball") << 0.8;
  }
  void boxBouncesUpright() {
    QFETCH(double, restitution);
    Solver solver;
    prepare(solver, settingsOf(0.02), matter(0.3, 0.2, restitution));
    solver.setWalls(tray(1));
    spawnRigid(solver, lattice(5, 5, 5, 0.02, 0.2));
    double top = 0;
    for (int f = 0; f < 45; ++f) {
      QCOMPARE(solver.step().flags, 0u);
      if (f > 13) top = std::max(top, sumsOf(solver).centre.y() - 0.05);  // it lands after 0.2 s
    }
    // The height e^2 h, sampled per frame, and less the way of a substep at impact.
    const double height = restitution * restitution * 0.2;
    QVERIFY2(std::abs(top - height) < 0.06 * height + 0.001, qPrintable(QString::number(top)));
    QVERIFY(sumsOf(solver).angular.norm() < 1e-6);
  }

  void collisionKeepsMomentum_data() {
    QTest::addColumn<bool>("bonded");
    QTest::newRow("two rigid bodies") << false;
    QTest::newRow("a rigid and a bonded one") << true;
  }
  void collisionKeepsMomentum() {
    QFETCH(bool, bonded);
    Solver solver;
    SolverSettings settings = settingsOf(0.02);
    settings.gravity = {0, 0, 0};
    prepare(solver, settings, matter(0.5, 0.4, 0.5));
    spawnRigid(solver, lattice(5, 5, 5, 0.02, 0), 0, {1, 0, 0});
    const std::vector<ps::api::Double3> target = moved(lattice(6, 4, 4, 0.02, 0.043), {0.125, 0, 0.011});
    if (bonded) {
      ps::Spawn spawn = ice(target, solver.addConstraintSet(&m_bonds, "bonds", bondParameters()));
      spawn.body = 1;
      solver.spawn(spawn);
    } else {
      spawnRigid(solver, target, 1);
    }
    const Sums before = sumsOf(solver);
    QVERIFY(run(solver, 30));
    const Sums after = sumsOf(solver), hit = sumsOf(solver, 1);
    QVERIFY2(hit.momentum.x() > 0.2 * before.momentum.x(), qPrintable(QString::number(hit.momentum.x())));
    QVERIFY2((after.momentum - before.momentum).norm() < 1e-5 * before.momentum.norm(),
             qPrintable(QString::number((after.momentum - before.momentum).norm() / before.momentum.norm())));
    // Contacts are as thick as a spacing: friction on both sides of the gap leaves a couple.
    QVERIFY2((after.angular - before.angular).norm() < 0.05 * before.angular.norm(),
             qPrintable(QString::number((after.angular - before.angular).norm() / before.angular.norm())));
    QVERIFY(after.energy < before.energy * 1.001);
  }

  /// Without friction a floor does not take a body's spin, however often it bears it.
  void spinStaysOnASmoothFloor_data() {
    QTest::addColumn<int>("substeps");
    for (const int substeps : {4, 16}) QTest::addRow("%d substeps", substeps) << substeps;
  }
  void spinStaysOnASmoothFloor() {
    QFETCH(int, substeps);
    Solver solver;
    SolverSettings settings = settingsOf(0.02);
    settings.substeps = substeps;
    prepare(solver, settings, matter(0, 0, 0.3));
    solver.setWalls(plane(0));
    spawnTurning(solver, lattice(5, 3, 4, 0.02, 0), {0, 0, 0}, {0, 4, 0}, 0);
    const double before = sumsOf(solver).angular.y();
    QVERIFY(run(solver, 120));
    QVERIFY2(std::abs(sumsOf(solver).angular.y() / before - 1) < 1e-3,
             qPrintable(QString::number(sumsOf(solver).angular.y() / before)));
  }

  /// Bodies of several shapes in a closed box: walls and each other give back what restitution says, and never more.
  void boxOfBodiesNeverGainsEnergy_data() {
    QTest::addColumn<double>("restitution");
    QTest::addColumn<double>("friction");
    QTest::addColumn<double>("speed");
    QTest::addColumn<double>("least");
    QTest::newRow("elastic") << 1.0 << 0.0 << 1.0 << 0.98;
    QTest::newRow("elastic and fast") << 1.0 << 0.0 << 4.0 << 0.5;
    QTest::newRow("elastic and rough") << 1.0 << 0.4 << 1.0 << 0.0;
    QTest::newRow("nearly elastic") << 0.9 << 0.0 << 1.0 << 0.0;
    QTest::newRow("wood") << 0.5 << 0.3 << 2.0 << 0.0;
  }
  void boxOfBodiesNeverGainsEnergy() {
    QFETCH(double, restitution);
    QFETCH(double, friction);
    QFETCH(double, speed);
    QFETCH(double, least);
    Solver solver;
    SolverSettings settings = settingsOf(0.02);
    settings.gravity = {0, 0, 0};
    prepare(solver, settings, matter(friction, friction, restitution));
    std::vector<ps::Wall> walls(6);
    for (size_t k = 0; k < 6; ++k) {
      const double side = k % 2 == 0 ? 1 : -1;
      walls[k].normal = {k / 2 == 0 ? side : 0.0, k / 2 == 1 ? side : 0.0, k / 2 == 2 ? side : 0.0};
      walls[k].offset = -0.3;
      walls[k].friction = friction;
    }
    solver.setWalls(walls);
    const Vector3 v = speed * Vector3(1, 0.4, 0.3), w = speed * Vector3(3, -2, 5);
    spawnTurning(solver, moved(lattice(6, 2, 4, 0.02, 0.05), {-0.1, 0, 0.05}), v, w, 0);
    spawnTurning(solver, moved(lattice(3, 3, 3, 0.02, -0.15), {0.1, 0, -0.1}), -v, w, 1);
    spawnTurning(solver, moved(lattice(2, 7, 2, 0.02, -0.1), {0, 0, 0.15}), {0, speed, 0}, -w, 2);
    const double before = sumsOf(solver).energy;
    double most = 0;
    for (int f = 0; f < 600; ++f) {
      QCOMPARE(solver.step().flags, 0u);
      most = std::max(most, sumsOf(solver).energy);
    }
    // Free turns are stepped by 0.1 rad, which leaves some 0.3 % in 10 s.
    QVERIFY2(most < 1.01 * before, qPrintable(QString::number(most / before)));
    QVERIFY2(sumsOf(solver).energy > least * before, qPrintable(QString::number(sumsOf(solver).energy / before)));
  }

  /// Two bodies that meet off centre, in free space: what one loses of each momentum the other has. What does not part
  /// again goes on sliding, and projection moves the two apart without the way that belongs to it: 1.5 %.
  void obliqueCollisionKeepsAngularMomentum_data() {
    QTest::addColumn<double>("friction");
    QTest::addColumn<double>("restitution");
    for (const double friction : {0.0, 0.5}) {
      for (const double restitution : {0.0, 0.6, 1.0})
        QTest::addRow("friction %g, restitution %g", friction, restitution) << friction << restitution;
    }
  }
  void obliqueCollisionKeepsAngularMomentum() {
    QFETCH(double, friction);
    QFETCH(double, restitution);
    Solver solver;
    SolverSettings settings = settingsOf(0.02);
    settings.gravity = {0, 0, 0};
    prepare(solver, settings, matter(friction, friction, restitution));
    spawnTurning(solver, lattice(5, 4, 5, 0.02, 0), {2, 0.5, 0}, {0, 3, 1}, 0);
    spawnTurning(solver, moved(lattice(6, 3, 4, 0.02, 0.05), {0.14, 0, 0.03}), {-1, 0, 0.4}, {-2, 0, 0}, 1);
    const Sums before = sumsOf(solver), first = sumsOf(solver, 0);
    QVERIFY(run(solver, 30));
    const Sums after = sumsOf(solver);
    QVERIFY2((sumsOf(solver, 0).momentum - first.momentum).norm() > 0.2 * first.momentum.norm(), "they did not meet");
    QVERIFY2((after.momentum - before.momentum).norm() < 1e-5 * first.momentum.norm(),
             qPrintable(QString::number((after.momentum - before.momentum).norm() / first.momentum.norm())));
    QVERIFY2((after.angular - before.angular).norm() < (restitution > 0 ? 0.01 : 0.02) * before.angular.norm(),
             qPrintable(QString::number((after.angular - before.angular).norm() / before.angular.norm())));
    QVERIFY2(after.energy < before.energy * 1.001, qPrintable(QString::number(after.energy / before.energy)));
  }

  void bodiesDoNotPassEachOther() {
    Solver solver;
    prepare(solver, settingsOf(0.02));
    solver.setWalls(tray(0.3));
    solver.spawn(fixedPoints(lattice(9, 1, 9, 0.02, 0)));
    spawnRigid(solver, lattice(6, 5, 6, 0.02, 0.03), 1);
    ps::Spawn middle = ice(lattice(5, 4, 5, 0.02, 0.15), solver.addConstraintSet(&m_bonds, "bonds", bondParameters()));
    middle.body = 2;
    solver.spawn(middle);
    spawnRigid(solver, lattice(4, 4, 4, 0.02, 0.26), 3);
    QVERIFY(run(solver, 180));  // it rocks for a while
    // Faces lie one spacing apart; half a radius of penetration at most.
    const Motion low = motionOf(solver, 1), mid = motionOf(solver, 2), high = motionOf(solver, 3);
    QVERIFY2(low.bottom > 0.01 + 0.015, qPrintable(QString::number(low.bottom)));
    QVERIFY2(mid.bottom > low.top + 0.015, qPrintable(QString::number(mid.bottom - low.top)));
    QVERIFY2(high.bottom > mid.top + 0.015, qPrintable(QString::number(high.bottom - mid.top)));
    QVERIFY2(std::max({low.fastest, mid.fastest, high.fastest}) < 0.02, qPrintable(QString::number(high.fastest)));
  }

  void fastBodyStopsAtALayer_data() {
    QTest::addColumn<double>("speed");
    for (const double speed : {5.0, 20.0, 100.0}) QTest::addRow("%g m/s", speed) << speed;
  }
  void fastBodyStopsAtALayer() {
    QFETCH(double, speed);
    Solver solver;
    SolverSettings settings = settingsOf(0.02);
    settings.gravity = {0, 0, 0};
    prepare(solver, settings, matter(0.3, 0.2, 0));
    solver.spawn(fixedPoints(lattice(20, 1, 20, 0.02, -0.01)));
    spawnRigid(solver, lattice(5, 5, 5, 0.02, 0.153), 1, {0.1 * speed, -speed, 0});
    const std::vector<double> shape = distances(solver, 1);
    const double before = sumsOf(solver, 1).energy;
    for (int f = 0; f < 10; ++f) {
      QCOMPARE(solver.step().flags, 0u);
      if (std::abs(sumsOf(solver, 1).centre.x()) > 0.2) break;  // slid over the edge
      QVERIFY2(motionOf(solver, 1).bottom > 0.01, qPrintable(QString::number(motionOf(solver, 1).bottom)));
    }
    QVERIFY(sumsOf(solver, 1).energy < before);
    QVERIFY(greatestChange(shape, distances(solver, 1)) < 2e-6);
  }

  /// A press that nothing stops: it passes, and the wall gives way last, so that nothing is lost.
  void pressedBodyStaysInside() {
    Solver solver;
    prepare(solver, settingsOf(0.02));
    solver.setWalls(tray(0.3));
    ps::Spawn press = fixedPoints(lattice(9, 2, 9, 0.02, 0.15));
    press.body = 2;
    press.velocity.assign(press.position.size(), {0, -1, 0});
    solver.spawn(press);
    spawnRigid(solver, lattice(5, 5, 5, 0.02, 0), 1);
    const std::vector<double> shape = distances(solver, 1);
    double lowest = 1;
    for (int f = 0; f < 30; ++f) {
      const ps::StepReport report = solver.step();
      QCOMPARE(report.flags, 0u);
      const ps::MomentumRecord& m = report.momentum;
      // A place is rounded by 4e-9 m: 8e-7 kg m/s for the whole body in a substep of 4 ms, some thirty times a frame.
      const double open = m.end.y - m.start.y - m.external.y;
      QVERIFY2(std::abs(open) < 1e-5 * std::abs(m.external.y) + 5e-6, qPrintable(QString::number(open)));
      lowest = std::min(lowest, motionOf(solver, 1).bottom);
    }
    // Its lowest particles lie half a spacing above the wall and may sink in by as much.
    QVERIFY2(lowest > -1e-4 && lowest < 0.0101, qPrintable(QString::number(lowest)));
    QVERIFY(greatestChange(shape, distances(solver, 1)) < 2e-6);
  }

  /// Two presses that would lay a long body across a slot narrower than it: it does not take the turn.
  void pressedBodyDoesNotTurnThroughWalls() {
    Solver solver;
    SolverSettings settings = settingsOf(0.02);
    settings.gravity = {0, 0, 0};
    prepare(solver, settings);
    std::vector<ps::Wall> walls(2);
    for (size_t k = 0; k < 2; ++k) {
      walls[k].normal = {k == 0 ? 1.0 : -1.0, 0, 0};
      walls[k].offset = -0.05;
    }
    solver.setWalls(walls);
    spawnRigid(solver, lattice(3, 8, 3, 0.02, -0.08), 1);
    for (const double side : {1.0, -1.0}) {
      ps::Spawn press = fixedPoints(moved(lattice(1, 3, 3, 0.02, -0.03), {-0.06 * side, 0.05 * side, 0}));
      press.body = 2;
      press.velocity.assign(press.position.size(), {side, 0, 0});
      solver.spawn(press);
    }
    double farthest = 0;
    for (int f = 0; f < 12; ++f) {
      QCOMPARE(solver.step().flags, 0u);
      const ps::ParticleStore& p = solver.particles();
      for (size_t i = 0; i < p.size(); ++i) {
        if (p.body()[i] == 1) farthest = std::max(farthest, std::abs(double{p.position()[i].x}));
      }
    }
    // Half a spacing in front of the wall, and half a spacing that it may sink in.
    QVERIFY2(farthest > 0.035 && farthest < 0.0502, qPrintable(QString::number(farthest)));
  }

  void goesOnAfterAFrameThatWentWrong() {
    Solver solver;
    prepare(solver, settingsOf(0.02));
    solver.setWalls(tray(0.4));
    spawnRigid(solver, lattice(5, 5, 5, 0.02, 0));
    QVERIFY(run(solver, 10));
    const Vector3 centre = sumsOf(solver).centre;
    const std::vector<double> shape = distances(solver, 0);
    // Gravity that is no number makes all members so, and what contacts bear.
    solver.setSettings([] {
      SolverSettings settings = settingsOf(0.02);
      settings.gravity = {0, std::nan(""), 0};
      return settings;
    }());
    QCOMPARE(solver.step().flags, static_cast<ps::StepFlags>(ps::StepFlag::NotFinite));
    solver.setSettings(settingsOf(0.02));
    QVERIFY(run(solver, 30));
    QVERIFY((sumsOf(solver).centre - centre).norm() < 1e-4);
    QVERIFY(greatestChange(shape, distances(solver, 0)) < 1e-6);
  }

 private:
  void spawnRigid(Solver& solver, std::vector<ps::api::Double3> points, uint32_t body = 0,
                  const Vector3& velocity = {}) {
    spawnTurning(solver, std::move(points), velocity, {}, body);
  }

  void spawnTurning(Solver& solver, std::vector<ps::api::Double3> points, const Vector3& velocity, const Vector3& spin,
                    uint32_t body) {
    ps::Spawn spawn = ice(std::move(points), solver.addConstraintSet(&m_rigid, "rigid", rigidParameters()));
    spawn.velocity = turning(spawn.position, velocity, spin);
    spawn.body = body;
    solver.spawn(spawn);
  }

  const ps::constraint::RigidModel m_rigid{};
  const ps::constraint::BondModel m_bonds{};
};

QTEST_APPLESS_MAIN(TestRigidContact)
#include "tst_rigidcontact.moc"
