// SPDX-License-Identifier: Apache-2.0
// What plugins give back is checked where it comes in: null pointers, endless lists, numbers that cannot be. Whoever
// gave it is named, and nothing of it stays.
#include "mechanicsscene.h"

#include <QTest>

#include <cmath>
#include <limits>
#include <stdexcept>

using namespace mechanics;
using ps::Solver;
using ps::StepReport;
using namespace ps::api;

namespace {

constexpr ps::StepFlags flagOf(ps::StepFlag flag) { return static_cast<ps::StepFlags>(flag); }
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Ties of two that do what they must not.
class WrongTies final : public TestConstraint<StructuralPlugin> {
 public:
  enum What {
    NullLimit,
    EndlessLimits,
    NanLimit,
    ThrowingLimits,
    ThrowingEnergy,
    NanEnergy,
    NullTie,
    Leap,
    Nan,
    Novel
  };
  explicit WrongTies(What what) : m_what(what) {}
  bool traits(StructuralTraits* out) const noexcept override { return fill(out, {}); }
  void build(const ConstraintContext&, const ParticleView&, const NeighbourView&, Span<const uint32_t> members,
             ConstraintSink& sink) const override {
    sink.add(m_what == NullTie ? nullptr : members.data, nullptr);
  }
  void project(const ConstraintContext& context, const MovableParticles& p, const ConstraintBatch& b) const override {
    if (context.time == 0) return;  // the first frame is good
    if (m_what == Leap) p.position[b.particles[0]].x += 100;
    if (m_what == Nan) p.position[b.particles[0]].x = std::nanf("");
    if (m_what == Novel) throw std::runtime_error(std::string(1 << 20, 'x'));
  }
  double energy(const ConstraintContext&, const ParticleView&, const ConstraintBatch&) const override {
    if (m_what == ThrowingEnergy) throw std::runtime_error("no energy");
    return m_what == NanEnergy ? kNan : 0;
  }
  void limits(const ConstraintContext&, const ParticleView&, LimitSink& sink) const override {
    if (m_what == NullLimit) sink.limit(nullptr, 1, 0, nullptr);
    if (m_what == NanLimit) sink.limit("bad.strength", kNan, 0, "");
    if (m_what == ThrowingLimits) throw std::runtime_error("no limits");
    for (int k = 0; m_what == EndlessLimits && k < 100'000; ++k)
      sink.limit(("bad." + std::to_string(k)).c_str(), 1, 0, "");
  }

 private:
  What m_what;
};

/// The enthalpy model, with one wrong answer.
class WrongModel final : public ps::thermal::EnthalpyModel {
 public:
  enum What { BelowZero, TooHot, Shares, NanEnergy };
  explicit WrongModel(What what) : m_what(what) {}
  mutable std::atomic<bool> armed{false};
  void derive(const ThermalContext& c, const ParticleView& p, size_t first, size_t last,
              const ThermalOutput& out) const override {
    EnthalpyModel::derive(c, p, first, last, out);
    if (!armed || first > 0) return;
    if (m_what == BelowZero) out.temperature[0] = -1;
    if (m_what == TooHot) out.temperature[0] = 1e297;
    if (m_what == Shares) out.liquidFraction[0] = 1.5f;
  }
  void energy(const ThermalContext& c, const ParticleView& p, size_t first, size_t last, double* out) const override {
    EnthalpyModel::energy(c, p, first, last, out);
    if (armed && m_what == NanEnergy) out[first] = kNan;
  }

 private:
  What m_what;
};

/// Moves each particle by the first parameter of its body, and counts for whom it is called.
class Push final : public TestConstraint<NeighbourPlugin> {
 public:
  mutable std::atomic<size_t> asked{0};
  bool traits(NeighbourTraits* out) const noexcept override { return fill(out, {}); }
  void gather(const ConstraintContext& context, const ParticleView& p, const NeighbourView&,
              Span<const uint32_t> members, Float4* correction) const override {
    asked += members.size;
    for (size_t k = 0; k < members.size; ++k)
      correction[k].x = static_cast<float>(context.parametersOf(p.body[members[k]])[0]);
  }
};

}  // namespace

class TestBorder : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void wrongTiesAreNamed_data() {
    QTest::addColumn<int>("what");
    QTest::addColumn<unsigned>("flag");
    QTest::addColumn<QString>("words");
    const unsigned fault = flagOf(ps::StepFlag::PluginFault);
    QTest::newRow("null limit") << int(WrongTies::NullLimit) << fault << "without a name";
    QTest::newRow("100,000 limits") << int(WrongTies::EndlessLimits) << fault << "more limits";
    QTest::newRow("NaN limit") << int(WrongTies::NanLimit) << fault << "not a finite number";
    QTest::newRow("throwing limits") << int(WrongTies::ThrowingLimits) << fault << "no limits";
    QTest::newRow("throwing energy") << int(WrongTies::ThrowingEnergy) << fault << "no energy";
    QTest::newRow("NaN energy") << int(WrongTies::NanEnergy) << fault << "its energy is not a finite number";
    QTest::newRow("null tie") << int(WrongTies::NullTie) << fault << "null pointer";
    QTest::newRow("leap of 100 m") << int(WrongTies::Leap) << flagOf(ps::StepFlag::Unphysical)
                                   << "leapt 100 m in one substep";
    QTest::newRow("NaN") << int(WrongTies::Nan) << flagOf(ps::StepFlag::NotFinite) << "position is not finite";
    QTest::newRow("a megabyte of words") << int(WrongTies::Novel) << fault << "(1048576 bytes)";
  }
  void wrongTiesAreNamed() {
    QFETCH(int, what);
    QFETCH(unsigned, flag);
    QFETCH(QString, words);
    const WrongTies ties(static_cast<WrongTies::What>(what));
    Solver solver;
    prepare(solver, settingsOf(0.02));
    solver.setWalls(tray(0.2));
    solver.spawn(ice(lattice(4, 4, 4, 0.02, 0.1), solver.addConstraintSet(&ties, "org.example.bad", {})));
    StepReport report = solver.step();
    if (what != WrongTies::NullTie) QCOMPARE(report.flags, 0u);
    const Float4 before = solver.particles().position()[solver.particles().indexOf(0)];
    if (report.flags == 0) report = solver.step();
    if (report.flags == 0) {  // it fails only when it is asked
      solver.limits();
      solver.elasticEnergy();
      const std::vector<ps::PluginFault> faults = solver.drainFaults();
      QCOMPARE(faults.size(), size_t{1});
      report.message = "plugin '" + faults[0].plugin + "': " + faults[0].what;
      report.flags = flagOf(ps::StepFlag::PluginFault);
      QVERIFY(solver.drainFaults().empty());
    }
    QCOMPARE(report.flags, flag);
    QVERIFY2(report.message.find("plugin 'org.example.bad'") != std::string::npos, report.message.c_str());
    QVERIFY2(report.message.find(words.toStdString()) != std::string::npos, report.message.c_str());
    QVERIFY(report.message.size() < 1000);
    if (flag == flagOf(ps::StepFlag::PluginFault)) {
      QVERIFY(run(solver, 5));
    } else {  // the frame was taken back
      QCOMPARE(solver.frame(), uint64_t{1});
      const Float4 after = solver.particles().position()[solver.particles().indexOf(0)];
      QVERIFY(after.x == before.x && after.y == before.y && after.z == before.z);
    }
  }

