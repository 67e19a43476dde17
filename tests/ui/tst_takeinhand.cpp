// SPDX-License-Identifier: Apache-2.0
// A tool is led through water by rays, without a widget, in a scene that runs.
#include "core/geometry/toolbodies.h"
#include "core/scene/pose.h"
#include "tests/shared/enginehands.h"
#include "tests/shared/scenes.h"
#include "tests/ui/tooltesting.h"
#include "ui/tools/handbrush.h"
#include "ui/tools/handtool.h"
#include "ui/tools/surface.h"

#include <QtTest/QTest>

#include <Eigen/Geometry>

#include <algorithm>
#include <memory>
#include <numbers>
#include <optional>
#include <ranges>

using namespace ps;

namespace {

constexpr double kSpacing = 0.03;
const Vector3 kPlace(-0.2, 0.2, 0);

/// Water in a tray, and an upright plate beside it.
Project tub() {
  Project project = scenes::iceOnPlate(5, 300, 1);
  project.environment = scenes::tray(0.6, 1.2);
  project.bodies.clear();
  Body water = scenes::block("water", 10, kSpacing, {0, 0.15, 0}, 300);
  project.bodies.push_back(water);
  Body plate = toolBody(ToolForm::Kind::Plate, 0.6, kSpacing);
  plate.id = "plate";
  plate.material = "water";
  plate.parameters.values["temperature"] = 260.0;
  project.bodies.push_back(
      moved(plate, {Quaternion(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3(0, 1, 0))), kPlace}));
  return project;
}

}  // namespace

