// SPDX-License-Identifier: Apache-2.0
// What air does to matter: lift and drag of vapour parcels, of single drops and solids, wind, and the thesis's laws.
#include "core/solver/fluid/gasforces.h"

#include "heatscene.h"

#include <QTest>

#include <algorithm>
#include <numbers>

using heattest::dryIce;
using heattest::fullWater;
using heattest::Scene;
using ps::api::Phase;

namespace {

/// Ice cold enough to stay, as single grains of `diameter` m, or blocks of them.
class Grains {
 public:
  Grains(double diameter, double drag, std::array<int, 3> count = {1, 1, 1}) {
    m_scene.spacing = m_scene.solver.spacing = diameter * std::cbrt(std::numbers::pi / 6);  // a cube of its volume
    m_scene.solver.airDrag = drag;
    m_scene.addMaterial(fullWater());
    m_scene.addBox({0, 0, 0}, count, 0);
    m_scene.start([](size_t) { return 263.15; });
    m_forces.configure(m_scene.solver, m_scene.thermal, m_scene.materials);
    m_forces.measure(m_scene.store, m_scene.neighbours);
  }
  ps::SolverSettings& solver() { return m_scene.solver; }
  ps::ParticleStore& store() { return m_scene.store; }
  void reconfigure() { m_forces.configure(m_scene.solver, m_scene.thermal, m_scene.materials); }
  void advance(double dt) { m_forces.apply(m_scene.store, 0, m_scene.store.size(), dt); }

 private:
  Scene m_scene;
  ps::GasForces m_forces;
};

}  // namespace

