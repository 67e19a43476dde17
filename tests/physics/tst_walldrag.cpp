// SPDX-License-Identifier: Apache-2.0
// What liquid feels of walls that are made of particles: as much as of planes.
#include "viscosityscene.h"

#include <QTest>

#include <cmath>

using namespace viscous;
using ps::Solver;
using ps::SolverSettings;

class TestWallDrag : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  /// Flow between two plates, U = g h2/(12 nu) in the mean (Poiseuille), with plates of fixed particles or planes. Held
  /// at the centres of fixed particles, the liquid has a channel wider by a spacing: 1.58 of this at four layers, 1.31
  /// at eight. Driven hard enough that the order of its particles does not hold it. The tolerance is that of planes.
  void channelsFlowAsPoiseuilleSays_data() {
    QTest::addColumn<bool>("particles");
    QTest::addColumn<int>("layers");
    for (const int layers : {4, 8, 12}) {
      QTest::addRow("particles, %d layers", layers) << true << layers;
      QTest::addRow("planes, %d layers", layers) << false << layers;
    }
  }
  void channelsFlowAsPoiseuilleSays() {
    QFETCH(bool, particles);
    QFETCH(int, layers);
    constexpr double kSpacing = 0.02, kNu = 0.02, kDrive = 5;  // m, m2/s, m/s2
    constexpr int kAcross = 8;
    const double height = layers * kSpacing, half = kAcross * kSpacing / 2;
    Solver solver;
    SolverSettings settings = settingsOf(kSpacing);
    settings.gravity = {kDrive, 0, 0};
    prepare(solver, settings, syrup(1000 * kNu));
    ps::Bounds bounds;
    bounds.minimum = {-half, -1, -half};
    bounds.maximum = {half, 1, half};
    bounds.periodic = {true, false, true};
    solver.setBounds(bounds);
    if (particles) {
      for (const double bottom : {-3 * kSpacing, height})
        solver.spawn(fixedPoints(lattice(kAcross, 3, kAcross, kSpacing, bottom)));
    } else {
      ps::Wall floor, lid;
      lid.normal = {0, -1, 0};
      lid.offset = -height;
      solver.setWalls({floor, lid});
    }
    solver.spawn(liquid(lattice(kAcross, layers, kAcross, kSpacing, 0)));
    // exp(-pi2 nu t/h2) = 0.01 of the way is left.
    QVERIFY(run(solver, static_cast<int>(std::ceil(60 * 4.6 * height * height / (kPi * kPi * kNu)))));
    double sum = 0, count = 0;
    const ps::ParticleStore& p = solver.particles();
    for (size_t i = 0; i < p.size(); ++i) {
      if (p.motion()[i] != ps::api::Motion::Liquid) continue;
      sum += double{p.velocity()[i].x}, ++count;
    }
    const double expected = kDrive * height * height / (12 * kNu);
    QVERIFY2(std::abs(sum / count / expected - 1) < 0.15, qPrintable(QString::number(sum / count / expected)));
  }
};

QTEST_APPLESS_MAIN(TestWallDrag)
#include "tst_walldrag.moc"
