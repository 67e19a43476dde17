// SPDX-License-Identifier: Apache-2.0
// A thousand edits of all kinds at random, with undo and redo among them, while matter flows: all of them undone, the
// document, the matter and the heat of hands are what they were; redone, what they had become.
#include "core/io/projectio.h"
#include "core/solver/solver.h"
#include "tests/shared/enginehands.h"
#include "tests/shared/random.h"
#include "tests/shared/scenes.h"
#include "tests/ui/tooltesting.h"

#include <QtTest/QTest>

#include <cmath>
#include <memory>
#include <set>

using namespace ps;

namespace {

constexpr double kSpacing = 0.03;
constexpr int kEdits = 1000;

}  // namespace

class TestRandomSketch : public ToolTest {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    Project project = scenes::iceOnPlate(5, 300, 100);
    project.environment = scenes::tray(0.5, 1.2);
    project.bodies.push_back(scenes::block("pool", 6, kSpacing, {0.3, 0.09, 0.2}, 290));
    open(project);
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot() != nullptr; }));
    m_document->addMaterial("wax");
    m_document->undoStack().clear();
  }
  void cleanup() { close(); }

  void allIsUndoneAndRedone_data() {
    QTest::addColumn<int>("seed");
    for (const int seed : {1, 2}) QTest::addRow("seed %d", seed) << seed;
  }
  void allIsUndoneAndRedone() {
    QFETCH(int, seed);
    ps::testing::Random random(static_cast<uint64_t>(seed));
    const std::string before = text();
    const std::set<uint32_t> matter = ids();
    QCOMPARE(matter.size(), size_t{125 + 216});
    m_engine->stepOnce();
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->stats.frame == 1; }));
    m_engine->play();
    for (int k = 0; k < kEdits && !QTest::currentTestFailed(); ++k) edit(random);
    m_engine->pause();
    while (m_document->undoStack().canRedo()) m_document->undoStack().redo();
    const std::string after = text();
    const std::set<uint32_t> all = ids();
    const double given = exchanged();
    QVERIFY(given > 0);
    while (m_document->undoStack().canUndo()) m_document->undoStack().undo();
    QCOMPARE(text(), before);
    QCOMPARE(ids(), matter);
    // Each particle gives back what it got, in double precision, unless that left it below 1 K.
    QVERIFY2(std::abs(heaters()) < 1e-9 * given, qPrintable(QString::number(heaters() / given)));
    while (m_document->undoStack().canRedo()) m_document->undoStack().redo();
    QCOMPARE(text(), after);
    QCOMPARE(ids(), all);
    m_engine->play();
    const uint64_t frame = m_engine->snapshot()->stats.frame;
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->stats.frame > frame + 20; }));
    sound();
  }

 private:
  void edit(ps::testing::Random& random) {
    const double what = random.next();
    if (what < 0.15) {
      for (int n = 0; n < 3 * random.next(); ++n) m_document->undoStack().undo();
    } else if (what < 0.25) {
      for (int n = 0; n < 3 * random.next(); ++n) m_document->undoStack().redo();
    } else if (what < 0.45) {
      take(random.next() < 0.5 ? "cube" : "sphere", random.next(0.02, 0.03));
      BrushSettings brush = m_tools->brush();
      brush.material = random.next() < 0.7 ? "water" : "wax";
      brush.temperature = random.next() < 0.5 ? 263 : 290;
      brush.held = random.next() < 0.2;
      m_tools->setBrush(brush);
      stroke(random, false);
    } else if (what < 0.6) {
      stroke(random, true);
    } else if (what < 0.7) {
      take("paint", random.next(0.02, 0.03));
      BrushSettings brush = m_tools->brush();
      brush.material = random.next() < 0.5 ? "water" : "wax";
      m_tools->setBrush(brush);
      stroke(random, false);
    } else {
      const char* brushes[] = {"heat", "cool", "grab", "push", "stir"};
      take(brushes[static_cast<size_t>(5 * random.next())], 0.06);
      stroke(random, false);
    }
    sound();
  }
  void stroke(ps::testing::Random& random, bool erases) {
    Pointer pointer = at({random.next(-0.4, 0.8), random.next(0, 0.2), random.next(-0.4, 0.8)});
    pointer.control = erases;
    Tool& tool = m_tools->tool();
    tool.press(pointer);
    const int steps = static_cast<int>(4 * random.next());
    for (int k = 1; k <= steps; ++k) {
      Pointer next = at(pointer.ray.origin + pointer.ray.direction + Vector3(random.next(-0.1, 0.2), 0, 0));
      next.control = erases;
      next.seconds = 0.01 * k;
      tool.drag(next);
    }
    awaitFrames(static_cast<uint64_t>(3 * random.next()));
    if (random.next() < 0.1) {
      tool.cancel();
    }
    tool.release(pointer);
  }
  void awaitFrames(uint64_t count) {
    const uint64_t frame = m_engine->snapshot()->stats.frame;
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->stats.frame >= frame + count; }, 30000));
  }
  /// Nothing has gone wrong in the frames up to now.
  void sound() {
    const SnapshotPtr now = m_engine->snapshot();
    QVERIFY2(now->flags == 0, qPrintable(QString::number(now->flags)));
    QVERIFY(m_engine->playing());
  }
  std::string text() const { return writeProject(m_document->project()); }
  std::set<uint32_t> ids() {
    return tests::onEngine<std::set<uint32_t>>(*m_engine, [](Engine& engine) {
      const ParticleStore& store = engine.particles();
      return std::set<uint32_t>(store.id(), store.id() + store.size());
    });
  }
  double heaters() {
    return tests::onEngine<double>(*m_engine, [](Engine& engine) { return engine.solver().heatLedger().heaters; });
  }
  double exchanged() {
    return tests::onEngine<double>(*m_engine, [](Engine& engine) { return engine.solver().heatLedger().exchanged; });
  }
};

QTEST_GUILESS_MAIN(TestRandomSketch)
#include "tst_randomsketch.moc"
