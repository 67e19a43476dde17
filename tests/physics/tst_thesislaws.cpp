// SPDX-License-Identifier: Apache-2.0
// The 2020 thesis's laws of solids, which bonds offer for comparison: equation 4.5 and algorithm 5.
#include "softscene.h"

#include <QTest>

using namespace soft;
using ps::Solver;
using ps::constraint::BondModel;

namespace {

constexpr double kSpacing = 0.02;

ps::Material softIce(const char* id) {
  ps::Material m = water();
  m.id = id;
  m.properties["youngs_modulus"] = 1e4;  // well within what a substep resolves
  return m;
}

}  // namespace

class TestThesisLaws : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { ps::setThreadCount(1); }

  /// E/E0 = 2/(1 + exp(dT/s)), by the energy of a strained block that has warmed by dT since its bonds were made.
  void stiffnessFallsAsASigmoid_data() {
    QTest::addColumn<double>("warming");    // K
    QTest::addColumn<double>("softening");  // K
    QTest::addColumn<double>("expected");
    QTest::newRow("as made") << 0.0 << 1.0 << 1.0;
    QTest::newRow("a kelvin warmer") << 1.0 << 1.0 << 0.537883;
    QTest::newRow("three kelvin warmer") << 3.0 << 1.0 << 0.0948517;
    QTest::newRow("two kelvin colder") << -2.0 << 1.0 << 1.761594;
    QTest::newRow("five kelvin warmer, softens over ten") << 5.0 << 10.0 << 0.755081;
  }
  void stiffnessFallsAsASigmoid() {
    QFETCH(double, warming);
    QFETCH(double, softening);
    QFETCH(double, expected);
    const double reference = stiffnessAfter(0, softening), now = stiffnessAfter(warming, softening);
    // The modulus is read from a table of temperatures, and volumes change by 1.5e-4 per kelvin.
    QVERIFY2(std::abs(now / reference / expected - 1) < 2e-3, qPrintable(QString::number(now / reference)));
  }

  /// A bond to a drop: ours breaks when one end is fluid, the thesis's when both have begun to melt.
  void bondsBreakWhenBothEndsMelt_data() {
    QTest::addColumn<bool>("thesis");
    QTest::addColumn<double>("other");  // J/kg of the second end; the first is molten
    QTest::addColumn<int>("left");
    QTest::newRow("ours, other solid") << false << -20e3 << 0;
    QTest::newRow("thesis, other solid") << true << -20e3 << 1;
    QTest::newRow("thesis, other a little molten") << true << 20e3 << 0;
  }
  void bondsBreakWhenBothEndsMelt() {
    QFETCH(bool, thesis);
    QFETCH(double, other);
    QFETCH(int, left);
    Solver solver;
    const uint32_t set = start(solver, thesis);
    solver.spawn(ice(lattice(2, 1, 1, kSpacing, 0), set));
    solver.step();
    QCOMPARE(solver.constraintCount(), size_t{1});
    setEnthalpy(solver, {340e3, other});
    solver.step();
    QCOMPARE(solver.constraintCount(), static_cast<size_t>(left));
  }

  /// A freezing drop in the middle of six solid neighbours of another material.
  void whatFreezesTiesItselfFourTimes() {
    for (const bool thesis : {false, true}) {
      Solver solver;
      const uint32_t set = start(solver, thesis);
      ps::Spawn drop = liquid({{0, 0, 0}}, 280);
      drop.constraintSets = {set};
      solver.spawn(drop);
      const double d = 1.08 * kSpacing;  // out of reach of each other
      ps::Spawn around = ice({{d, 0, 0}, {-d, 0, 0}, {0, d, 0}, {0, -d, 0}, {0, 0, d}, {0, 0, -d}}, set);
      around.material = around.body = 1;
      solver.spawn(around);
      solver.step();
      QCOMPARE(solver.constraintCount(), size_t{0});
      setEnthalpy(solver, {30e3});  // 91 % frozen
      solver.step();
      QCOMPARE(solver.constraintCount(), size_t{thesis ? 4u : 0u});
    }
  }

 private:
  uint32_t start(Solver& solver, bool thesis) {
    ps::SolverSettings settings = settingsOf(kSpacing);
    settings.gravity = {0, 0, 0};
    prepare(solver, settings);
    solver.setMaterials({ps::BakedMaterial(softIce("ice"), 101325), ps::BakedMaterial(softIce("stone"), 101325)});
    solver.setThermal({}, &m_enthalpy, "enthalpy", {});
    return solver.addConstraintSet(&m_bonds, "bonds", parametersOf(m_bonds, {{BondModel::kBondRule, thesis ? 1 : 0}}));
  }
  /// J/kg of the first particles, by id.
  static void setEnthalpy(Solver& solver, const std::vector<double>& joules) {
    auto* h = static_cast<double*>(solver.particles().find("specific_enthalpy", ps::api::FieldType::Float64));
    for (uint32_t id = 0; id < joules.size(); ++id) h[solver.particles().indexOf(id)] = joules[id];
  }
  double stiffnessAfter(double warming, double softening) {
    Solver solver;
    start(solver, false);
    const uint32_t set = solver.addConstraintSet(
        &m_bonds, "bonds", parametersOf(m_bonds, {{BondModel::kStiffnessLaw, 1}, {BondModel::kSoftening, softening}}));
    solver.spawn(ice(lattice(4, 4, 4, kSpacing, 0), set, 263.15));
    setEnthalpy(solver, std::vector<double>(64, 2100 * (263.15 + warming - 273.15)));
    for (int f = 0; f < 3; ++f) solver.step();
    ps::ParticleStore& p = solver.particles();
    const std::vector<ps::api::Float4> places(p.position(), p.position() + p.size());
    double energy = -2 * solver.elasticEnergy();
    for (const double strain : {1e-3, -1e-3}) {
      for (size_t i = 0; i < p.size(); ++i) p.position()[i].x *= static_cast<float>(1 + strain);
      energy += solver.elasticEnergy();
      std::copy(places.begin(), places.end(), p.position());
    }
    return energy;
  }

  const ps::thermal::EnthalpyModel m_enthalpy{};
  const BondModel m_bonds{};
};

QTEST_APPLESS_MAIN(TestThesisLaws)
#include "tst_thesislaws.moc"
