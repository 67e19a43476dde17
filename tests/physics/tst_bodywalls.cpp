// SPDX-License-Identifier: Apache-2.0
// Heat and rays at walls of any shape, which are fixed bodies: they give what plane walls give, and closed forms say.
#include "heatscene.h"

#include "core/base/parallel.h"

#include <QtTest/QTest>

#include <cmath>
#include <cstring>
#include <numbers>

using heattest::Scene;

namespace {

constexpr double kPi = std::numbers::pi, kSigma = 5.670374419e-8;

/// A slab of 20 layers, body 0, between two layers each of bodies 1 and 2, which are fixed.
void addBetween(Scene& scene, uint32_t wallMaterial) {
  scene.addBox({0, 0, 0}, {20, 24, 24}, 0);
  const size_t slab = scene.store.size();
  scene.addBox({-2, 0, 0}, {2, 24, 24}, wallMaterial);
  const size_t left = scene.store.size();
  scene.addBox({20, 0, 0}, {2, 24, 24}, wallMaterial);
  for (size_t i = slab; i < scene.store.size(); ++i) {
    scene.store.body()[i] = i < left ? 1 : 2;
    scene.store.motion()[i] = ps::api::Motion::Static;
  }
}

/// A ball of body 0 in a shell of body 1, which is fixed: cells of a lattice within `radius`, and within three more.
/// Returns the cells of the ball.
size_t addBallInShell(Scene& scene, int cells, uint32_t shellMaterial) {
  const double radius = cells * scene.spacing, outer = radius + 3 * scene.spacing;
  const int half = cells + 3;
  size_t ball = 0;
  scene.addBox({-half, -half, -half}, {2 * half, 2 * half, 2 * half}, 0);
  for (size_t i = 0; i < scene.store.size(); ++i) {
    const double r = ps::vectorOf(scene.store.position()[i]).norm();
    ball += r < radius ? 1 : 0;
    if (r < radius) continue;
    scene.store.body()[i] = 1;
    scene.store.motion()[i] = ps::api::Motion::Static;
    scene.store.material()[i] = shellMaterial;
    if (r > outer) scene.store.position()[i] = {10 + 0.1f * float(i), 0, 0, 0};
  }
  return ball;
}

heattest::Matter metal() {
  heattest::Matter matter;
  matter.conductivitySolid = matter.conductivityLiquid = 400;
  return matter;
}

}  // namespace

