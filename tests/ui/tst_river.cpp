// SPDX-License-Identifier: Apache-2.0
// A river that a tap feeds, on ground that is dug and heaped by strokes while it flows: it falls over an edge,
// over another one as well once a course leads there and the old one is heaped up, and over the first alone once that
// is taken back.
#include "tests/shared/scenes.h"
#include "tests/ui/tooltesting.h"

#include <QtTest/QTest>

#include <array>
#include <cmath>
#include <optional>

using namespace ps;

namespace {

constexpr double kSpacing = 0.03, kTop = 6 * kSpacing, kHalf = 12 * kSpacing;  // of the plateau
constexpr double kDepth = 3 * kSpacing;                                        // of a river bed

/// Ground that stands still, a tap above its left end.
Project plateau() {
  Project project;
  project.materials.push_back(scenes::water());
  project.environment = scenes::tray(0.9, 1);
  project.solver.parameters.values["particle_spacing"] = kSpacing;
  Body ground = scenes::block("ground", 1, kSpacing, {0, kTop / 2, 0}, 290);
  std::get<BoxShape>(ground.shape).size = {2 * kHalf, kTop, 2 * kHalf};
  ground.material = "iron";
  ground.parameters.values["fixed"] = true;
  SceneMaterial iron;
  iron.id = iron.base = "iron";
  iron.label = "Iron";
  project.materials.push_back(iron);
  project.bodies.push_back(ground);
  Emitter tap;
  tap.id = tap.name = "tap";
  tap.material = "water";
  tap.point = {-0.18, kTop + 0.15, 0};
  tap.parameters.values = {{"diameter", 2.5 * kSpacing}, {"speed", 0.6}};
  project.emitters.push_back(tap);
  return project;
}

}  // namespace

class TestRiver : public ToolTest {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    open(plateau());
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot() != nullptr; }));
  }
  void cleanup() { close(); }

  void itChangesItsCourse() {
    // The bed, from below the tap to the right edge.
    dig({-0.21, kTop, 0}, {kHalf + 0.03, kTop, 0});
    m_engine->play();
    QVERIFY(fallsOver(0, 2));
    // Another one to the front edge, from the middle; then the old one is heaped up beyond it, as often as water leaves
    // room there: never to its bottom, so that some goes on that way.
    dig({0, kTop, kDepth + 0.06}, {0, kTop, kHalf + 0.03});
    for (int layer = 0; layer < 12; ++layer) {
      heap({0.18, kTop - kDepth + (layer % 4 + 0.5) * kSpacing, -kDepth}, {0.18, 0, kDepth});
      flow(10);
    }
    QVERIFY(fallsOver(2));
    // What was dug and heaped is taken back, and the river is in its old bed again.
    while (m_document->undoStack().index() > 1) m_document->undoStack().undo();
    QVERIFY(fallsOver(0, 2));
  }

 private:
  void dig(const Vector3& from, const Vector3& to) {
    take("cube", kDepth);
    stroke(from, to, true);
  }
  void heap(const Vector3& from, const Vector3& to) {
    take("cube", 1.5 * kSpacing);
    BrushSettings brush = m_tools->brush();
    brush.material = "iron";
    brush.becomes = "fixed";
    brush.drawOn = DrawOn::Level;
    brush.planeAt = from.y();
    m_tools->setBrush(brush);
    stroke(from, {to.x(), from.y(), to.z()}, false);
  }
  void stroke(const Vector3& from, const Vector3& to, bool erases) {
    constexpr int kSteps = 20;
    Tool& tool = m_tools->tool();
    const auto pointer = [&](int step) {
      Pointer one = at(from + step * (to - from) / kSteps);
      one.control = erases;
      one.seconds = 0.02 * step;
      return one;
    };
    const int before = m_document->undoStack().index();
    QVERIFY(tool.press(pointer(0)));
    for (int step = 1; step <= kSteps; ++step) tool.drag(pointer(step));
    tool.release(pointer(kSteps));
    QCOMPARE(m_document->undoStack().index(), before + 1);
  }
  void flow(uint64_t frames) {
    const uint64_t frame = m_engine->snapshot()->stats.frame;
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->stats.frame >= frame + frames; }, 120000));
    QCOMPARE(m_engine->snapshot()->flags, StepFlags{0});
  }
  /// Comes to fall over the edge across one axis, and hardly any more over that across another one, where one is named:
  /// within 40 s.
  bool fallsOver(int axis, std::optional<int> other = {}) {
    std::array<size_t, 3> seen{};
    for (int k = 0; k < 40 && !QTest::currentTestFailed(); ++k) {
      seen = {};
      for (int look = 0; look < 10; ++look) {
        flow(6);
        for (const int a : {0, 2}) seen[static_cast<size_t>(a)] += falling(a);
      }
      const size_t there = seen[static_cast<size_t>(axis)];
      if (other ? there > 40 && 10 * seen[static_cast<size_t>(*other)] < there : there > 8) return true;
    }
    qWarning("to the right %zu, to the front %zu", seen[0], seen[2]);
    return false;
  }
  /// Water in the air beside the edge across an axis.
  size_t falling(int axis) const {
    const SnapshotPtr now = m_engine->snapshot();
    size_t count = 0;
    for (size_t i = 0; i < now->position.size(); ++i) {
      const Vector3 p = vectorOf(now->position[i]);
      const bool isBeside = p[axis] > kHalf && p[axis] < kHalf + 4 * kSpacing && std::abs(p[2 - axis]) < kHalf;
      count +=
          now->materialIds[now->material[i]] == "water" && isBeside && p.y() > 2 * kSpacing && p.y() < kTop ? 1 : 0;
    }
    return count;
  }
};

QTEST_GUILESS_MAIN(TestRiver)
#include "tst_river.moc"
