// SPDX-License-Identifier: Apache-2.0
// Beams held at one end: how far they sag, and what is told of it.
#include "onehash.h"
#include "softscene.h"

#include <QtTest>

#include <cmath>

using namespace soft;
using ps::constraint::BondModel;

namespace {

constexpr double kDensity = 1000, kSpacing = 0.02;

struct Beam {
  int thick = 3, length = 12;  ///< particles
  double modulus = 1e6;        ///< Pa
  int substeps = 4, iterations = 4;
  double ratio = 100;  ///< max_stiffness_ratio
  double sag = 0.004;  ///< of its length, in theory
};

/// Of the tip when it has come to rest, as a share of what Euler and Bernoulli expect of the beam's outer measures,
/// q x²(6 L² - 4 L x + x²)/(24 E I).
struct Sag {
  double share = 0;
  std::vector<ps::Limit> limits;
};

Sag sagOf(const Beam& beam) {
  const double h = beam.thick * kSpacing, length = beam.length * kSpacing, asked = beam.sag * length;
  const double gravity = asked * beam.modulus * h * h / (1.5 * kDensity * std::pow(length, 4));
  const double slowest = std::sqrt(gravity / asked);  // rad/s, nearly
  ps::SolverSettings settings = settingsOf(kSpacing);
  settings.substeps = beam.substeps;
  settings.iterations = beam.iterations;
  settings.gravity = {0, -gravity, 0};
  settings.damping = 1.5 * slowest;
  ps::Solver solver;
  prepare(solver, settings, matter(kDensity, beam.modulus));
  const BondModel bonds;
  const uint32_t set =
      solver.addConstraintSet(&bonds, "bonds", parametersOf(bonds, {{BondModel::kStiffnessRatio, beam.ratio}}));
  const double low = 0.5 * kSpacing;
  solver.spawn(solid(grid(beam.length + 2, beam.thick, beam.thick, kSpacing, {low - 2 * kSpacing, low, low}), set));
  pin(solver, [](const Vector3& x) { return x.x() < 0; });
  const int frames = static_cast<int>(60 / slowest / settings.dt);  // whatever is ten times as soft has come to rest
  for (int f = 0; f < frames; ++f) solver.step();
  double sag = 0;
  int count = 0;
  const ps::ParticleStore& p = solver.particles();
  double farthest = 0;
  for (size_t i = 0; i < p.size(); ++i) farthest = std::max(farthest, double{p.position()[i].x});
  for (size_t i = 0; i < p.size(); ++i) {
    if (double{p.position()[i].x} < farthest - 0.5 * kSpacing) continue;
    sag += 0.5 * h - double{p.position()[i].y};
    ++count;
  }
  const double x = 1 - 0.5 / beam.length, expected = asked * x * x * (6 - 4 * x + x * x) / 3;
  return {sag / count / expected, solver.limits()};
}

/// J, of motion and of the bonds.
double energyOf(ps::Solver& solver) {
  double sum = solver.elasticEnergy();
  const ps::ParticleStore& p = solver.particles();
  for (size_t i = 0; i < p.size(); ++i) sum += 0.5 * double{p.mass()[i]} * vectorOf(p.velocity()[i]).squaredNorm();
  return sum;
}

uint64_t hashOfBeam() {
  static const BondModel bonds;
  ps::Solver solver;
  prepare(solver, settingsOf(kSpacing), matter(kDensity, 1e6));
  const uint32_t set = solver.addConstraintSet(&bonds, "bonds", parametersOf(bonds));
  solver.spawn(solid(grid(16, 9, 9, kSpacing, {-0.01, 0, 0}), set));
  pin(solver, [](const Vector3& x) { return x.x() < 0; });
  return run(solver, 20) ? solver.stateHash() : 0;
}

}  // namespace

