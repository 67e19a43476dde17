// SPDX-License-Identifier: Apache-2.0
// Conduction, walls, moving fronts and the energy balance of HeatStage against closed forms. Cross-sections are wide
// and their cores are measured: the sides are adiabatic, and a particle there has fewer partners to conduct through.
#include "core/base/parallel.h"
#include "heatscene.h"
#include "thesislatentmodel.h"

#include <QTest>

#include <algorithm>
#include <array>

using heattest::Matter;
using heattest::Scene;
using ps::api::Phase;

namespace {

ps::Wall hotWall(ps::api::Double3 normal, double offset, double temperature) {
  ps::Wall wall;
  wall.id = "wall";
  wall.normal = normal;
  wall.offset = offset;
  wall.heat = ps::WallHeat::FixedTemperature;
  wall.temperature = temperature;
  return wall;
}

/// A slab of 20 layers, body 0, between four layers each of bodies 1 and 2, which are fixed.
void addBetween(Scene& scene, const std::array<uint32_t, 2>& materials) {
  scene.addBox({0, 0, 0}, {20, 24, 24}, 0);
  const size_t slab = scene.store.size();
  scene.addBox({-4, 0, 0}, {4, 24, 24}, materials[0]);
  const size_t left = scene.store.size();
  scene.addBox({20, 0, 0}, {4, 24, 24}, materials[1]);
  for (size_t i = slab; i < scene.store.size(); ++i) {
    scene.store.body()[i] = i < left ? 1 : 2;
    scene.store.motion()[i] = ps::api::Motion::Static;
  }
}

struct Errors {
  double rms = 0, largest = 0;
};

/// A model with a law of its own: 2 W/K between any two that touch.
class OwnLaws final : public ps::thermal::EnthalpyModel {
 public:
  bool pairFlux(const ps::api::ThermalContext&, const ps::api::ParticleView& view, const ps::api::NeighbourView& lists,
                size_t first, size_t last, double* watts) const override {
    for (size_t i = first; i < last; ++i) {
      for (uint32_t k = lists.begin[i]; k < lists.last[i]; ++k) {
        watts[k] = 2 * (view.temperature[lists.index[k]] - view.temperature[i]);
      }
    }
    return true;
  }
};

/// As many W in each particle as its parameter says; throws above 1 MW.
class Heater final : public ps::api::HeatSourcePlugin {
 public:
  const char* label() const override { return "Heater"; }
  const char* help() const override { return ""; }
  ps::api::ParameterList parameters() const override { return {}; }
  ps::api::List<ps::api::FieldDeclaration> fields() const override {
    static const ps::api::FieldDeclaration list[] = {{"heater.glow", "1", "", ps::api::FieldType::Float32, "Glow"}};
    return ps::api::listOf(list);
  }
  void addWatts(const ps::api::ThermalContext& context, const ps::api::ParticleView&, size_t first, size_t last,
                double* watts) const override {
    if (context.parameters[0] > 1e6) throw std::runtime_error("the fuse has blown");
    for (size_t i = first; i < last; ++i) watts[i] += context.parameters[0];
  }
};

}  // namespace