class TestBodyWalls : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  /// The layer of tst_surroundings between two fluids: q = 100/(1/100 + 0.1/1 + 1/50) = 769 W/m2, whatever the walls
  /// are made of. 4 %, as of plane walls.
  void fluidsBehindBodies_data() {
    QTest::addColumn<bool>("sameMaterial");
    QTest::newRow("of the layer's material") << true;
    QTest::newRow("of another one") << false;
  }
  void fluidsBehindBodies() {
    QFETCH(bool, sameMaterial);
    Scene scene;
    scene.addMaterial(heattest::materialOf({}));
    scene.addMaterial(heattest::materialOf(metal()));
    addBetween(scene, sameMaterial ? 0 : 1);
    scene.heat.bodyHeating().set(
        std::vector<ps::BodyHeat>{{}, {.held = 300, .convection = 100}, {.held = 400, .convection = 50}});
    scene.start([](size_t i) { return 307.7 + 3.85 * static_cast<double>(i % 20); });
    scene.run(1000);
    const ps::HeatLedger before = scene.heat.ledger();
    const double energy = scene.heat.energy(scene.store);
    scene.run(100);
    const double flux = (scene.heat.ledger().exchanged - before.exchanged) / (2 * 100 * 0.12 * 0.12);
    const double expected = 100 / (0.01 + 0.1 + 0.02);
    qInfo("%.1f W/m2, should be %.1f", flux, expected);
    QVERIFY2(std::abs(flux / expected - 1) < 0.04, qPrintable(QString::number(flux)));
    const double given = scene.heat.ledger().heaters - before.heaters;
    QVERIFY(std::abs(scene.heat.energy(scene.store) - energy - given) < 1e-12 * scene.mass() * 1e5);
  }

  /// What gives the same on one thread and on several gives it to the bit, from walls of both kinds.
  void bodiesGiveWhatPlanesGive() {
    const auto flux = [](bool bodies, int threads, std::vector<double>& temperatures) {
      ps::setThreadCount(threads);
      Scene scene;
      scene.addMaterial(heattest::materialOf({}));
      if (bodies) {
        addBetween(scene, 0);
        scene.heat.bodyHeating().set(
            std::vector<ps::BodyHeat>{{}, {.held = 300, .convection = 100}, {.held = 400, .convection = 50}});
      } else {
        scene.addBox({0, 0, 0}, {20, 24, 24}, 0);
        for (const double side : {1.0, -1.0}) {
          ps::Wall& wall = scene.walls.emplace_back();
          wall.normal = {side, 0, 0};
          wall.offset = side > 0 ? 0 : -0.1;
          wall.heat = ps::WallHeat::Convective;
          wall.temperature = side > 0 ? 300 : 400;
          wall.convection = side > 0 ? 100 : 50;
        }
      }
      scene.start([](size_t) { return 350.0; });
      scene.run(1000);
      const double* t = scene.store.temperature();
      temperatures.assign(t, t + 20 * 24 * 24);
      ps::setThreadCount(0);
      return scene.heat.ledger().exchanged;
    };
    std::vector<double> one, several, plane;
    const double first = flux(true, 1, one);
    QCOMPARE(flux(true, 3, several), first);
    QVERIFY(std::memcmp(one.data(), several.data(), one.size() * sizeof(double)) == 0);
    const double byPlanes = flux(false, 1, plane);
    qInfo("bodies exchange %.4f of what planes do", first / byPlanes);
    QVERIFY(std::abs(first / byPlanes - 1) < 0.02);
    double worst = 0;
    for (size_t i = 0; i < one.size(); ++i) {  // away from the sides, where pairs are fewer and planes are not
      const size_t y = i / 20 % 24, z = i / 480;
      if (std::min({y, z, 23 - y, 23 - z}) >= 8) worst = std::max(worst, std::abs(one[i] - plane[i]));
    }
    qInfo("temperatures differ by %.3f K at most", worst);
    QVERIFY(worst < 0.3);  // of 100 K between the two fluids
  }

  /// A ball that conducts well in a shell with a fluid behind it: its excess goes as exp(-3 h t/(rho c R)). 6 %, of
  /// which the lattice's steps along the sphere are most.
  void aBallCoolsInAShell() {
    Scene scene;
    scene.addMaterial(heattest::materialOf(metal()));
    constexpr int kCells = 12;
    const double radius = kCells * scene.spacing, held = 300, convection = 100;
    const size_t ball = addBallInShell(scene, kCells, 0);
    scene.heat.bodyHeating().set(std::vector<ps::BodyHeat>{{}, {.held = held, .convection = convection}});
    scene.start([&](size_t) { return held + 50; });
    const auto excess = [&] {
      double sum = 0;
      for (size_t i = 0; i < scene.store.size(); ++i)
        sum += scene.store.body()[i] == 0 ? scene.store.temperature()[i] - held : 0;
      return sum / static_cast<double>(ball);
    };
    const double volume = static_cast<double>(ball) * std::pow(scene.spacing, 3);
    const double rate = convection * 4 * kPi * radius * radius / (1e6 * volume);
    scene.run(0.2 / rate);
    const double before = excess();
    scene.run(0.5 / rate);
    const double measured = std::log(before / excess()) / 0.5;
    qInfo("%.4f of the rate", measured);
    QVERIFY(std::abs(measured - 1) < 0.06);
  }

  /// Two plates, two layers thick, of which nothing is known but their particles give q A t each; 4 %, as of fluids
  /// behind bodies: the edges of the plates lack neighbours.
  void fluxOfBodiesIsThatOfPlanes() {
    Scene scene;
    scene.addMaterial(heattest::materialOf({}));
    addBetween(scene, 0);
    scene.heat.bodyHeating().set(
        std::vector<ps::BodyHeat>{{}, {.insulated = true, .flux = 1500}, {.insulated = true, .flux = -500}});
    scene.start([](size_t) { return 300.0; });
    const double energy = scene.heat.energy(scene.store);
    scene.run(20);
    const double gained = scene.heat.energy(scene.store) - energy, expected = (1500 - 500) * 0.12 * 0.12 * 20;
    qInfo("%.4f of the heat", gained / expected);
    QVERIFY(std::abs(gained / expected - 1) < 0.04);
    QVERIFY(std::abs(scene.heat.ledger().heaters - gained) < 1e-12 * scene.mass() * 1e5);
    for (size_t i = 20 * 24 * 24; i < scene.store.size(); ++i) QCOMPARE(scene.store.temperature()[i], 300.0);
  }

  /// Where its surface is known, all of it that matter covers counts: a cube in a bath gives q A t to rounding, on
  /// several threads to the bit what it gives on one.
  void fluxOfAKnownSurfaceIsExact() {
    const auto gained = [](int threads) {
      ps::setThreadCount(threads);
      Scene scene;
      scene.addMaterial(heattest::materialOf({}));
      scene.addBox({-10, -10, -10}, {20, 20, 20}, 0);
      for (size_t i = 0; i < scene.store.size(); ++i) {
        const ps::Vector3 at = ps::vectorOf(scene.store.position()[i]) / scene.spacing;
        if (at.cwiseAbs().maxCoeff() > 4) continue;
        scene.store.body()[i] = 1;
        scene.store.motion()[i] = ps::api::Motion::Static;
      }
      const double edge = 8 * scene.spacing;
      scene.heat.bodyHeating().set(
          std::vector<ps::BodyHeat>{{}, {.insulated = true, .flux = 2000, .area = 6 * edge * edge}});
      scene.start([](size_t) { return 300.0; });
      const double before = scene.heat.energy(scene.store);
      scene.run(5);
      ps::setThreadCount(0);
      return (scene.heat.energy(scene.store) - before) / (2000 * 6 * edge * edge * 5);
    };
    const double one = gained(1);
    qInfo("%.9f of the heat", one);
    QVERIFY(std::abs(one - 1) < 1e-6);  // volumes are floats
    QCOMPARE(gained(3), one);
  }

  /// Rays meet such walls as they meet any matter: a cube in a shell that is held at 800 K sees nothing else, and takes
  /// in sigma A (T'^4 - T^4)/(1/eps + (A/A')(1/eps' - 1)), the shell's inner face A' and emissivity eps'. 6 %: chance,
  /// and what of a lattice is its surface.
  void raysMeetBodies() {
    Scene scene;
    heattest::Matter matter = metal();
    scene.addMaterial(heattest::materialOf(matter));
    scene.addBox({-3, -3, -3}, {6, 6, 6}, 0);
    const size_t cube = scene.store.size();
    constexpr int kInner = 14, kOuter = 17;
    scene.addBox({-kOuter, -kOuter, -kOuter}, {2 * kOuter, 2 * kOuter, 2 * kOuter}, 0);
    size_t far = 0;
    for (size_t i = cube; i < scene.store.size(); ++i) {
      const ps::Vector3 at = ps::vectorOf(scene.store.position()[i]) / scene.spacing;
      const double out = std::max({std::abs(at.x()), std::abs(at.y()), std::abs(at.z())});
      scene.store.body()[i] = 1;
      scene.store.motion()[i] = ps::api::Motion::Static;
      if (out < kInner) scene.store.position()[i] = {10 + 0.1f * float(++far), 0, 0, 0};
    }
    scene.bounds = {{-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}, {}};
    scene.thermal.radiation = true;
    scene.thermal.surroundingsTemperature = 1500;
    scene.heat.bodyHeating().set(std::vector<ps::BodyHeat>{{}, {.held = 800}});
    scene.start([](size_t) { return 300.0; });
    const auto energyOfCube = [&] {
      double sum = 0;
      for (size_t i = 0; i < cube; ++i) sum += scene.store.temperature()[i] * scene.store.mass()[i] * 1000;
      return sum;
    };
    scene.heat.advance(scene.store, scene.neighbours, 1e-9);
    const double before = energyOfCube();
    scene.heat.advance(scene.store, scene.neighbours, 0.01);
    const double dx2 = scene.spacing * scene.spacing, area = 6 * 36 * dx2, inner = 6 * 4 * kInner * kInner * dx2;
    const double resistance = 1 / 0.9 + area / inner * (1 / 0.9 - 1);
    const double expected = kSigma * (std::pow(800, 4) - std::pow(300, 4)) * area / resistance * 0.01;
    const double share = (energyOfCube() - before) / expected;
    qInfo("%.4f of the heat", share);
    QVERIFY(std::abs(share - 1) < 0.06);
  }
};

QTEST_APPLESS_MAIN(TestBodyWalls)
#include "tst_bodywalls.moc"
