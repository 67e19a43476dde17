// SPDX-License-Identifier: Apache-2.0
// A thousand edits of all kinds at random, with undo and redo among them, some before the first step and most while
// matter flows: all of them undone, the document, the matter and the heat of hands are what they were; redone, what
// they had become.
#include "core/io/projectio.h"
#include "core/solver/solver.h"
#include "tests/shared/enginehands.h"
#include "tests/shared/random.h"
#include "tests/shared/scenes.h"
#include "tests/ui/tooltesting.h"

#include <QtTest/QTest>

#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

using namespace ps;

namespace {

constexpr double kSpacing = 0.03;
constexpr int kEditsAtStart = 100, kEdits = 1000;

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
    m_plays = false;
    m_strokes.clear();
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
    for (int k = 0; k < kEditsAtStart && !QTest::currentTestFailed(); ++k) edit(random);
    QCOMPARE(m_engine->snapshot()->stats.frame, uint64_t{0});
    m_engine->stepOnce();
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->stats.frame == 1; }));
    m_engine->play();
    m_plays = true;
    for (int k = kEditsAtStart; k < kEdits && !QTest::currentTestFailed(); ++k) edit(random);
    for (const auto& [brush, strokes] : m_strokes)
      qInfo("%s: %d of %d strokes", brush.c_str(), strokes.second, strokes.first);
    for (const char* brush :
         {"cube", "sphere opposite", "stamp", "fill", "paint", "tint", "smooth", "heat", "cut", "weld"})
      QVERIFY2(m_strokes[brush].second > 0, brush);
    m_tools->tool().cancel();  // what may still be running full
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
    } else if (what < 0.4) {
      draw(random);
    } else if (what < 0.55) {
      take("sphere", random.next(0.02, 0.03));
      stroke(random, true);
    } else if (what < 0.7 || !m_plays) {
      rework(random);
    } else {
      const char* brushes[] = {"heat", "cool", "grab", "push", "stir", "cut", "weld"};
      take(brushes[static_cast<size_t>(7 * random.next())], 0.06);
      stroke(random, random.next() < 0.2);
    }
    sound();
  }
  void draw(ps::testing::Random& random) {
    const double which = random.next();
    const char* brush = which < 0.4 ? "cube" : which < 0.8 ? "sphere" : which < 0.9 ? "stamp" : "fill";
    if (m_document->body("ice")) m_selection->selectBody("ice");  // that is stamped
    take(brush, random.next(0.02, 0.03));
    BrushSettings settings = m_tools->brush();
    settings.material = random.next() < 0.7 ? "water" : "wax";
    settings.temperature = random.next() < 0.5 ? 263 : 290;
    settings.held = random.next() < 0.2;
    m_tools->setBrush(settings);
    stroke(random, false);
  }
  /// What is there becomes of another material, of another colour, or smooth: that one before the first step alone.
  void rework(ps::testing::Random& random) {
    const char* brushes[] = {"paint", "tint", "smooth"};
    take(brushes[static_cast<size_t>(3 * random.next())], random.next(0.02, 0.05));
    BrushSettings settings = m_tools->brush();
    settings.material = random.next() < 0.5 ? "water" : "wax";
    m_tools->setBrush(settings);
    stroke(random, false);
  }
  void stroke(ps::testing::Random& random, bool erases) {
    const std::string brush = m_tools->brush().shape + (erases ? " opposite" : "");
    const int before = m_document->undoStack().index();
    // What runs full does so up to where it begins.
    const double highest = m_tools->brush().shape == "fill" ? 0.02 : 0.2;
    Vector3 place(random.next(-0.4, 0.8), random.next(0, highest), random.next(-0.4, 0.8));
    const SnapshotPtr now = m_engine->snapshot();
    const auto any = static_cast<size_t>(random.next() * static_cast<double>(now->position.size()));
    if (m_tools->brush().shape != "fill" && random.next() < 0.5 && any < now->position.size())
      place = vectorOf(now->position[any]);
    Pointer pointer = at(place);
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
    ++m_strokes[brush].first;
    if (m_document->undoStack().index() > before) ++m_strokes[brush].second;
  }
  void awaitFrames(uint64_t count) {
    if (!m_plays) return;
    const uint64_t frame = m_engine->snapshot()->stats.frame;
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->stats.frame >= frame + count; }, 30000));
  }
  /// Nothing has gone wrong in the frames up to now.
  void sound() {
    const SnapshotPtr now = m_engine->snapshot();
    QVERIFY2(now->flags == 0, qPrintable(QString::number(now->flags)));
    QCOMPARE(m_engine->playing(), m_plays);
  }
  bool m_plays = false;
  std::map<std::string, std::pair<int, int>> m_strokes;  ///< by brush: tried, and steps of undo
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