  void wrongModelsAreNamed_data() {
    QTest::addColumn<int>("what");
    QTest::addColumn<unsigned>("flag");
    QTest::addColumn<QString>("words");
    const unsigned unphysical = flagOf(ps::StepFlag::Unphysical);
    QTest::newRow("-1 K") << int(WrongModel::BelowZero) << unphysical << "a temperature of -1 K";
    QTest::newRow("1e297 K") << int(WrongModel::TooHot) << unphysical << "a temperature of 1e+297 K";
    QTest::newRow("shares") << int(WrongModel::Shares) << unphysical << "shares of 0 solid, 1.5 liquid, 0 gas";
    QTest::newRow("NaN energy") << int(WrongModel::NanEnergy) << flagOf(ps::StepFlag::PluginFault)
                                << "its energy is not a finite number";
  }
  void wrongModelsAreNamed() {
    QFETCH(int, what);
    QFETCH(unsigned, flag);
    QFETCH(QString, words);
    const WrongModel model(static_cast<WrongModel::What>(what));
    Solver solver;
    prepare(solver, settingsOf(0.02));
    std::vector<ps::Wall> walls = tray(0.16);
    walls[0].heat = ps::WallHeat::FixedTemperature;
    walls[0].temperature = 350;
    solver.setWalls(walls);
    solver.setThermal({}, &model, "org.example.model", {});
    solver.spawn(liquid(lattice(8, 8, 8, 0.02, 0), 300));
    QVERIFY(run(solver, 3));
    model.armed = true;
    const StepReport report = solver.step();
    QCOMPARE(report.flags, flag);
    QVERIFY2(report.message.find("plugin 'org.example.model'") != std::string::npos, report.message.c_str());
    QVERIFY2(report.message.find(words.toStdString()) != std::string::npos, report.message.c_str());
    model.armed = false;
    QVERIFY(run(solver, 3));
    for (size_t i = 0; i < solver.particles().size(); ++i) QVERIFY(solver.particles().temperature()[i] > 290);
  }

  /// Whatever the number of bodies and their parameters, each member is asked for once an iteration, and nobody else.
  void neighboursAreAskedOnceForTheirMembers() {
    const Push push;
    Solver solver;
    ps::SolverSettings settings = settingsOf(0.02);
    settings.gravity = {0, 0, 0};
    prepare(solver, settings);
    const uint32_t set = solver.addConstraintSet(&push, "push", {0.0});
    for (uint32_t body = 0; body < 4; ++body) {
      ps::Spawn spawn = liquid(lattice(3, 3, 3, 0.02, 0.5 + 0.2 * body));
      spawn.body = body;
      if (body < 3) {
        solver.setConstraintParameters(set, body, {body * 1e-4});
        spawn.constraintSets = {set};
      }
      solver.spawn(spawn);
    }
    QVERIFY(run(solver, 1));
    const size_t iterations = static_cast<size_t>(settings.substeps * settings.iterations);
    QCOMPARE(push.asked.load(), 3 * 27 * iterations);
    double way[4]{};
    for (size_t i = 0; i < solver.particles().size(); ++i)
      way[solver.particles().body()[i]] += double{solver.particles().velocity()[i].x} / 27;
    QVERIFY(std::abs(way[0]) < 1e-4 && std::abs(way[3]) < 1e-4);
    QVERIFY(way[1] > 1e-3 && std::abs(way[2] / way[1] - 2) < 0.05);
  }
};

QTEST_APPLESS_MAIN(TestBorder)
#include "tst_border.moc"
