// SPDX-License-Identifier: Apache-2.0
// What grew together or melted apart is undone: by a reset, and by taking matter away and putting it back.
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "tests/shared/enginehands.h"
#include "tests/shared/scenes.h"

#include <QTest>

namespace {

using Pieces = std::vector<double>;  // of all, and of the body "lower"

constexpr double kSpacing = 0.02;
/// J/kg, above the solid at its melting point; 333.6e3 melt it.
constexpr double kMolten = 340e3;

/// A block of ice 4 x `layers` x 4, on `below` layers of something else.
ps::Body iceBlock(const char* id, int layers, int below, const QString& structure) {
  ps::Body body = ps::scenes::block(id, 4, kSpacing, {}, 263.15);
  body.shape = ps::BoxShape{{0, (below + 0.5 * layers) * kSpacing, 0}, {4 * kSpacing, layers * kSpacing, 4 * kSpacing}};
  body.constraints[0].plugin = structure.toStdString();
  return body;
}

ps::Project projectOf(const std::vector<ps::Body>& bodies) {
  ps::Project project;
  project.solver.thermalModel = "enthalpy";
  project.materials.push_back(ps::scenes::water());
  project.environment = ps::scenes::tray(0.2, 1);
  project.solver.parameters.values["particle_spacing"] = kSpacing;
  project.bodies = bodies;
  for (const char* body : {"", "lower"}) {
    ps::Probe probe;
    probe.id = probe.name = std::string("pieces") + body;
    probe.quantity = "pieces";
    probe.body = body;
    project.probes.push_back(probe);
  }
  return project;
}

Pieces piecesOf(ps::Engine& engine) { return engine.stats().probes; }

/// Ids of the particles between two heights, in layers.
std::vector<uint32_t> between(ps::Engine& engine, double low, double high) {
  const ps::ParticleStore& p = engine.solver().particles();
  std::vector<uint32_t> ids;
  for (size_t i = 0; i < p.size(); ++i) {
    if (double{p.position()[i].y} > low * kSpacing && double{p.position()[i].y} < high * kSpacing)
      ids.push_back(p.id()[i]);
  }
  return ids;
}

/// As a hot wire would, but at once; the books miss this heat, and say so.
void melt(ps::Engine& engine, const std::vector<uint32_t>& ids) {
  ps::ParticleStore& p = ps::tests::solverOf(engine).particles();
  auto* h = static_cast<double*>(p.find("specific_enthalpy", ps::api::FieldType::Float64));
  for (const uint32_t id : ids) h[p.indexOf(id)] = kMolten;
}

bool run(ps::Engine& engine, int frames) {
  for (int f = 0; f < frames; ++f) {
    const ps::StepReport report = engine.step();
    if ((report.flags & ~static_cast<unsigned>(ps::StepFlag::EnergyOpen)) == 0) continue;
    qWarning("frame %d: flags %u: %s", f, report.flags, report.message.c_str());
    return false;
  }
  return true;
}

}  // namespace

class TestJoiningUndo : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aResetParts_data() { structures(); }
  void aResetParts() {
    QFETCH(QString, structure);
    ps::PluginRegistry registry;
    ps::Engine engine(projectOf({iceBlock("lower", 4, 0, structure), iceBlock("upper", 4, 4, structure)}), registry);
    for (int times = 0; times < 2; ++times) {
      QCOMPARE(piecesOf(engine), (Pieces{2, 1}));
      QVERIFY(run(engine, 60));
      QCOMPARE(piecesOf(engine), (Pieces{1, 1}));
      if (times == 0) engine.reset();
    }
    // Two layers out of the upper block, and back again.
    const std::vector<uint32_t> cut = between(engine, 5, 7);
    QCOMPARE(cut.size(), size_t{32});
    const ps::ExtractedMatter taken = engine.extractParticles(cut);
    QVERIFY(run(engine, 1));
    QCOMPARE(piecesOf(engine), (Pieces{2, 1}));
    engine.putBack(taken);
    QVERIFY(run(engine, 1));
    QCOMPARE(piecesOf(engine), (Pieces{1, 1}));
  }

  /// A block is sketched onto another, grows on, is undone, and redone.
  void whatHasGrownOnIsTakenBack_data() { structures(); }
  void whatHasGrownOnIsTakenBack() {
    QFETCH(QString, structure);
    ps::PluginRegistry registry;
    ps::Engine engine(projectOf({iceBlock("lower", 4, 0, structure)}), registry);
    QVERIFY(run(engine, 2));
    const std::vector<uint32_t> added = engine.addBody(iceBlock("upper", 4, 4, structure));
    QCOMPARE(added.size(), size_t{64});
    QVERIFY(run(engine, 60));
    QCOMPARE(piecesOf(engine), (Pieces{1, 1}));
    const ps::ExtractedMatter taken = engine.extractParticles(added);
    QVERIFY(run(engine, 2));
    QCOMPARE(piecesOf(engine), (Pieces{1, 1}));
    QCOMPARE(engine.solver().particles().size(), size_t{64});
    QCOMPARE(between(engine, 0, 4.1).size(), size_t{64});
    engine.putBack(taken);
    QVERIFY(run(engine, 60));
    QCOMPARE(piecesOf(engine), (Pieces{1, 1}));
    QCOMPARE(engine.solver().particles().size(), size_t{128});
  }

  /// Melted through in the middle: two bodies. The upper one is taken away and put back: still two. With the molten
  /// layer gone it stands on the lower one, and the two become one.
  void whatHasMeltedApartComesBackApart_data() { structures(); }
  void whatHasMeltedApartComesBackApart() {
    QFETCH(QString, structure);
    ps::PluginRegistry registry;
    ps::Engine engine(projectOf({iceBlock("lower", 9, 0, structure)}), registry);
    QCOMPARE(piecesOf(engine), (Pieces{1, 1}));
    const std::vector<uint32_t> middle = between(engine, 4, 5), upper = between(engine, 5, 9);
    QCOMPARE(middle.size(), size_t{16});
    melt(engine, middle);
    QVERIFY(run(engine, 3));
    QCOMPARE(piecesOf(engine), (Pieces{2, 2}));
    const ps::ExtractedMatter taken = engine.extractParticles(upper);
    QVERIFY(run(engine, 1));
    QCOMPARE(piecesOf(engine), (Pieces{1, 1}));
    engine.putBack(taken);
    QVERIFY(run(engine, 1));
    QCOMPARE(piecesOf(engine), (Pieces{2, 2}));
    engine.extractParticles(middle);
    QVERIFY(run(engine, 120));
    QCOMPARE(piecesOf(engine), (Pieces{1, 1}));
    engine.reset();
    QCOMPARE(piecesOf(engine), (Pieces{1, 1}));
    QCOMPARE(engine.solver().particles().size(), size_t{144});
  }

 private:
  static void structures() {
    QTest::addColumn<QString>("structure");
    QTest::newRow("bonds") << "bonds";
    QTest::newRow("rigid") << "rigid";
  }
};

QTEST_APPLESS_MAIN(TestJoiningUndo)
#include "tst_joiningundo.moc"
