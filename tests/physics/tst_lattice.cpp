// SPDX-License-Identifier: Apache-2.0
// Soft bodies that lie and slide on lattices of particles.
#include "softscene.h"

#include <QTest>

using namespace soft;
using ps::Solver;
using ps::constraint::BondModel;
using ps::constraint::ClusterModel;

class TestLattice : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { ps::setThreadCount(2); }

  void slidesOverAMovingLattice_data() {
    QTest::addColumn<bool>("clusters");
    QTest::addColumn<double>("spacing");
    QTest::addColumn<double>("speed");
    QTest::addColumn<double>("friction");
    for (const bool clusters : {false, true}) {
      const char* kind = clusters ? "clusters" : "bonds";
      for (const double speed : {0.3, 1.0, 5.0})
        QTest::addRow("%s, %g m/s, smooth", kind, speed) << clusters << 0.02 << speed << 0.0;
      QTest::addRow("%s, half the spacing, smooth", kind) << clusters << 0.01 << 1.0 << 0.0;
      QTest::addRow("%s, 3 m/s, friction", kind) << clusters << 0.02 << 3.0 << 0.3;
      QTest::addRow("%s, half the spacing, friction", kind) << clusters << 0.01 << 3.0 << 0.3;
    }
  }
  /// A belt of fixed particles takes a block along by friction alone: mu g t after 0.4 s, as the normal force is its
  /// weight; a twentieth of it for the first contact, which finds the block not yet settled by its own weight, and 0.02
  /// m/s as its face sags. Without friction, nothing: 0.05 m/s are a twentieth of what interlocking spheres give.
  void slidesOverAMovingLattice() {
    QFETCH(bool, clusters);
    QFETCH(double, spacing);
    QFETCH(double, speed);
    QFETCH(double, friction);
    const BondModel bonds;
    const ClusterModel clustered;
    Solver solver;
    ps::Material stuff = matter(1100, 1e6);
    stuff.properties["restitution"] = 0.0;
    stuff.properties["friction_static"] = stuff.properties["friction_kinetic"] = friction;
    prepare(solver, settingsOf(spacing), stuff);
    solver.setBounds({{-10, -10, -10}, {10, 10, 10}, {}});
    const int wide = static_cast<int>(std::lround(0.1 / spacing));
    const double length = 0.2 + 0.5 * speed;
    std::vector<ps::api::Double3> points =
        lattice(static_cast<int>(2 * length / spacing), 2, wide + 4, spacing, -2 * spacing);
    ps::Spawn belt = fixedPoints(points);
    belt.body = 1;
    belt.velocity.assign(belt.position.size(), {speed, 0, 0});
    solver.spawn(belt);
    const uint32_t set = clusters ? solver.addConstraintSet(&clustered, "clusters", parametersOf(clustered))
                                  : solver.addConstraintSet(&bonds, "bonds", parametersOf(bonds));
    // Its lattice is not that of the belt.
    points = lattice(wide, wide, wide, spacing, 0);
    for (ps::api::Double3& p : points) p.x += 0.23 * spacing, p.z += 0.41 * spacing;
    solver.spawn(solid(points, set));
    QVERIFY(run(solver, 24));
    const Sums block = sumsOf(solver, 0);
    const double along = block.momentum.x() / block.mass, expected = friction * 9.81 * 0.4;
    qInfo("%.4f of %.4f m/s", along, expected);
    QVERIFY(std::abs(along - expected) < std::max(0.05, 0.05 * expected + 0.02));
    QVERIFY(std::abs(block.momentum.z() / block.mass) < 0.05);
    QVERIFY(std::abs(block.centre.y() - 0.05) < 0.2 * spacing);
  }
};

QTEST_APPLESS_MAIN(TestLattice)
#include "tst_lattice.moc"