class TestTakeInHand : public ToolTest {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    open(tub());
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot() != nullptr; }));
    m_tools->activate("hand");
    m_grip.reset();
  }
  void cleanup() { close(); }

  /// A casting lies at the wall of its mould: the hand that closes at it does not take the mould.
  void aHandLeavesToOthersWhatIsNearerAndFree() {
    auto scene = std::make_shared<Snapshot>(*m_engine->snapshot());
    const auto is = [&](const char* body) {
      return [&scene, body](size_t i) { return (*scene->bodyIds)[scene->body[i]] == body; };
    };
    const auto indices = std::views::iota(size_t{0}, scene->position.size());
    const size_t wall = *std::ranges::find_if(indices, is("plate")), lump = *std::ranges::find_if(indices, is("water"));
    HandInScene hand;
    hand.place = vectorOf(scene->position[wall]) + Vector3(0, 0.3 * kSpacing, 0);
    const auto taken = [&](bool leavesFree) {
      HandTool tool(*m_tools);
      const bool takes = tool.take(hand, scene, leavesFree);
      tool.letGo();
      return takes;
    };
    QVERIFY(taken(true) && taken(false));
    scene->position[lump] = float4Of(*hand.place, 0);
    QVERIFY(taken(true));  // liquid is in the way of nothing
    scene->motion[lump] = api::Motion::Solid;
    QVERIFY(!taken(true) && taken(false));
    hand.place = vectorOf(scene->position[wall]);
    QVERIFY(taken(true));
  }

  void itIsLedThroughWaterInOneStepOfUndo() {
    const Vector3 before = pivotOf(*m_document->body("plate"));
    m_engine->play();
    QVERIFY(tool().press(at(grip())));
    QCOMPARE(m_selection->body(), std::string("plate"));
    double pushed = 0;
    for (int step = 1; step <= 20; ++step) {
      tool().drag(at(grip() + Vector3(0.015 * step, 0, 0)));
      QTest::qWait(15);
      pushed = std::max(pushed, push());
    }
    tool().release(at(grip()));
    const Vector3 way = pivotOf(*m_document->body("plate")) - before;
    QVERIFY2((way - Vector3(0.3, 0, 0)).norm() < 1e-6, qPrintable(QString::number(way.x())));
    QCOMPARE(m_document->undoStack().count(), 1);
    QCOMPARE(m_document->undoStack().undoText(), QStringLiteral("moving Plate by hand"));
    QVERIFY(QTest::qWaitFor([&] { return (matter() - before - way).norm() < 1e-4; }));
    const SnapshotPtr seen = m_engine->snapshot();
    QVERIFY(seen->tools.size() == 1 && seen->tools[0].body == "plate");
    QVERIFY2(pushed > 0.5, qPrintable(QString::number(pushed)));
    m_document->undoStack().undo();
    QCOMPARE(pivotOf(*m_document->body("plate")), before);
    QVERIFY(QTest::qWaitFor([&] { return (matter() - before).norm() < 1e-4; }));
    m_document->undoStack().redo();
    QVERIFY(QTest::qWaitFor([&] { return (matter() - before - way).norm() < 1e-4; }));
  }

  /// Nothing can be led while no time passes.
  void itIsPutThereInAPause() {
    const Vector3 before = matter();
    QVERIFY(tool().press(at(grip())));
    tool().drag(at(grip() + Vector3(0.1, 0, 0)));
    QVERIFY(QTest::qWaitFor([&] { return std::abs(matter().x() - before.x() - 0.1) < 1e-5; }));
    QVERIFY(tool().cancel());
    QVERIFY(QTest::qWaitFor([&] { return (matter() - before).norm() < 1e-5; }));
    QCOMPARE(m_document->undoStack().count(), 0);
  }

  /// It stays over the floor and within the walls.
  void itStaysInTheRoom() {
    QVERIFY(tool().press(at(grip())));
    tool().drag(at(grip() + Vector3(-2, -1, 0)));
    const BodyBounds bounds = boundsOf(*m_document->body("plate"));
    QVERIFY(bounds.minimum.x() > -0.6 - 1e-9 && bounds.minimum.y() > -1e-9);
    QVERIFY(bounds.minimum.x() < -0.55);
    tool().release(at(grip()));
  }

  void shiftLeadsItAlongTheLevel() {
    const Vector3 before = pivotOf(*m_document->body("plate"));
    QVERIFY(tool().press(at(grip())));
    Pointer level = at(grip());
    level.shift = true;
    tool().drag(level);
    level = at(grip() + Vector3(0, 0, 0.1));
    level.shift = true;
    tool().drag(level);
    const Vector3 way = pivotOf(*m_document->body("plate")) - before;
    QVERIFY2((way - Vector3(0, 0, 0.1)).norm() < 1e-6, qPrintable(QString::number(way.z())));
    tool().release(level);
  }

  void keysTurnIt() {
    QVERIFY(!tool().takesText(QStringLiteral("d")));
    QVERIFY(tool().press(at(grip())));
    QVERIFY(tool().takesText(QStringLiteral("d")) && !tool().takesText(QStringLiteral("5")));
    const Body before = *m_document->body("plate");
    for (int step = 0; step < 6; ++step) QVERIFY(tool().type(QStringLiteral("d")));
    const auto move = moveBetween(before, *m_document->body("plate"));
    QVERIFY(move && std::abs(move->turn.angularDistance(Quaternion::Identity()) - std::numbers::pi / 2) < 1e-6);
    tool().release(at(grip()));
    QCOMPARE(m_document->undoStack().count(), 1);
  }

  /// Not water, and nothing that is locked.
  void whatCannotBeTakenIsLeft() {
    QVERIFY(!tool().press(at({0.1, 0.3, 0})));
    m_document->setLocked({{Owner::Body, "plate", ""}}, true);
    QVERIFY(!tool().press(at(grip())));
    QCOMPARE(m_document->undoStack().count(), 1);
  }

 private:
  Tool& tool() { return m_tools->tool(); }
  /// m, on the plate's surface as it is seen.
  Vector3 grip() {
    if (!m_grip) m_grip = matterOn(at(kPlace + Vector3(0.03, 0.1, 0)));
    return m_grip.value_or(kPlace);
  }
  std::optional<Vector3> m_grip;
  /// m, mean of the plate's particles.
  Vector3 matter() {
    return tests::onEngine<Vector3>(*m_engine, [](Engine& engine) {
      const ParticleStore& store = engine.particles();
      Vector3 sum(0, 0, 0);
      double count = 0;
      for (size_t i = 0; i < store.size(); ++i) {
        if (engine.bodyIds()[store.body()[i]] != "plate") continue;
        sum += vectorOf(store.position()[i]);
        ++count;
      }
      return Vector3(sum / count);
    });
  }
  /// kg m/s, momentum of the water along the way.
  double push() {
    return tests::onEngine<double>(*m_engine, [](Engine& engine) {
      const ParticleStore& store = engine.particles();
      double sum = 0;
      for (size_t i = 0; i < store.size(); ++i)
        sum += store.velocity()[i].w > 0 ? double{store.mass()[i]} * store.velocity()[i].x : 0;
      return sum;
    });
  }
};

QTEST_GUILESS_MAIN(TestTakeInHand)
#include "tst_takeinhand.moc"