class TestHeat : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void slabsInContactFollowTheErrorFunction_data() {
    QTest::addColumn<QList<double>>("left");  // conductivity, volumetric heat capacity
    QTest::addColumn<QList<double>>("right");
    QTest::addColumn<double>("seconds");
    QTest::addColumn<double>("jitter");
    QTest::addColumn<double>("rms");
    QTest::addColumn<double>("largest");
    // Tolerances: twice and more what lattices and disordered particles of this kernel reach (0.13 % and 0.44 %).
    const QList<double> one{1, 1e6}, wet{0.6, 4.18e6}, icy{2.2, 1.9e6};
    QTest::newRow("one material, lattice") << one << one << 100.0 << 0.0 << 0.005 << 0.01;
    QTest::newRow("one material, jitter") << one << one << 100.0 << 0.2 << 0.01 << 0.03;
    QTest::newRow("water and ice, lattice") << wet << icy << 200.0 << 0.0 << 0.008 << 0.02;
    QTest::newRow("water and ice, jitter") << wet << icy << 200.0 << 0.2 << 0.015 << 0.04;
    QTest::newRow("contrast 10, lattice")
        << QList<double>{0.5, 2e6} << QList<double>{5, 2e6} << 60.0 << 0.0 << 0.01 << 0.02;
  }
  void slabsInContactFollowTheErrorFunction() {
    QFETCH(QList<double>, left);
    QFETCH(QList<double>, right);
    QFETCH(double, seconds);
    QFETCH(double, jitter);
    Scene scene;
    scene.spacing = 0.0025;
    const bool same = left == right;
    for (const auto& side : {left, right}) {
      Matter m;
      m.conductivitySolid = m.conductivityLiquid = side[0];
      m.capacityLiquid = side[1] / 1000;
      scene.addMaterial(heattest::materialOf(m));
    }
    scene.addBox({-20, 0, 0}, {20, 24, 24}, 0, jitter);
    scene.addBox({0, 0, 0}, {20, 24, 24}, same ? 0 : 1, jitter);
    const size_t half = scene.store.size() / 2;
    scene.start([&](size_t i) { return i < half ? 273.15 : 373.15; });
    const double before = scene.heat.energy(scene.store);
    scene.run(seconds);
    const double drift = (scene.heat.energy(scene.store) - before) / (scene.mass() * 1e5);
    QVERIFY2(std::abs(drift) < 1e-12, qPrintable(QString::number(drift)));  // rounding of sums of double

    const double e1 = std::sqrt(left[0] * left[1]), e2 = std::sqrt(right[0] * right[1]);
    const double contact = 100 * e2 / (e1 + e2);
    Errors errors;
    size_t count = 0;
    for (size_t i = 0; i < scene.store.size(); ++i) {
      const double x = scene.store.position()[i].x;
      if (std::abs(x) > 0.04 || !scene.nearAxis(i, 12, 12, 3.1)) continue;
      const auto& side = x < 0 ? left : right;
      const double far = x < 0 ? 0 : 100;
      const double expected =
          contact + (far - contact) * std::erf(std::abs(x) / (2 * std::sqrt(side[0] / side[1] * seconds)));
      const double error = (scene.store.temperature()[i] - 273.15 - expected) / 100;
      errors.rms += error * error;
      errors.largest = std::max(errors.largest, std::abs(error));
      ++count;
    }
    errors.rms = std::sqrt(errors.rms / double(count));
    QVERIFY(count > 500);
    const QByteArray seen = QString("L2 %1 Linf %2").arg(errors.rms).arg(errors.largest).toUtf8();
    qInfo("%s", seen.constData());
    QFETCH(double, rms);
    QFETCH(double, largest);
    QVERIFY2(errors.rms < rms && errors.largest < largest, seen);
  }

  void wallsHoldTheirTemperatureOnThePlane() {
    // A slab of 20 particles between walls of 0 and 100 °C: 1000 W/m2 at k = 1 over 0.1 m.
    Scene scene;
    scene.addMaterial(heattest::materialOf({}));
    scene.addBox({0, 0, 0}, {20, 24, 24}, 0);
    scene.walls = {hotWall({1, 0, 0}, 0, 273.15), hotWall({-1, 0, 0}, -0.1, 373.15)};
    scene.start([&](size_t i) { return 273.15 + 1000 * double{scene.store.position()[i].x}; });
    const double seconds = 100;
    const ps::HeatLedger before = scene.heat.ledger();
    scene.run(seconds);
    const double flux = (scene.heat.ledger().exchanged - before.exchanged) / (2 * seconds * 0.12 * 0.12);
    QVERIFY2(std::abs(flux / 1000 - 1) < 0.04, qPrintable(QString::number(flux)));
    // Near the wall too the profile meets the wall's temperature on its plane: slip under 0.1 spacings of 5 K.
    double first = 0;
    int count = 0;
    for (size_t i = 0; i < scene.store.size(); ++i) {
      if (scene.store.position()[i].x < 0.005 && scene.nearAxis(i, 12, 12, 3.1)) {
        first += scene.store.temperature()[i] - 273.15;
        ++count;
      }
    }
    QVERIFY2(std::abs(first / count - 2.5) < 0.5, qPrintable(QString::number(first / count)));
  }

  /// A slab of 20 particles between fixed bodies of the same matter held at 0 and 100 °C: their temperature holds at
  /// the middle of their outermost particles, 21 spacings apart, so that 952.4 W/m2 flow at k = 1. 4 % as for walls;
  /// sweeps of 45 stable steps, where each pair comes near to its balance, carry some quarter less. What the baths give
  /// and take is all that comes in.
  void heldBodiesAreBaths_data() {
    QTest::addColumn<bool>("sweeping");
    QTest::newRow("explicit") << false;
    QTest::newRow("sweeps") << true;
  }
  void heldBodiesAreBaths() {
    QFETCH(bool, sweeping);
    Scene scene;
    scene.addMaterial(heattest::materialOf({}));
    addBetween(scene, {0, 0});
    scene.heat.bodyHeating().set(std::vector<ps::BodyHeat>{{}, {.held = 273.15}, {.held = 373.15}});
    scene.start(
        [&](size_t i) { return 273.15 + 100 * (double{scene.store.position()[i].x} / scene.spacing + 0.5) / 21; });
    scene.heat.advance(scene.store, scene.neighbours, 1e-9);  // the baths take their temperatures
    const double limit = scene.heat.gershgorinLimit(), before = scene.heat.energy(scene.store);
    const ps::HeatLedger start = scene.heat.ledger();
    const double frame = (sweeping ? 90 : 30) * scene.thermal.cfl * limit;
    const int frames = static_cast<int>(std::ceil(100 / frame));
    for (int k = 0; k < frames; ++k) scene.heat.advance(scene.store, scene.neighbours, frame);
    QCOMPARE(scene.heat.usedSweeps(), sweeping);
    for (size_t i = 0; i < scene.store.size(); ++i) {
      const double held = scene.store.body()[i] == 1 ? 273.15 : 373.15;
      if (scene.store.body()[i] > 0) QVERIFY(std::abs(scene.store.temperature()[i] - held) < 1e-9);
    }
    const ps::HeatLedger& end = scene.heat.ledger();
    const double flux = (end.exchanged - start.exchanged) / (2 * frames * frame * 0.12 * 0.12);
    qInfo("%.1f W/m2, should be 952.4", flux);
    QVERIFY2(flux / 952.4 > (sweeping ? 0.7 : 0.96) && flux / 952.4 < 1.04, qPrintable(QString::number(flux)));
    const double given = end.heaters - start.heaters;
    QVERIFY(std::abs(scene.heat.energy(scene.store) - before - given) < 1e-12 * scene.mass() * 1e5);
  }

  /// A bath that gets another temperature is there at once, in the phase that is stable there, and its heat is booked.
  /// Matter of its body that moves is none of it.
  void bathsFollowTheirSetting() {
    Scene scene;
    scene.addMaterial(heattest::materialOf(heattest::water()));
    addBetween(scene, {0, 0});
    const size_t loose = scene.store.size() - 1;
    scene.store.motion()[loose] = ps::api::Motion::Solid;
    scene.heat.bodyHeating().set(std::vector<ps::BodyHeat>{{}, {.held = 263.15}, {.held = 263.15}});
    scene.start([](size_t) { return 263.15; });
    scene.heat.advance(scene.store, scene.neighbours, 1.0 / 60);
    QCOMPARE(scene.heat.ledger().exchanged, 0.0);
    const double before = scene.heat.energy(scene.store);
    scene.heat.bodyHeating().set(std::vector<ps::BodyHeat>{{}, {.held = 263.15}, {.held = 300}});
    scene.heat.advance(scene.store, scene.neighbours, 1.0 / 60);
    for (size_t i = 0; i < scene.store.size(); ++i) {
      if (scene.store.body()[i] != 2 || i == loose) continue;
      QVERIFY(std::abs(scene.store.temperature()[i] - 300) < 1e-9);
      QCOMPARE(scene.store.liquidFraction()[i], 1.0f);
    }
    QVERIFY(scene.store.temperature()[loose] < 264);
    const double change = scene.heat.energy(scene.store) - before;
    QVERIFY(change > 300e3 * scene.mass() * 4 / 28 * 0.9);  // that much ice has melted
    QVERIFY(std::abs(change - scene.heat.ledger().heaters) < 1e-12 * scene.mass() * 1e6);
  }

  /// Nothing gets through fixed matter that is insulated, of its own material or another one, and air gives it nothing.
  void insulatedBodiesConductNothing_data() {
    QTest::addColumn<bool>("sameMaterial");
    QTest::addColumn<double>("frame");
    QTest::addColumn<bool>("ownLaw");
    for (const bool same : {true, false}) {
      QTest::addRow("%s, explicit", same ? "one material" : "two materials") << same << 1.0 << false;
      QTest::addRow("%s, sweeps", same ? "one material" : "two materials") << same << 200.0 << false;
    }
    QTest::newRow("a model's own law") << true << 0.001 << true;  // which is far quicker than conduction
  }
  void insulatedBodiesConductNothing() {
    QFETCH(bool, sameMaterial);
    QFETCH(double, frame);
    QFETCH(bool, ownLaw);
    OwnLaws own;
    Scene scene;
    if (ownLaw) scene.model = &own;
    scene.thermal.airConvection = 20;
    scene.addMaterial(heattest::materialOf({}));
    scene.addMaterial(heattest::materialOf({.conductivitySolid = 3}));
    const uint32_t other = sameMaterial ? 0 : 1;
    addBetween(scene, {other, other});
    scene.heat.bodyHeating().set(std::vector<ps::BodyHeat>{{}, {.insulated = true}, {.insulated = true}});
    const double kelvin[] = {350, 280, 400};
    scene.start([&](size_t i) { return kelvin[scene.store.body()[i]]; });
    const double before = scene.heat.energy(scene.store);
    for (int k = 0; k < 5; ++k) scene.heat.advance(scene.store, scene.neighbours, frame);
    QCOMPARE(scene.heat.usedSweeps(), frame > 100);
    for (size_t i = 0; i < scene.store.size(); ++i) {
      const uint32_t body = scene.store.body()[i];
      if (body > 0) QVERIFY(std::abs(scene.store.temperature()[i] - kelvin[body]) < 1e-9);
    }
    const ps::HeatLedger& books = scene.heat.ledger();
    QVERIFY(books.air < 0);  // what is bare of the slab cools
    QVERIFY(std::abs(scene.heat.energy(scene.store) - before - books.air) < 1e-12 * scene.mass() * 1e6);
  }

  void aPlateAboveBoilingHeatsWhatTouchesIt_data() {
    QTest::addColumn<double>("gas");
    QTest::addColumn<double>("conductivity");
    QTest::newRow("liquid conducts as liquid") << 0.0 << 0.6;
    QTest::newRow("half vapour, half as well") << 0.5 << 0.5 * (0.6 + 0.025);
    QTest::newRow("vapour insulates") << 1.0 << 0.025;
  }
  void aPlateAboveBoilingHeatsWhatTouchesIt() {
    // Matter at the boiling point on a plate 50 K hotter: heat is k times 50 K times what geometry alone gives,
    // measured with the same matter 50 K below boiling on a plate at it. 0.1 %: the plate warms it by a little
    // meanwhile.
    QFETCH(double, gas);
    QFETCH(double, conductivity);
    const auto heatOf = [&](double matter, double plate, double share) {
      Scene scene;
      scene.addMaterial(heattest::materialOf(heattest::water()));
      scene.addBox({0, 0, 0}, {6, 2, 6}, 0);
      scene.walls = {hotWall({0, 1, 0}, 0, plate)};
      scene.thermal.nucleation = 0;
      scene.start([=](size_t) { return matter; });
      const double shift = share * 2257e3;
      for (size_t i = 0; i < scene.store.size(); ++i) scene.enthalpyField()[i] += shift;
      scene.heat.derive(scene.store);
      scene.heat.advance(scene.store, scene.neighbours, 1e-6);
      return scene.heat.ledger().walls;
    };
    const double geometry = heatOf(323.15, 373.15, 0) / (0.6 * 50);
    const double driven = heatOf(373.15, 423.15, gas);
    QVERIFY2(std::abs(driven / (geometry * conductivity * 50) - 1) < 1e-3, qPrintable(QString::number(driven)));
  }

  void meltingFrontsFollowStefan_data() {
    QTest::addColumn<Matter>("matter");
    QTest::addColumn<double>("wall");
    QTest::addColumn<double>("seconds");
    QTest::addColumn<double>("front");
    QTest::addColumn<bool>("freezing");
    QTest::addColumn<double>("jitter");
    Matter water = heattest::water();
    Matter wax{0.24, 0.15, 0.02, 2100, 2300, 2000, 800, 331.15, 200e3, 0, 250e3};
    QTest::newRow("water, wall 20 K above") << water << 293.15 << 3000.0 << 0.0141215 << false << 0.0;
    QTest::newRow("water, wall 20 K above, jitter") << water << 293.15 << 3000.0 << 0.0141215 << false << 0.2;
    QTest::newRow("water, wall 50 K above") << water << 323.15 << 1500.0 << 0.0150185 << false << 0.0;
    QTest::newRow("wax, wall 20 K above") << wax << 351.15 << 6000.0 << 0.0144706 << false << 0.0;
    QTest::newRow("water freezing, wall 20 K below") << water << 253.15 << 500.0 << 0.011248 << true << 0.0;
  }
  void meltingFrontsFollowStefan() {
    QFETCH(Matter, matter);
    QFETCH(double, wall);
    QFETCH(double, seconds);
    QFETCH(double, front);
    QFETCH(bool, freezing);
    QFETCH(double, jitter);
    Scene scene;
    scene.spacing = 0.002;
    scene.thermal.cfl = 0.8;
    scene.addMaterial(heattest::materialOf(matter));
    scene.addBox({0, 0, 0}, {12, 20, 20}, 0, jitter);
    scene.walls = {hotWall({1, 0, 0}, 0, wall)};
    scene.start([&](size_t) { return matter.melting; },
                [&](size_t) { return freezing ? Phase::Liquid : Phase::Solid; });
    scene.run(seconds);
    double changed = 0;
    int columns = 0;
    for (size_t i = 0; i < scene.store.size(); ++i) {
      if (!scene.nearAxis(i, 10, 10, 2.01 + (jitter > 0 ? 2 : 0))) continue;
      changed += double{freezing ? scene.store.solidFraction()[i] : scene.store.liquidFraction()[i]} * scene.spacing;
      ++columns;
    }
    const double seen = changed / (columns / 12.0);
    // 3 % on a lattice, 5 % under disorder: the kernel's own error there is 1 % and 2 %.
    const QByteArray text = QString("front %1 mm, expected %2 mm").arg(1000 * seen).arg(1000 * front).toUtf8();
    qInfo("%s", text.constData());
    QVERIFY2(std::abs(seen / front - 1) < (jitter > 0 ? 0.05 : 0.03), text);
  }

  void calorimetryEndsWhereTheMeanEnthalpyLies_data() {
    QTest::addColumn<QList<int>>("box");
    QTest::addColumn<int>("ice");  // layers along z, of particles of equal mass; the rest is the other body
    QTest::addColumn<QList<double>>("celsius");
    QTest::addColumn<bool>("steam");
    QTest::addColumn<double>("end");
    QTest::addColumn<double>("iceLeft");
    const QList<int> box{4, 4, 12};
    QTest::newRow("1 kg ice, 1 kg cool water") << box << 6 << QList<double>{-10, 20} << false << 0.0 << 0.406108;
    QTest::newRow("1 kg ice, 1 kg hot water") << box << 6 << QList<double>{-10, 90} << false << 2.596751 << 0.0;
    QTest::newRow("1 kg ice, 3 kg water") << box << 3 << QList<double>{-10, 50} << false << 16.29838 << 0.0;
    QTest::newRow("3 kg ice, 1 kg water") << box << 9 << QList<double>{-10, 20} << false << 0.0 << 0.734491;
    QTest::newRow("5 kg ice, 0.25 kg water")
        << QList<int>{3, 3, 21} << 20 << QList<double>{-10, 5} << false << -1.47551 << 1.0;
    QTest::newRow("1 kg ice, 0.2 kg steam") << box << 10 << QList<double>{-10, 100} << true << 35.85762 << 0.0;
  }
  void calorimetryEndsWhereTheMeanEnthalpyLies() {
    QFETCH(QList<int>, box);
    QFETCH(int, ice);
    QFETCH(QList<double>, celsius);
    QFETCH(bool, steam);
    Scene scene;
    scene.spacing = 0.1;
    Matter matter = heattest::water();
    // The end does not depend on conductivity; a vapour that conducts lets the last row finish.
    matter.conductivitySolid = matter.conductivityLiquid = matter.conductivityGas = 100;
    scene.addMaterial(heattest::materialOf(matter));
    scene.addBox({0, 0, 0}, {box[0], box[1], box[2]}, 0);
    const auto isIce = [&](size_t i) { return static_cast<int>(i) < ice * box[0] * box[1]; };
    scene.start([&](size_t i) { return 273.15 + celsius[isIce(i) ? 0 : 1]; },
                [&](size_t i) { return isIce(i) ? Phase::Solid
                                       : steam  ? Phase::Gas
                                                : Phase::Liquid; });
    const double before = scene.heat.energy(scene.store);
    const double* t = scene.store.temperature();
    double spread = 1;
    int steps = 0;
    for (; spread > 1e-3 && steps < 20000; ++steps) {
      scene.heat.advance(scene.store, scene.neighbours, steps == 0 ? 1e-9 : 0.5 * scene.heat.gershgorinLimit());
      const auto ends = std::minmax_element(t, t + scene.store.size());
      spread = *ends.second - *ends.first;
    }
    QVERIFY2(steps < 20000, "no balance reached");
    const double drift = (scene.heat.energy(scene.store) - before) / (scene.mass() * 334e3);
    QVERIFY2(std::abs(drift) < 1e-12, qPrintable(QString::number(drift)));
    QFETCH(double, end);
    QFETCH(double, iceLeft);
    const double mean = scene.mean(t) - 273.15;
    QVERIFY2(std::abs(mean - end) < 0.02, qPrintable(QString::number(mean)));
    QVERIFY(std::abs(scene.mean(scene.store.solidFraction()) - iceLeft) < 0.002);
    QCOMPARE(scene.mean(scene.store.gasFraction()), 0.0);
  }

  /// Ice, water, steam and iron in one closed box, stirred by shuffling, for a minute of frames: nothing is lost.
  void closedSystemsKeepTheirEnergyToRounding() {
    Scene scene;
    scene.thermal.timeScale = 1000;
    scene.addMaterial(heattest::materialOf(heattest::water()));
    Matter iron{10, 10, 1, 449, 449, 449, 7874, 0, 0, 0, 1};
    scene.addMaterial(heattest::materialOf(iron));
    scene.addBox({0, 0, 0}, {10, 10, 10}, 0, 0.1);
    for (size_t i = 0; i < 1000; ++i) scene.store.material()[i] = i % 7 == 0 ? 1 : 0;
    scene.start([](size_t i) { return 230.0 + 300.0 * double((i * 7919) % 1000) / 1000; });
    const double before = scene.heat.energy(scene.store);
    double turnover = 0;
    for (size_t i = 0; i < 1000; ++i) turnover += std::abs(scene.enthalpyField()[i]) * double{scene.store.mass()[i]};
    heattest::Noise noise;
    bool melted = false, boiled = false;
    for (int frame = 0; frame < 3600; ++frame) {
      scene.heat.advance(scene.store, scene.neighbours, 1.0 / 60);
      if (frame % 10 != 0) continue;
      // Swap some pairs of places: matter moves, mass and heat with it.
      for (int k = 0; k < 20; ++k) {
        const auto pick = [&] { return static_cast<size_t>((noise.next() + 1) * 499.9); };
        std::swap(scene.store.position()[pick()], scene.store.position()[pick()]);
      }
      scene.neighbours.sortAndBuild(scene.store);
      for (size_t i = 0; i < 1000; ++i) {
        melted |= scene.store.liquidFraction()[i] > 0 && scene.store.solidFraction()[i] > 0;
        boiled |= scene.store.liquidFraction()[i] > 0 && scene.store.gasFraction()[i] > 0;
      }
    }
    QVERIFY(melted && boiled);
    const double drift = (scene.heat.energy(scene.store) - before) / turnover;
    qInfo("drift %g", drift);
    QVERIFY2(std::abs(drift) < 1e-12, qPrintable(QString::number(drift)));
    QCOMPARE(scene.heat.ledger().exchanged, 0.0);
  }

  /// Walls, film and air: what the particles gained is what the books say, over a minute of frames.
  void booksMatchTheEnergyThatCrossedTheWalls() {
    Scene scene;
    scene.thermal.timeScale = 2000;
    scene.thermal.airConvection = 5;
    scene.addMaterial(heattest::materialOf(heattest::water()));
    scene.addBox({0, 0, 0}, {8, 8, 8}, 0, 0.1);
    scene.walls = {hotWall({0, 1, 0}, 0, 430), hotWall({0, -1, 0}, -8 * scene.spacing, 300)};
    scene.start([&](size_t i) { return scene.store.position()[i].y < 0.02 ? 263.15 : 390.0; });
    const double before = scene.heat.energy(scene.store);
    const double gas = scene.mean(scene.store.gasFraction()), ice = scene.mean(scene.store.solidFraction());
    for (int frame = 0; frame < 3600; ++frame) {
      scene.heat.advance(scene.store, scene.neighbours, 1.0 / 60);
    }
    QVERIFY(scene.mean(scene.store.gasFraction()) < gas && scene.mean(scene.store.solidFraction()) < ice);
    const ps::HeatLedger& books = scene.heat.ledger();
    QVERIFY(books.walls != 0 && books.air < 0);
    const double open = (scene.heat.energy(scene.store) - before - books.net()) / books.exchanged;
    qInfo("open %g", open);
    QVERIFY2(std::abs(open) < 1e-12, qPrintable(QString::number(open)));
  }

  /// Why the limit is there: at three times of it the fastest pattern at least doubles in every step.
  void stepsOfThreeLimitsExplode() {
    Scene scene;
    scene.thermal.cfl = 3;
    scene.addMaterial(heattest::materialOf({}));
    scene.addBox({0, 0, 0}, {12, 6, 6}, 0, 0.2);
    scene.start([&](size_t i) { return scene.store.position()[i].x < 0.03 ? 273.15 : 373.15; });
    scene.heat.advance(scene.store, scene.neighbours, 1e-9);
    const double frame = 30 * 3 * scene.heat.gershgorinLimit();
    for (int k = 0; k < 3; ++k) scene.heat.advance(scene.store, scene.neighbours, frame);
    QVERIFY(*std::max_element(scene.store.temperature(), scene.store.temperature() + scene.store.size()) > 1000);
  }

  void explicitStepsStayBounded_data() {
    QTest::addColumn<double>("cfl");
    QTest::addColumn<double>("timeScale");
    QTest::newRow("0.9 of the limit") << 0.9 << 1.0;
    QTest::newRow("sweeps") << 0.5 << 2e4;
    QTest::newRow("many explicit steps") << 0.9 << 5e4;
    QTest::newRow("far too fast") << 0.5 << 1e9;
  }
  void explicitStepsStayBounded() {
    QFETCH(double, cfl);
    QFETCH(double, timeScale);
    Scene scene;
    scene.thermal.cfl = cfl;
    scene.thermal.timeScale = timeScale;
    const bool explicitly = timeScale > 1 && cfl > 0.5;
    if (explicitly) scene.thermal.steps = ps::HeatSteps::Explicit;
    scene.addMaterial(heattest::materialOf({}));
    scene.addBox({0, 0, 0}, {12, 6, 6}, 0, 0.2);
    scene.start([&](size_t i) { return scene.store.position()[i].x < 0.03 ? 273.15 : 373.15; });
    const double before = scene.heat.energy(scene.store);
    scene.heat.advance(scene.store, scene.neighbours, 1e-9);
    const double frame = timeScale > 1 ? 1.0 / 60 : 30 * cfl * scene.heat.gershgorinLimit();
    bool swept = false;
    double slowest = timeScale;
    for (int k = 0; k < 100; ++k) {  // in the end all is equally warm, and nothing is left to do
      scene.heat.advance(scene.store, scene.neighbours, frame);
      swept = swept || scene.heat.usedSweeps();
      slowest = std::min(slowest, scene.heat.thermalTimeScaleDelivered());
    }
    const double* t = scene.store.temperature();
    QVERIFY(*std::min_element(t, t + scene.store.size()) >= 273.15 - 1e-6);
    QVERIFY(*std::max_element(t, t + scene.store.size()) <= 373.15 + 1e-6);
    QVERIFY(std::abs(scene.heat.energy(scene.store) - before) < 1e-12 * scene.mass() * 1e5);
    QCOMPARE(swept, timeScale > 1 && !explicitly);
    if (timeScale > 1e6)
      QVERIFY(slowest < timeScale);
    else
      QCOMPARE(slowest, timeScale);
  }

  /// What is as warm as all around it is left alone, and wakes whatever changes.
  void balanceIsLeftAloneUntilItEnds_data() {
    QTest::addColumn<std::function<void(Scene&)>>("change");
    const auto row = [](const char* name, const std::function<void(Scene&)>& change) { QTest::newRow(name) << change; };
    row("air", [](Scene& scene) { scene.thermal.ambientTemperature += 1; });
    row("wall", [](Scene& scene) { scene.walls[0].temperature += 1; });
    row("flux of a wall", [](Scene& scene) {
      scene.walls[0].heat = ps::WallHeat::FixedFlux;
      scene.walls[0].flux = 100;
    });
    row("fluid behind a wall", [](Scene& scene) {
      scene.walls[0].heat = ps::WallHeat::Convective;
      scene.walls[0].temperature += 1;
    });
    row("lump of air", [](Scene& scene) {
      scene.thermal.airHeatCapacity = 1000;
      scene.thermal.ambientTemperature -= 1;
    });
    row("surroundings", [](Scene& scene) {
      scene.thermal.radiation = true;
      scene.thermal.surroundingsTemperature += 1;
    });
    row("heated body", [](Scene& scene) {
      const ps::BodyHeat warmed[] = {{.watts = 1}};
      scene.heat.bodyHeating().set(warmed);
    });
    row("bath", [](Scene& scene) {
      const ps::BodyHeat bath[] = {{.held = 294.15}};
      scene.store.motion()[7] = ps::api::Motion::Static;
      scene.heat.bodyHeating().set(bath);
    });
    row("one particle", [](Scene& scene) {
      const double warmer = 294.15;
      const ps::api::Phase phase = ps::api::Phase::Liquid;
      scene.heat.initialise(scene.store, 7, 8, {&warmer, 1}, {&phase, 1});
    });
  }
  void balanceIsLeftAloneUntilItEnds() {
    QFETCH(std::function<void(Scene&)>, change);
    Scene scene;
    scene.thermal.airConvection = 20;
    ps::Wall& wall = scene.walls.emplace_back();
    wall.heat = ps::WallHeat::FixedTemperature;
    scene.addMaterial(heattest::materialOf({}));
    scene.addBox({0, 0, 0}, {6, 6, 6}, 0);
    scene.start([](size_t) { return 293.15; });
    const double before = scene.heat.energy(scene.store);
    for (int k = 0; k < 5; ++k) scene.heat.advance(scene.store, scene.neighbours, 1.0 / 60);
    QCOMPARE(scene.heat.energy(scene.store), before);
    QCOMPARE(scene.heat.ledger().exchanged, 0.0);
    QCOMPARE(scene.heat.gershgorinLimit(), 0.0);  // nothing was measured
    change(scene);
    scene.configure();
    scene.neighbours.build(scene.store);
    scene.heat.advance(scene.store, scene.neighbours, 1.0 / 60);
    QVERIFY(scene.heat.ledger().exchanged > 0);
    QVERIFY(scene.heat.gershgorinLimit() > 0);
  }

  /// Exponential sweeps of 15 times the stable step against explicit steps, across a plateau.
  void sweepsAgreeWithExplicitSteps() {
    double melted[2]{};
    for (const bool sweeping : {false, true}) {
      Scene scene;
      scene.addMaterial(heattest::materialOf(heattest::water()));
      scene.addBox({0, 0, 0}, {20, 6, 6}, 0);
      scene.start([&](size_t i) { return scene.store.position()[i].x < 0.05 ? 263.15 : 333.15; },
                  [&](size_t i) { return scene.store.position()[i].x < 0.05 ? Phase::Solid : Phase::Liquid; });
      scene.heat.advance(scene.store, scene.neighbours, 1e-9);
      const double step = 0.5 * scene.heat.gershgorinLimit();
      const double seconds = 900 * step, frame = (sweeping ? 90 : 10) * step;
      for (double done = 0; done < seconds - 0.5 * frame; done += frame) {
        scene.heat.advance(scene.store, scene.neighbours, frame);
        QCOMPARE(scene.heat.usedSweeps(), sweeping);
      }
      melted[sweeping] = scene.mean(scene.store.liquidFraction()) - 0.5;
    }
    // A sweep of 15 stable steps errs by about 0.5 % of what melted.
    QVERIFY2(std::abs(melted[1] / melted[0] - 1) < 0.02, qPrintable(QString("%1 %2").arg(melted[0]).arg(melted[1])));
  }

  void modelsMayBringTheirOwnLaws() {
    Scene scene;
    const OwnLaws own;
    const Heater heater;
    scene.model = &own;
    scene.heat.setSources({{&heater, "one", {1}}, {&heater, "two", {2}}}, scene.store);
    scene.addMaterial(heattest::materialOf({}));
    scene.addBox({0, 0, 0}, {2, 1, 1}, 0);
    scene.store.mass()[0] = scene.store.mass()[1] = 0.5f;
    scene.start([](size_t i) { return i == 0 ? 300.0 : 400.0; });
    const double seconds = 1e-3;
    scene.heat.advance(scene.store, scene.neighbours, seconds);
    // 500 J/K each: 2 W/K times 100 K, and 3 W, in one explicit step.
    QVERIFY(std::abs(scene.store.temperature()[0] - 300 - 203 * seconds / 500) < 1e-10);
    QVERIFY(std::abs(scene.store.temperature()[1] - 400 + 197 * seconds / 500) < 1e-10);
    QVERIFY(std::abs(scene.heat.ledger().heaters - 6 * seconds) < 1e-12);
    QCOMPARE(scene.heat.ledger().net(), scene.heat.ledger().heaters);
  }

  /// What shows a source's field shows it before the first frame, and matter that is born later has it too.
  void fieldsOfSourcesAreThereFromTheStart() {
    const Heater heater;
    Scene scene;
    scene.heat.setSources({{&heater, "heater", {1}}}, scene.store);
    QVERIFY(scene.store.read("heater.glow", ps::api::FieldType::Float32));
    scene.addBox({0, 0, 0}, {2, 1, 1}, 0);
    QCOMPARE(static_cast<const float*>(scene.store.read("heater.glow", ps::api::FieldType::Float32))[1], 0.0f);
  }

  void sourcesAddToAnyModelAndNoneColdsBelowOneKelvin() {
    const Heater heater;
    const ps::thermal::ThesisLatentModel thesis;
    for (const bool enthalpy : {true, false}) {
      Scene scene;
      if (!enthalpy) scene.model = &thesis;
      scene.addMaterial(heattest::materialOf({}));
      scene.addBox({0, 0, 0}, {1, 1, 1}, 0);
      scene.store.mass()[0] = 0.5f;  // 500 J/K
      scene.start([](size_t) { return 300.0; });
      scene.heat.setSources({{&heater, "heater", {500}}}, scene.store);
      scene.heat.advance(scene.store, scene.neighbours, 1);
      QVERIFY(std::abs(scene.store.temperature()[0] - 301) < 1e-9);
      scene.heat.setSources({{&heater, "heater", {500}}, {&heater, "blown", {2e6}}, {&heater, "cooler", {-1e6}}},
                            scene.store);
      QVERIFY(scene.heat.advance(scene.store, scene.neighbours, 1));
      const std::vector<ps::PluginFault> faults = scene.heat.drainSourceFaults();
      QCOMPARE(faults.size(), size_t{1});
      QCOMPARE(faults[0].plugin, std::string("blown"));
      QCOMPARE(faults[0].what, std::string("the fuse has blown"));
      QVERIFY(scene.store.temperature()[0] >= 1);
      QVERIFY(scene.heat.drainSourceFaults().empty());
    }
  }

  void anotherModelTakesOverTemperaturesAndBooksTheDifference() {
    Scene scene;
    scene.addMaterial(heattest::materialOf(heattest::water()));
    scene.addBox({0, 0, 0}, {6, 6, 6}, 0);
    scene.start([](size_t i) { return 250.0 + 0.5 * double(i); });
    scene.thermal.timeScale = 500;
    scene.configure();
    std::vector<uint32_t> melted;
    for (int frame = 0; frame < 60; ++frame) scene.heat.advance(scene.store, scene.neighbours, 1.0 / 60);
    scene.phase.update(scene.store, melted);
    const double before = scene.heat.energy(scene.store), t = scene.mean(scene.store.temperature());
    const ps::thermal::ThesisLatentModel thesis;
    scene.model = &thesis;
    scene.configure();
    QCOMPARE(scene.heat.energy(scene.store), before);
    scene.heat.derive(scene.store);
    QVERIFY(std::abs(scene.mean(scene.store.temperature()) - t) < 1e-9);
    const double open = scene.heat.energy(scene.store) - before - scene.heat.ledger().net();
    QVERIFY2(std::abs(open) < 1e-12 * std::abs(before), qPrintable(QString::number(open)));
  }

  void everyNumberOfThreadsGivesTheSameBits() {
    std::vector<double> first;
    for (const int threads : {1, 2, 8}) {
      ps::setThreadCount(threads);
      Scene scene;
      scene.thermal.timeScale = 2000;
      scene.addMaterial(heattest::materialOf(heattest::water()));
      scene.addBox({0, 0, 0}, {12, 12, 12}, 0, 0.15);
      scene.walls = {hotWall({0, 1, 0}, 0, 430)};
      scene.start([](size_t) { return 370.0; });
      for (int frame = 0; frame < 120; ++frame) scene.heat.advance(scene.store, scene.neighbours, 1.0 / 60);
      std::vector<double> h(scene.enthalpyField(), scene.enthalpyField() + scene.store.size());
      h.push_back(scene.heat.ledger().walls);
      if (first.empty()) first = h;
      QVERIFY(first == h);
    }
    ps::setThreadCount(0);
  }
};

QTEST_APPLESS_MAIN(TestHeat)
#include "tst_heat.moc"
