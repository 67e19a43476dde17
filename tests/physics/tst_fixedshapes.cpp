// SPDX-License-Identifier: Apache-2.0
// Liquid in and on fixed bodies whose surfaces are known: thin walls, bowls, meshes, open ones too. Levels and forces
// against the volume and the weight of the water.
#include "onehash.h"
#include "vessels.h"

#include <QTest>

#include <set>

using namespace vessels;

class TestFixedShapes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup() {
    ps::setThreadCount(0);
    ps::setInstructionSet({});
  }

  /// Water comes to rest in a vessel whose walls are a third of a spacing thick, or none at all: none of it is
  /// outside, it stands as high as its volume asks, and what it weighs is what the vessel bears. Levels go by the
  /// middle of the water, which lies half as high as its surface in a cylinder, 5/8 of it in a full half sphere.
  void vesselsHoldWater_data() {
    QTest::addColumn<QString>("vessel");
    QTest::newRow("a tube on a floor") << "tube";
    QTest::newRow("a cup") << "cup";
    QTest::newRow("a bowl") << "bowl";
    QTest::newRow("a bowl that is no mesh") << "solid bowl";
    QTest::newRow("a bowl of one side") << "sheet";
    QTest::newRow("a hollow ball") << "ball";
  }
  void vesselsHoldWater() {
    QFETCH(QString, vessel);
    ps::Engine engine(filled(vessel, m_plugins), m_plugins);
    const double mass = massOf(engine);
    run(engine, 2.5);
    const bool round = isRound(vessel);
    const ps::ParticleStore& store = engine.solver().particles();
    size_t count = 0;
    ps::Vector3 centre;
    for (size_t i = 0; i < store.size(); ++i) {
      if (store.velocity()[i].w == 0) continue;
      const ps::Vector3 at = ps::vectorOf(store.position()[i]);
      const double out = round ? at.norm() : std::hypot(at[0], at[2]);
      QVERIFY2(out < kRadius && (round || at[1] > 0), qPrintable(QString("%1 %2").arg(out).arg(at[1])));
      centre += at;
      ++count;
    }
    centre /= static_cast<double>(count);
    const double volume = mass / kWater, wanted = round ? capCentre(volume) : volume / (2 * kPi * kRadius * kRadius);
    const double force = meanForce(engine, 1);
    qInfo("middle at %.5f m, should be %.5f; bears %.4f N of %.4f", centre[1], wanted, -force, mass * kGravity);
    QVERIFY(std::abs(centre[1] - wanted) < 0.2 * kSpacing);
    if (vessel != "tube") QVERIFY(std::abs(force / (mass * kGravity) + 1) < 0.02);
    QVERIFY(massOf(engine) == mass);
  }

  /// A jet at 20 m/s goes through eight spacings in a substep. A plate of a fifth of a spacing lets none of it pass.
  void jetsDoNotPass_data() {
    QTest::addColumn<double>("speed");
    QTest::addColumn<double>("turn");
    for (const double turn : {0.0, 35.0}) {
      for (const double speed : {2.0, 20.0, 100.0}) QTest::addRow("%g m/s at %g degrees", speed, turn) << speed << turn;
    }
  }
  void jetsDoNotPass() {
    QFETCH(double, speed);
    QFETCH(double, turn);
    json plate = solidOf("block", {1.6, 0.002, 1.6}, {0, 0, 0});
    plate["rotation_z"] = turn;
    json water = bodyOf("water", solidOf("cylinder", {0.06, 0.2, 0.06}, {0, 0.25, 0}));
    water["velocity"] = {0, -speed, 0};
    ps::Engine engine(load(sceneOf(json::array({fixedOf(plate), water})), m_plugins), m_plugins);
    const ps::Vector3 up(-std::sin(turn * kPi / 180), std::cos(turn * kPi / 180), 0);
    double lowest = 1, highest = 0;
    std::set<uint32_t> beyond;
    for (int frame = 0; frame < (speed > 50 ? 8 : 24); ++frame) {
      engine.step();
      const ps::ParticleStore& store = engine.solver().particles();
      for (size_t i = 0; i < store.size(); ++i) {
        const ps::Vector3 at = ps::vectorOf(store.position()[i]);
        const ps::Vector3 along = at - at.dot(up) * up;
        // Whoever has come to the plate's edge may go round it.
        if (along.norm() > 0.75) beyond.insert(store.id()[i]);
        if (store.velocity()[i].w == 0 || beyond.contains(store.id()[i])) continue;
        lowest = std::min(lowest, at.dot(up));
        highest = std::max(highest, along.norm());
      }
    }
    qInfo("nearest %.5f m, spread to %.3f m", lowest, highest);
    QVERIFY(lowest > 0.001 + 0.4 * kSpacing);
    QVERIFY(highest > 0.05);  // it has met it
  }

  /// Where some of the vessel's particles are gone, there is a hole.
  void aHoleIsAHole() {
    ps::Engine engine(filled("cup", m_plugins), m_plugins);
    run(engine, 0.5);
    std::vector<uint32_t> gone;
    const ps::ParticleStore& store = engine.solver().particles();
    for (size_t i = 0; i < store.size(); ++i) {
      if (store.velocity()[i].w == 0 && store.position()[i].x > 0.02) gone.push_back(store.id()[i]);
    }
    QVERIFY(!gone.empty());
    engine.extractParticles(gone);
    run(engine, 0.5);
    const auto outside = [&] {
      size_t count = 0;
      for (size_t i = 0; i < store.size(); ++i)
        count += store.velocity()[i].w > 0 && store.position()[i].y < -kSpacing ? 1 : 0;
      return count;
    };
    QVERIFY(outside() > 100);
  }

  /// A vessel that is carried to another place takes its surface along, and so does a state.
  void surfacesGoWhereBodiesGo() {
    ps::Engine engine(filled("bowl", m_plugins), m_plugins);
    run(engine, 0.5);
    const ps::Vector3 way(0.1, 0.2, 0);
    for (const char* id : {"vessel", "water"}) {
      const auto& bodies = engine.project().bodies;
      ps::Body body = *std::find_if(bodies.begin(), bodies.end(), [&](const ps::Body& b) { return b.id == id; });
      auto& values = std::get<ps::SolidShape>(body.shape).parameters.values;
      for (size_t a = 0; a < 3; ++a) {
        const std::string key = std::string("position_") + "xyz"[a];
        values[key] =
            ps::numberOf(std::get<ps::SolidShape>(body.shape).parameters, ps::solidParameters(), key) + way[a];
      }
      engine.moveBody(body, {ps::Quaternion::Identity(), way});
    }
    const ps::ParticleStore& store = engine.solver().particles();
    const auto farthest = [&] {
      double out = 0;
      for (size_t i = 0; i < store.size(); ++i) {
        if (store.velocity()[i].w > 0) out = std::max(out, (ps::vectorOf(store.position()[i]) - way).norm());
      }
      return out;
    };
    run(engine, 0.5);
    QVERIFY2(farthest() < kRadius - 0.4 * kSpacing, qPrintable(QString::number(farthest())));
    QVERIFY(goesOnFromItsState(engine, 0.1));
  }

  void vesselsAreTheSameEverywhere_data() { onehash::addRows(); }
  void vesselsAreTheSameEverywhere() {
    onehash::verify([this] {
      ps::Engine engine(filled("bowl", m_plugins), m_plugins);
      run(engine, 0.2);
      return engine.solver().stateHash();
    });
  }

 private:
  ps::PluginRegistry m_plugins;
};

QTEST_GUILESS_MAIN(TestFixedShapes)
#include "tst_fixedshapes.moc"
