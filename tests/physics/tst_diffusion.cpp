// SPDX-License-Identifier: Apache-2.0
// The thesis's plain diffusion, a pair law of a model's own, against the error function and for its energy.
#include "heatscene.h"
#include "thesisdiffusionmodel.h"

#include <QTest>

#include <algorithm>
#include <cmath>

using heattest::Matter;
using heattest::Scene;

class TestDiffusion : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  /// The erf profile of reference case d1 by the thesis's diffusion, whatever the conductivities: L2 <= 0.5 %, as the
  /// lattice of the host's own conduction has to reach.
  void plainDiffusionFollowsTheErrorFunction() {
    const ps::thermal::ThesisDiffusionModel diffusion;
    Scene scene;
    scene.spacing = 0.0025;
    scene.model = &diffusion;
    scene.modelParameters = {1e-6};
    Matter one, other;
    one.conductivityLiquid = 0.001, other.conductivityLiquid = 30;
    for (const Matter& matter : {one, other}) scene.addMaterial(heattest::materialOf(matter));
    scene.addBox({-20, 0, 0}, {20, 10, 10}, 0);
    scene.addBox({0, 0, 0}, {20, 10, 10}, 1);
    scene.start([&](size_t i) { return scene.store.position()[i].x < 0 ? 273.15 : 373.15; });
    const double before = scene.heat.energy(scene.store);
    scene.run(100);
    double squares = 0, count = 0;
    for (size_t i = 0; i < scene.store.size(); ++i) {
      const double x = scene.store.position()[i].x;
      if (!scene.nearAxis(i, 5, 5, 2) || std::abs(x) > 0.04) continue;
      const double exact = 323.15 + 50 * std::erf(x / (2 * std::sqrt(1e-6 * 100)));
      squares += std::pow((scene.store.temperature()[i] - exact) / 100, 2), ++count;
    }
    const double rms = std::sqrt(squares / count);
    qInfo("L2 %g", rms);
    QVERIFY2(count > 300 && rms < 0.005, qPrintable(QString::number(rms)));
    QVERIFY(std::abs(scene.heat.energy(scene.store) - before) < 1e-12 * scene.mass() * 1e5);
  }

  /// A diffusivity a thousand times that of the host's conduction: the steps follow it, no temperature leaves the range
  /// of the start, and melting and boiling in unlike matter keep the energy to rounding.
  void strongDiffusionIsStableAndKeepsItsEnergy_data() {
    QTest::addColumn<double>("diffusivity");
    QTest::addColumn<double>("jitter");
    QTest::newRow("weak") << 1e-8 << 0.0;
    QTest::newRow("as water conducts") << 1.4e-7 << 0.2;
    QTest::newRow("a thousand times stronger") << 1.4e-4 << 0.2;
  }
  void strongDiffusionIsStableAndKeepsItsEnergy() {
    QFETCH(double, diffusivity);
    QFETCH(double, jitter);
    const ps::thermal::ThesisDiffusionModel diffusion;
    Scene scene;
    scene.model = &diffusion;
    scene.modelParameters = {diffusivity};
    scene.thermal.nucleation = 0;
    scene.addMaterial(heattest::materialOf(heattest::water()));
    Matter metal;
    metal.conductivitySolid = metal.conductivityLiquid = 80, metal.density = 7800, metal.capacityLiquid = 450;
    scene.addMaterial(heattest::materialOf(metal));
    scene.addBox({0, 0, 0}, {8, 6, 6}, 0, jitter);
    scene.addBox({8, 0, 0}, {4, 6, 6}, 1, jitter);
    scene.start([&](size_t i) {
      return scene.store.material()[i] == 1 ? 800 : scene.store.position()[i].x < 0.02 ? 253 : 300;
    });
    const double before = scene.heat.energy(scene.store);
    double amount = 0;
    for (const double energy : scene.heat.energies(scene.store)) amount += std::abs(energy);
    double delivered = 0;
    for (int k = 0; k < 60; ++k) {
      scene.heat.advance(scene.store, scene.neighbours, 0.5);
      delivered += 0.5 * scene.heat.thermalTimeScaleDelivered();
    }
    QVERIFY(!scene.heat.usedSweeps() && delivered > 0);
    const double* t = scene.store.temperature();
    QVERIFY(*std::min_element(t, t + scene.store.size()) >= 253 - 1e-6);
    QVERIFY(*std::max_element(t, t + scene.store.size()) <= 800 + 1e-6);
    QVERIFY(std::abs(scene.heat.energy(scene.store) - before) < 1e-12 * amount);
    if (diffusivity > 1e-5) QVERIFY(scene.mean(scene.store.gasFraction()) > 0.01);  // it did happen
  }
};

QTEST_APPLESS_MAIN(TestDiffusion)
#include "tst_diffusion.moc"
