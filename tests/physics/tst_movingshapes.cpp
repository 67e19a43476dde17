// SPDX-License-Identifier: Apache-2.0
// Liquid in and on fixed bodies that move and whose surfaces are known: what holds for vessels at rest holds for those
// on their way, as seen from them.
#include "onehash.h"
#include "vessels.h"

#include <QTest>

#include <set>

using namespace vessels;

class TestMovingShapes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup() {
    ps::setThreadCount(0);
    ps::setInstructionSet({});
  }

  /// Water in a vessel on its way rests in it as it would at home: as high, as heavy, and nothing of it outside.
  /// It began at the vessel's velocity, so that nothing sloshes.
  void vesselsCarryWater_data() {
    QTest::addColumn<QString>("vessel");
    QTest::addColumn<double>("spin");
    QTest::newRow("a cup") << "cup" << 0.0;
    QTest::newRow("a bowl") << "bowl" << 0.0;
    QTest::newRow("a bowl of one side") << "sheet" << 0.0;
    QTest::newRow("a bowl that turns below its water") << "bowl" << 2.0;
  }
  void vesselsCarryWater() {
    QFETCH(QString, vessel);
    QFETCH(double, spin);
    const bool round = isRound(vessel);
    const ps::Vector3 velocity(0.2, 0.05, -0.1);
    ps::Engine engine(onItsWay(filled(vessel, m_plugins), velocity, spin), m_plugins);
    const double mass = massOf(engine);
    run(engine, 1.5);
    const double force = meanForce(engine, 1), time = 2.5;
    ps::Vector3 centre = ps::Vector3::Zero();
    size_t count = 0;
    const ps::ParticleStore& store = engine.solver().particles();
    for (size_t i = 0; i < store.size(); ++i) {
      if (store.velocity()[i].w == 0) continue;
      const ps::Vector3 at = ps::vectorOf(store.position()[i]) - time * velocity;
      const double out = round ? at.norm() : std::hypot(at[0], at[2]);
      QVERIFY2(out < kRadius && (round || at[1] > 0), qPrintable(QString("%1 %2").arg(out).arg(at[1])));
      centre += at;
      ++count;
    }
    centre /= static_cast<double>(count);
    const double volume = mass / kWater, wanted = round ? capCentre(volume) : volume / (2 * kPi * kRadius * kRadius);
    qInfo("middle at %.5f m, should be %.5f; bears %.4f N of %.4f", centre[1], wanted, -force, mass * kGravity);
    QVERIFY(std::abs(centre[1] - wanted) < 0.2 * kSpacing);
    QVERIFY(std::hypot(centre[0], centre[2]) < 0.2 * kSpacing);
    QVERIFY(std::abs(force / (mass * kGravity) + 1) < 0.02);
  }

  /// A cup that is tipped pours out over its rim, and nothing leaves it by another way.
  void aTippedCupPoursOverItsRim() {
    constexpr double kHigh = 0.16, kSpin = 1.5;
    ps::Project project = filled("cup", m_plugins);
    project.bodies[0].spin = {0, 0, -kSpin};
    ps::Engine engine(project, m_plugins);
    const ps::ParticleStore& store = engine.solver().particles();
    // The middle of its bottom and its wall, about which it turns.
    const double outer = kRadius + kThin, bottom = outer * outer * kThin,
                 wall = (outer * outer - kRadius * kRadius) * kHigh;
    const ps::Vector3 pivot(0, (wall * kHigh / 2 - bottom * kThin / 2) / (wall + bottom), 0);
    std::set<uint32_t> poured;
    size_t left = 0;
    for (int frame = 1; frame <= 120; ++frame) {
      engine.step();
      const ps::Quaternion back(Eigen::AngleAxisd(kSpin * frame / 60, ps::Vector3(0, 0, 1)));
      left = 0;
      for (size_t i = 0; i < store.size(); ++i) {
        if (store.velocity()[i].w == 0 || poured.contains(store.id()[i])) continue;
        const ps::Vector3 at = back * (ps::vectorOf(store.position()[i]) - pivot) + pivot;
        if (at[1] > kHigh) {
          poured.insert(store.id()[i]);
          continue;
        }
        const double out = std::hypot(at[0], at[2]);
        QVERIFY2(out < kRadius && at[1] > 0, qPrintable(QString("frame %1: %2 %3").arg(frame).arg(out).arg(at[1])));
        ++left;
      }
    }
    qInfo("%zu poured, %zu left", poured.size(), left);
    QVERIFY(poured.size() > 20 * left);
  }

  /// A plate of a fifth of a spacing goes up through falling water, many spacings in a substep or a part of one.
  void aPlateLetsNothingPass_data() {
    QTest::addColumn<double>("speed");
    for (const double speed : {0.5, 5.0, 50.0}) QTest::addRow("%g m/s", speed) << speed;
  }
  void aPlateLetsNothingPass() {
    QFETCH(double, speed);
    json plate = fixedOf(solidOf("block", {1.6, 0.002, 1.6}, {0, -0.2, 0}));
    plate["velocity"] = {0, speed, 0};
    const json water = bodyOf("water", solidOf("cylinder", {0.06, 0.2, 0.06}, {0, 0, 0}));
    ps::Engine engine(load(sceneOf(json::array({plate, water})), m_plugins), m_plugins);
    double lowest = 1;
    const int frames = static_cast<int>(60 * std::min(0.4, 0.8 / speed));
    for (int frame = 1; frame <= std::max(1, frames); ++frame) {
      engine.step();
      const ps::ParticleStore& store = engine.solver().particles();
      for (size_t i = 0; i < store.size(); ++i) {
        const ps::Vector3 at = ps::vectorOf(store.position()[i]);
        if (store.velocity()[i].w == 0 || std::hypot(at[0], at[2]) > 0.75) continue;
        lowest = std::min(lowest, at[1] - (-0.2 + speed * frame / 60));
      }
    }
    qInfo("nearest %.5f m", lowest);
    QVERIFY(lowest > 0.001 + 0.4 * kSpacing);
    QVERIFY(lowest < 5 * kSpacing);  // it has met it
  }

  /// What is thick sticks to a cup that turns. After six times R2/(5.78 nu), by which the slowest mode of a long
  /// cylinder decays by e (5.78 is the square of the first zero of J0), it turns with it.
  void honeyTurnsWithItsCup() {
    constexpr double kSpin = 2, kKinematic = 10 / 1420.0;
    ps::Project project = filled("cup", m_plugins, "honey");
    project.bodies[0].spin = {0, kSpin, 0};
    ps::Engine engine(project, m_plugins);
    run(engine, 6 * kRadius * kRadius / (5.78 * kKinematic));
    double spin = 0, inertia = 0;
    const ps::ParticleStore& store = engine.solver().particles();
    for (size_t i = 0; i < store.size(); ++i) {
      if (store.velocity()[i].w == 0) continue;
      const ps::Vector3 at = ps::vectorOf(store.position()[i]), v = ps::vectorOf(store.velocity()[i]);
      spin += at[2] * v[0] - at[0] * v[2];
      inertia += at[0] * at[0] + at[2] * at[2];
    }
    qInfo("turns at %.3f rad/s of %.1f", spin / inertia, kSpin);
    QVERIFY(std::abs(spin / inertia / kSpin - 1) < 0.03);
  }

  /// A state that is saved on the way goes on as the run did.
  void statesHoldVesselsOnTheirWay() {
    ps::Engine engine(onItsWay(filled("bowl", m_plugins), {0.2, 0, 0}, 1), m_plugins);
    run(engine, 0.3);
    QVERIFY(goesOnFromItsState(engine, 0.2));
  }

  void movingVesselsAreTheSameEverywhere_data() { onehash::addRows(); }
  void movingVesselsAreTheSameEverywhere() {
    onehash::verify([this] {
      ps::Engine engine(onItsWay(filled("bowl", m_plugins), {0.2, 0, 0}, 3), m_plugins);
      run(engine, 0.2);
      return engine.solver().stateHash();
    });
  }

 private:
  ps::PluginRegistry m_plugins;
};

QTEST_GUILESS_MAIN(TestMovingShapes)
#include "tst_movingshapes.moc"
