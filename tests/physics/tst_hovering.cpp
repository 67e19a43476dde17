// SPDX-License-Identifier: Apache-2.0
// What should sink and hangs in its liquid is told, and nothing else is.
#include "rigidscene.h"

#include <QTest>

using namespace mechanics;
using ps::Solver;
using ps::api::Double3;

namespace {

constexpr double kSpacing = 0.02, kLiquid = 789;

/// Dry matter of a density.
ps::Material solid(double density) {
  ps::Material m = water(density, density);
  m.id = "stone";
  m.properties["melting_temperature"] = 2000.0;
  return m;
}

ps::Material bath(double viscosity) {
  ps::Material m = water(kLiquid, kLiquid);
  m.properties["melting_temperature"] = 1.0;
  m.properties["boiling_temperature"] = 0.0;
  m.properties["viscosity"] = viscosity;
  return m;
}

/// A tank of 14 x 8 x 14 liquid particles, of which those in the way of the solid are left out.
class Tank {
 public:
  Tank(double density, double viscosity, std::vector<Double3> points, bool held) {
    ps::SolverSettings settings = ps::SolverSettings{};
    settings.spacing = kSpacing;
    prepare(m_solver, settings);
    m_solver.setMaterials({ps::BakedMaterial(bath(viscosity), 101325), ps::BakedMaterial(solid(density), 101325)});
    m_solver.setWalls(tray(14 * kSpacing));
    std::vector<Double3> around;
    for (const Double3& p : lattice(14, 8, 14, kSpacing, 0)) {
      if (std::none_of(points.begin(), points.end(), [&](const Double3& q) { return distance(p, q) < 0.5; }))
        around.push_back(p);
    }
    ps::Spawn body = ice(std::move(points), m_solver.addConstraintSet(m_rigid, "rigid", rigid::rigidParameters()));
    body.material = 1;
    body.body = 1;
    body.held = held;
    m_solver.spawn(liquid(std::move(around)));
    m_solver.spawn(body);
  }
  Solver& solver() { return m_solver; }
  std::vector<ps::Limit> hanging() const {
    std::vector<ps::Limit> found;
    for (const ps::Limit& limit : m_solver.limits()) {
      if (limit.what == "stone.density_solid") found.push_back(limit);
    }
    return found;
  }

 private:
  static double distance(const Double3& p, const Double3& q) {
    return (ps::vectorOf(p) - ps::vectorOf(q)).norm() / kSpacing;
  }
  const ps::constraint::RigidModel m_rigidModel{};
  const ps::AnyConstraint m_rigid{&m_rigidModel};
  Solver m_solver;
};

/// A cube of three spacings whose lowest layer is so many spacings above the floor.
std::vector<Double3> cube(int layer) {
  std::vector<Double3> points = lattice(3, 3, 3, kSpacing, layer * kSpacing);
  for (Double3& p : points) p.x += 0.5 * kSpacing, p.z += 0.5 * kSpacing;  // on the places of the liquid
  return points;
}

/// An open box, one particle thick, that swims though what it is made of would not.
std::vector<Double3> boat() {
  std::vector<Double3> points = lattice(8, 5, 8, kSpacing, 5 * kSpacing);
  std::erase_if(points, [](const Double3& p) {
    return std::abs(p.x) < 3 * kSpacing && std::abs(p.z) < 3 * kSpacing && p.y > 6 * kSpacing;
  });
  return points;
}

}  // namespace

class TestHovering : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  /// 917 in 789 kg/m3, cf. TrappedFilm: cubes of three spacings hang at a sixth more than the liquid's density.
  void whatHangsIsTold() {
    Tank tank(917, 1e-3, lattice(3, 3, 3, kSpacing, 8.5 * kSpacing), false);  // it falls in
    QVERIFY(run(tank.solver(), 30));
    QVERIFY(tank.hanging().empty());  // half a second says nothing yet
    QVERIFY(run(tank.solver(), 210));
    QVERIFY(motionOf(tank.solver(), 1).bottom > 1.5 * kSpacing);  // otherwise there is nothing to tell
    const std::vector<ps::Limit> told = tank.hanging();
    QCOMPARE(told.size(), size_t{1});
    QVERIFY(std::abs(told[0].asked - 917) < 0.01 && std::abs(told[0].delivered - kLiquid) < 0.01);  // float's rounding
    QCOMPARE(QString::fromStdString(told[0].use), QString("solver/particle_spacing=0.01"));
    QVERIFY(!told[0].why.empty());
  }

  void nothingElseIsTold_data() {
    QTest::addColumn<double>("density");
    QTest::addColumn<double>("viscosity");
    QTest::addColumn<bool>("isBoat");
    QTest::addColumn<int>("layer");
    QTest::addColumn<bool>("held");
    QTest::newRow("lighter, rises and floats") << 700.0 << 1e-3 << false << 3 << false;
    QTest::newRow("heavy, falls and lies on the floor") << 7800.0 << 1e-3 << false << 3 << false;
    QTest::newRow("stands on the floor") << 917.0 << 1e-3 << false << 0 << false;
    QTest::newRow("boat") << 1000.0 << 1e-3 << true << 0 << false;
    QTest::newRow("Stokes: 1.3 mm/s without walls") << 917.0 << 200.0 << false << 3 << false;
    QTest::newRow("held in place") << 917.0 << 1e-3 << false << 3 << true;
  }
  void nothingElseIsTold() {
    QFETCH(double, density);
    QFETCH(double, viscosity);
    QFETCH(bool, isBoat);
    QFETCH(int, layer);
    QFETCH(bool, held);
    Tank tank(density, viscosity, isBoat ? boat() : cube(layer), held);
    for (int k = 0; k < 12; ++k) {
      QVERIFY(run(tank.solver(), 15));
      QVERIFY2(tank.hanging().empty(), qPrintable(QString("after %1 s").arg(0.25 * (k + 1))));
    }
  }
};

QTEST_APPLESS_MAIN(TestHovering)
#include "tst_hovering.moc"