class TestBeams : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { ps::setThreadCount(2); }
  void cleanup() { ps::setInstructionSet(""); }

  void whatIsNotDeliveredIsTold_data() {
    QTest::addColumn<double>("modulus");
    QTest::addColumn<int>("substeps");
    QTest::addColumn<int>("iterations");
    QTest::addColumn<double>("ratio");
    QTest::addRow("soft") << 5e4 << 4 << 4 << 100.0;
    QTest::addRow("defaults") << 6e5 << 4 << 4 << 100.0;
    QTest::addRow("many substeps") << 6e5 << 16 << 4 << 100.0;
    QTest::addRow("resolved up to 8") << 1.2e6 << 4 << 4 << 8.0;
    QTest::addRow("resolved up to 8, many iterations") << 1.2e6 << 4 << 12 << 8.0;
    QTest::addRow("resolved up to 3, one iteration") << 6e5 << 8 << 1 << 3.0;
    QTest::addRow("resolved up to 20") << 2e6 << 4 << 4 << 20.0;
  }
  /// Against the same beam in steps so small that all is delivered. The estimate leaves out the order in which bonds
  /// are gone over, worth 15 %, and large bends, worth as much at a sag of a fifth of the length.
  void whatIsNotDeliveredIsTold() {
    QFETCH(double, modulus);
    QFETCH(int, substeps);
    QFETCH(int, iterations);
    QFETCH(double, ratio);
    const Sag sag = sagOf({3, 12, modulus, substeps, iterations, ratio}), whole = sagOf({3, 12, modulus, 48, 8, 100});
    QVERIFY(whole.limits.empty());
    const double softer = sag.share / whole.share;
    qInfo("%.2f times as soft, told %.2f", softer,
          sag.limits.empty() ? 1 : sag.limits[0].asked / sag.limits[0].delivered);
    if (sag.limits.empty()) {
      QVERIFY2(softer < 1.25, qPrintable(QString::number(softer)));
      return;
    }
    QCOMPARE(sag.limits.size(), size_t{1});
    QCOMPARE(sag.limits[0].what, std::string("water.youngs_modulus"));
    QCOMPARE(sag.limits[0].asked, modulus);
    QVERIFY2(softer > 1.2, qPrintable(QString::number(softer)));
    QVERIFY(std::abs(sag.limits[0].asked / sag.limits[0].delivered / softer - 1) < 0.3);
  }

  /// So few layers bend more easily than their modulus says, whatever the steps; a clamp that is sharp adds to it.
  void thinBeamsSayThatTheyAreSofter() {
    const Sag sag = sagOf({.thick = 2, .length = 20});
    QCOMPARE(sag.limits.size(), size_t{1});
    QCOMPARE(sag.limits[0].what, std::string("water.youngs_modulus"));
    QCOMPARE(sag.limits[0].asked, 1e6);
    qInfo("sags %.2f times theory, delivered is told as %g", sag.share, sag.limits[0].delivered);
    QVERIFY(std::abs(sag.share * sag.limits[0].delivered / sag.limits[0].asked - 1) < 0.1);
  }

  void sagsAsTheoryExpects_data() {
    QTest::addColumn<int>("thick");
    QTest::addColumn<int>("length");
    QTest::addColumn<double>("modulus");
    QTest::addColumn<int>("substeps");
    QTest::addColumn<int>("iterations");
    QTest::addRow("long") << 4 << 40 << 1e6 << 4 << 4;
    QTest::addRow("soft") << 4 << 24 << 1e5 << 4 << 4;
    QTest::addRow("stiff") << 4 << 24 << 5e6 << 4 << 4;
    QTest::addRow("few passes") << 4 << 24 << 1e6 << 2 << 2;
    QTest::addRow("many substeps") << 4 << 24 << 1e6 << 12 << 2;
    QTest::addRow("thick") << 6 << 36 << 1e6 << 4 << 4;
  }
  /// Four particles across carry 15 % less than a beam of their outer measures, shear adds 3 % at six times as long.
  void sagsAsTheoryExpects() {
    QFETCH(int, thick);
    QFETCH(int, length);
    QFETCH(double, modulus);
    QFETCH(int, substeps);
    QFETCH(int, iterations);
    const Sag sag = sagOf({thick, length, modulus, substeps, iterations, 100, 0.02});
    qInfo("%.3f of theory", sag.share);
    QVERIFY(sag.limits.empty());
    QVERIFY2(std::abs(sag.share - 1) < 0.25, qPrintable(QString::number(sag.share)));
  }

  /// Let go from a bend and a stretch, with nothing to damp it: what is carried is as good as an implicit step, which
  /// takes energy out of what is fast and adds none. A thousandth is for rounded places.
  void heldBlockGainsNoEnergy_data() {
    QTest::addColumn<double>("modulus");
    QTest::newRow("soft") << 3e5;
    QTest::newRow("firm") << 1.5e6;
    QTest::newRow("stiff") << 4e6;
  }
  void heldBlockGainsNoEnergy() {
    QFETCH(double, modulus);
    ps::Solver solver;
    ps::SolverSettings settings = settingsOf(kSpacing);
    settings.gravity = {0, 0, 0};
    prepare(solver, settings, matter(kDensity, modulus));
    const BondModel bonds;
    const uint32_t set = solver.addConstraintSet(&bonds, "bonds", parametersOf(bonds));
    ps::Spawn spawn = solid(grid(18, 4, 4, kSpacing, {-0.03, 0, 0}), set);
    for (const ps::api::Double3& x : spawn.position)
      spawn.velocity.push_back({0.5 * x.x, 8 * x.x * x.x - 2 * x.x * (x.z - 0.03), 2 * x.x * (x.y - 0.03)});
    solver.spawn(spawn);
    pin(solver, [](const Vector3& x) { return x.x() < 0; });
    const double before = energyOf(solver);
    double most = before;
    for (int f = 0; f < 600; ++f) {
      QCOMPARE(solver.step().flags, 0u);
      most = std::max(most, energyOf(solver));
    }
    QVERIFY(solver.limits().empty());
    QVERIFY2(most <= before * 1.001, qPrintable(QString::number(most / before)));
  }

  void everyMachineGivesOneHash_data() { onehash::addRows(); }
  void everyMachineGivesOneHash() { onehash::verify(hashOfBeam); }
};

QTEST_APPLESS_MAIN(TestBeams)
#include "tst_beams.moc"