class TestGas : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void vapourRisesAndSinksByItsDensity_data() {
    QTest::addColumn<bool>("carbonDioxide");
    QTest::addColumn<double>("kelvin");
    QTest::addColumn<double>("density");
    QTest::addColumn<double>("upwards");  // m/s2
    QTest::newRow("steam") << false << 373.15 << 0.588356 << 5.07426;
    // 2.749 kg/m3: 9.81 (1.2041/2.749 - 1)/(1 + 0.219)
    QTest::newRow("cold carbon dioxide") << true << 194.7 << 2.7548 << -4.5323;
  }
  void vapourRisesAndSinksByItsDensity() {
    QFETCH(bool, carbonDioxide);
    QFETCH(double, kelvin);
    QFETCH(double, density);
    QFETCH(double, upwards);
    Scene scene;
    scene.addMaterial(carbonDioxide ? dryIce() : fullWater());
    scene.addBox({0, 0, 0}, {1, 1, 1}, 0);
    scene.start([=](size_t) { return kelvin; }, [](size_t) { return Phase::Gas; });
    ps::GasForces forces;
    forces.configure(scene.solver, scene.thermal, scene.materials);
    QVERIFY(std::abs(forces.vapourDensity(0, kelvin) / density - 1) < 0.01);
    QVERIFY(std::abs(forces.airDensity() / 1.2041 - 1) < 0.01);
    forces.measure(scene.store, scene.neighbours);
    const double dt = 1e-4;
    forces.apply(scene.store, 0, 1, dt);
    const double seen = double{scene.store.velocity()[0].y} / dt;
    QVERIFY2(std::abs(seen / upwards - 1) < 0.01, qPrintable(QString::number(seen)));
    // Drag ends the rise: lift = k v^2 with k = 3 Cd rho_air/(4 rho D).
    for (int k = 0; k < 200000; ++k) forces.apply(scene.store, 0, 1, 1e-3);
    const double drag = 0.75 * 0.5 * 1.2041 / density / 0.2, terminal = std::sqrt(std::abs(upwards) / drag);
    QVERIFY(std::abs(std::abs(double{scene.store.velocity()[0].y}) / terminal - 1) < 0.02);
  }

  void gravityActsAlongItsVectorAndMayBeZero() {
    Scene scene;
    scene.addMaterial(fullWater());
    scene.addBox({0, 0, 0}, {2, 1, 1}, 0);
    scene.start([](size_t i) { return i == 0 ? 400.0 : 300.0; });
    scene.solver.gravity = {3, 0, 4};
    ps::GasForces forces;
    forces.configure(scene.solver, scene.thermal, scene.materials);
    forces.measure(scene.store, scene.neighbours);
    forces.apply(scene.store, 0, 2, 0.01);
    const auto* v = scene.store.velocity();
    QVERIFY(std::abs(double{v[1].x} - 0.03) < 1e-7 && v[1].y == 0 && std::abs(double{v[1].z} - 0.04) < 1e-7);
    QVERIFY(v[0].x < 0 && v[0].z < 0);  // vapour goes the other way
    scene.solver.gravity = {0, 0, 0};
    forces.configure(scene.solver, scene.thermal, scene.materials);
    const float speed = v[1].z;
    forces.apply(scene.store, 0, 2, 0.01);
    QCOMPARE(v[1].z, speed);
    QVERIFY(std::isfinite(v[0].x));
    scene.store.velocity()[1].w = 0;
    scene.solver.gravity = {0, -9.81, 0};
    forces.configure(scene.solver, scene.thermal, scene.materials);
    forces.apply(scene.store, 0, 2, 0.01);
    QCOMPARE(v[1].y, 0.0f);  // what does not move is left alone
  }

  void bubblesAreLiftedInsideLiquid() {
    Scene scene;
    scene.addMaterial(fullWater());
    scene.addBox({0, 0, 0}, {7, 7, 7}, 0);
    const size_t centre = 3 * 49 + 3 * 7 + 3;
    scene.start([=](size_t i) { return i == centre ? 380.0 : 300.0; });
    ps::GasForces forces;
    forces.configure(scene.solver, scene.thermal, scene.materials);
    forces.measure(scene.store, scene.neighbours);
    forces.apply(scene.store, centre, centre + 1, 1e-3);
    // Wholly immersed: +1 g, and no drag of air.
    QVERIFY(std::abs(double{scene.store.velocity()[centre].y} / 9.81e-3 - 1) < 0.01);
  }

  void steamStartsTwiceAsFastWithoutAddedMass() {
    // Case l5: 10.2666 m/s2 without, 5.07426 with the added mass of a sphere; 1 % as the reference allows.
    for (const auto& [added, upwards] : {std::pair{0.0, 10.2666}, std::pair{0.5, 5.07426}}) {
      Scene scene;
      scene.solver.addedMass = added;
      scene.addMaterial(fullWater());
      scene.addBox({0, 0, 0}, {1, 1, 1}, 0);
      scene.start([](size_t) { return 373.15; }, [](size_t) { return Phase::Gas; });
      ps::GasForces forces;
      forces.configure(scene.solver, scene.thermal, scene.materials);
      forces.measure(scene.store, scene.neighbours);
      forces.apply(scene.store, 0, 1, 1e-4);
      QVERIFY(std::abs(double{scene.store.velocity()[0].y} / 1e-4 / upwards - 1) < 0.01);
    }
  }

  void hailFallsAtItsTerminalSpeed() {
    // Case l1: 2 cm of ice, Cd 0.47, from rest; the exact solution is v_t tanh(g_e t/v_t). 1 % for steps of 1/240 s.
    Grains hail(0.02, 0.47);
    const double dt = 1.0 / 240;
    double distance = 0;
    const double times[] = {1, 2, 5}, speeds[] = {9.11823, 15.243, 20.2268}, distances[] = {4.72393, 17.1962, 73.2939};
    int next = 0;
    for (int k = 1; k <= 240 * 5; ++k) {
      hail.advance(dt);
      distance -= dt * double{hail.store().velocity()[0].y};
      if (k != int(240 * times[next])) continue;
      QVERIFY(std::abs(-double{hail.store().velocity()[0].y} / speeds[next] - 1) < 0.01);
      QVERIFY2(std::abs(distance / distances[next] - 1) < 0.01, qPrintable(QString::number(distance)));
      ++next;
    }
    for (int k = 0; k < 240 * 30; ++k) hail.advance(dt);
    QVERIFY(std::abs(-double{hail.store().velocity()[0].y} / 20.57577 - 1) < 0.001);
  }

  void airReachesOnlyTheSurfaceOfABlock() {
    Grains block(0.02, 1.05, {9, 9, 9});
    block.solver().gravity = {0, 0, 0};
    block.solver().wind = {5, 0, 0};
    block.reconfigure();
    block.advance(1e-3);
    const size_t centre = 4 * 81 + 4 * 9 + 4, corner = 0;
    const double inside = double{block.store().velocity()[centre].x};
    const double outside = double{block.store().velocity()[corner].x};
    QVERIFY(outside > 0);
    QVERIFY2(inside < 0.02 * outside, qPrintable(QString::number(inside / outside)));
  }

  void windCarriesVapourAndDropsToItsOwnSpeed() {
    for (const bool vapour : {true, false}) {
      Scene scene;
      scene.solver.gravity = {0, 0, 0};
      scene.solver.wind = {3, 0, -4};
      scene.solver.airDrag = vapour ? 0 : 0.47;
      scene.solver.spacing = 0.005;
      scene.addMaterial(fullWater());
      scene.addBox({0, 0, 0}, {1, 1, 1}, 0);
      scene.start([=](size_t) { return vapour ? 400.0 : 300.0; });
      ps::GasForces forces;
      forces.configure(scene.solver, scene.thermal, scene.materials);
      forces.measure(scene.store, scene.neighbours);
      const ps::api::Float4& v = scene.store.velocity()[0];
      double before = 0;
      for (int k = 0; k < 20000; ++k) {
        forces.apply(scene.store, 0, 1, 0.01);
        QVERIFY(double{v.x} >= before && double{v.x} <= 3);  // never overshoots
        before = double{v.x};
      }
      // dv/dt = -k v^2 comes to rest as 1/(k t): k is 0.085 1/m for the drop.
      QVERIFY2(std::abs(double{v.x} - 3) < 0.1 && std::abs(double{v.z} + 4) < 0.1, qPrintable(QString::number(v.x)));
      QVERIFY(v.y == 0);
    }
  }

  void thesisVapourRisesAndSwellsByItsLaws() {
    Scene scene;
    scene.solver.gasModel = ps::GasModel::Thesis;
    scene.solver.gravity = {0, 0, -2};  // the direction counts, the strength does not
    scene.addMaterial(fullWater());
    scene.addBox({0, 0, 0}, {2, 1, 1}, 0);
    scene.start([](size_t i) { return i == 0 ? 400.0 : 300.0; });
    ps::GasForces forces;
    forces.configure(scene.solver, scene.thermal, scene.materials);
    forces.measure(scene.store, scene.neighbours);
    forces.apply(scene.store, 0, 2, 0.01);
    QVERIFY(std::abs(double{scene.store.velocity()[0].z} - 0.01) < 1e-8);
    QVERIFY(std::abs(double{scene.store.velocity()[1].z} + 0.02) < 1e-8);  // liquid falls as ever
    const double liquid = double{scene.store.mass()[0]} / scene.materials[0].condensedDensity(400, 0);
    QVERIFY(std::abs(double{scene.store.position()[0].w} / liquid - 1 / 0.7) < 1e-5);
    scene.solver.gravity = {0, 0, 0};
    forces.configure(scene.solver, scene.thermal, scene.materials);
    const float speed = scene.store.velocity()[0].z;
    forces.apply(scene.store, 0, 2, 0.01);
    QCOMPARE(scene.store.velocity()[0].z, speed);  // no up without a down
  }
};

QTEST_APPLESS_MAIN(TestGas)
#include "tst_gas.moc"
