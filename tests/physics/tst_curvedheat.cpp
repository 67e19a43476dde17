// SPDX-License-Identifier: Apache-2.0
// Heat and rays at walls that are cylinders and spheres, against closed forms.
#include "curvedscene.h"
#include "heatscene.h"

#include <QTest>

using curvedwalls::curved;
using curvedwalls::rings;
using ps::vectorOf;
using ps::Wall;
using ps::WallForm;

namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

class TestCurvedHeat : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  /// A ring between two pipes held at two temperatures: T by the logarithm of the distance, Q = 2 pi k L dT/ln(b/a).
  void heatFlowsThroughARing() {
    const double inner = 0.03, outer = 0.08, cold = 273.15, hot = 373.15;
    heattest::Scene scene;
    scene.addMaterial(heattest::materialOf({}));
    constexpr int kLayers = 10;
    scene.addBox({-16, -16, 0}, {32, 32, kLayers}, 0);
    Wall pillar = curved(WallForm::Cylinder, inner, false), pipe = curved(WallForm::Cylinder, outer);
    for (Wall* wall : {&pillar, &pipe}) wall->normal = {0, 0, 1}, wall->heat = ps::WallHeat::FixedTemperature;
    pillar.temperature = hot, pipe.temperature = cold;
    scene.walls = {pillar, pipe};
    const auto logarithm = [&](double r) { return hot + (cold - hot) * std::log(r / inner) / std::log(outer / inner); };
    const auto distance = [&](size_t i) {
      const auto& p = scene.store.position()[i];
      return std::hypot(double{p.x}, double{p.y});
    };
    // Steps of a lattice along the curve would be what one sees.
    const std::vector<ps::api::Double3> places = rings(6, 10, kLayers, scene.spacing, 0);
    const size_t used = places.size();
    for (size_t i = 0; i < used; ++i)
      scene.store.position()[i] = {float(places[i].x), float(places[i].y), float(places[i].z), 0};
    for (size_t i = used; i < scene.store.size(); ++i) {  // the rest is far away, and as warm as it begins
      scene.store.position()[i] = {10 + 0.1f * float(i), 0, 0, 0};
    }
    scene.start([&](size_t i) { return i < used ? logarithm(distance(i)) : 300.0; });
    scene.run(300);
    double worst = 0;
    for (size_t i = 0; i < used; ++i)
      worst = std::max(worst, std::abs(scene.store.temperature()[i] - logarithm(distance(i))));
    const ps::HeatLedger before = scene.heat.ledger();
    const double seconds = 100;
    scene.run(seconds);
    const double through = (scene.heat.ledger().exchanged - before.exchanged) / (2 * seconds);
    const double expected = 2 * kPi * kLayers * scene.spacing * (hot - cold) / std::log(outer / inner);
    qInfo("%.4f of the heat, worst temperature off by %.3f K", through / expected, worst);
    QVERIFY(std::abs(through / expected - 1) < 0.04);  // as between planes: tst_heat
    QVERIFY(worst < 2.5);
  }

  /// A ball in a sphere held at a temperature: its mean excess goes as exp(-a (pi/R)^2 t), once the first mode is left.
  void aBallCoolsInASphere() {
    heattest::Scene scene;
    heattest::Matter matter;
    scene.addMaterial(heattest::materialOf(matter));
    constexpr int kCells = 24;
    scene.addBox({-kCells / 2, -kCells / 2, -kCells / 2}, {kCells, kCells, kCells}, 0);
    const double radius = 0.5 * kCells * scene.spacing, held = 300;
    Wall wall = curved(WallForm::Sphere, radius);
    wall.heat = ps::WallHeat::FixedTemperature;
    wall.temperature = held;
    scene.walls = {wall};
    std::vector<size_t> ball;
    for (size_t i = 0; i < scene.store.size(); ++i) {
      if (vectorOf(scene.store.position()[i]).norm() < radius)
        ball.push_back(i);
      else
        scene.store.position()[i] = {10 + 0.1f * float(i), 0, 0, 0};
    }
    scene.start([&](size_t) { return held + 50; });
    const auto excess = [&] {
      double sum = 0;
      for (const size_t i : ball) sum += scene.store.temperature()[i] - held;
      return sum / static_cast<double>(ball.size());
    };
    const double diffusivity = matter.conductivitySolid / (matter.density * matter.capacitySolid);
    const double rate = diffusivity * (kPi / radius) * (kPi / radius);
    scene.run(0.7 / rate);
    const double before = excess();
    scene.run(1 / rate);
    const double measured = std::log(before / excess());
    qInfo("%.4f of the rate; excess %.3f", measured, before);
    QVERIFY(std::abs(measured - 1) < 0.05);
  }

  /// A cube in a black sphere sees nothing else: eps sigma A (T_w^4 - T^4), straight, or by an insulating pipe about
  /// it, a mirror, of which it sees some. 4 %: chance.
  void raysMeetCurvedWalls_data() {
    QTest::addColumn<bool>("mirrored");
    QTest::newRow("straight") << false;
    QTest::newRow("by a mirror") << true;
  }
  void raysMeetCurvedWalls() {
    QFETCH(bool, mirrored);
    constexpr double kSigma = 5.670374419e-8;
    heattest::Scene scene;
    heattest::Matter metal;
    metal.conductivitySolid = metal.conductivityLiquid = 400;
    scene.addMaterial(heattest::materialOf(metal));
    scene.addBox({-3, -3, -3}, {6, 6, 6}, 0);
    Wall shell = curved(WallForm::Sphere, 0.08);
    shell.heat = ps::WallHeat::FixedTemperature;
    shell.temperature = 800, shell.emissivity = 1;
    scene.walls = {shell};
    if (mirrored) scene.walls.push_back(curved(WallForm::Cylinder, 0.05));
    scene.bounds = {{-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}, {}};
    scene.thermal.radiation = true;
    scene.thermal.surroundingsTemperature = 1500;
    scene.start([](size_t) { return 300.0; });
    scene.heat.advance(scene.store, scene.neighbours, 0.01);
    const double area = 6 * 36 * scene.spacing * scene.spacing;
    const double expected = 0.9 * kSigma * (std::pow(800, 4) - std::pow(300, 4)) * area * 0.01;
    const double share = scene.heat.ledger().walls / expected;
    qInfo("%.4f of the heat", share);
    QVERIFY(mirrored ? share > 0.7 && share < 0.96 : std::abs(share - 1) < 0.04);
    QCOMPARE(scene.heat.ledger().radiation, 0.0);  // no ray gets out to what is hotter
  }
};

QTEST_APPLESS_MAIN(TestCurvedHeat)
#include "tst_curvedheat.moc"
