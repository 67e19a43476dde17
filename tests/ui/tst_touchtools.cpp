// SPDX-License-Identifier: Apache-2.0
// Brushes that work on the matter that is there, driven by rays, without a widget, in a scene that runs.
#include "core/base/callee.h"
#include "core/io/projectio.h"
#include "core/scene/pose.h"
#include "core/sketch/redraw.h"
#include "core/solver/solver.h"
#include "tests/shared/enginehands.h"
#include "tests/shared/scenes.h"
#include "tests/ui/tooltesting.h"
#include "ui/tools/handbrush.h"
#include "ui/tools/livetouch.h"
#include "ui/tools/sight.h"

#include <QtCore/QElapsedTimer>
#include <QtTest/QSignalSpy>
#include <QtTest/QTest>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

using namespace ps;

namespace {

constexpr double kSpacing = 0.03, kScale = 100;

}  // namespace

class TestTouchTools : public ToolTest {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    Project project = scenes::iceOnPlate(5, 300, kScale);
    project.environment = scenes::tray(0.6, 1.2);
    open(project);
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot() != nullptr; }));
  }

  void cleanup() { close(); }

  /// On top of the block, without moving: the heat is the power times the time of the scene.
  void aHandHeatsForAsLongAsItIsHeld() {
    const Project before = m_document->project();
    take("heat");
    m_engine->play();
    Tool& tool = m_tools->tool();
    QVERIFY(tool.press(at(kTop)));
    QVERIFY(tool.picture().cursor && !tool.picture().cursor->erase);
    const double start = time();
    QVERIFY(QTest::qWaitFor([&] { return time() > start + 0.3; }));
    tool.release(at(kTop));
    m_engine->pause();
    QVERIFY(settled());
    QCOMPARE(m_document->undoStack().count(), 1);
    QCOMPARE(m_document->undoStack().undoText(), QStringLiteral("Heat matter"));
    QVERIFY(m_document->project().bodies.size() == 1 &&
            m_document->project().bodies[0].shape == before.bodies[0].shape);
    const double given = heaters(), frames = given / (100 * kScale / 60);
    QVERIFY2(std::abs(frames - std::round(frames)) < 1e-6 && frames > 15, qPrintable(QString::number(frames)));
    m_document->undoStack().undo();
    QVERIFY(std::abs(heaters()) < 1e-6 * given);
    m_document->undoStack().redo();
    QVERIFY(std::abs(heaters() - given) < 1e-6 * given);
    // At the start nothing of it is there, and there is nothing to take back.
    QSignalSpy left(m_link.get(), &SceneLink::strokesLeft);
    QTRY_COMPARE(m_link->strokesHomeLeaves(), size_t{1});
    QCOMPARE(m_link->strokesOfTheRun(), size_t{0});
    m_link->reset();
    QCOMPARE(left.count(), 1);
    m_document->undoStack().undo();
    QCOMPARE(heaters(), 0.0);
  }

  /// It thinks for as long as it wants to: the pointer goes on, and what it says counts once it comes.
  void aSlowBrushDoesNotStopTheWindow() {
    takeFixture(QStringLiteral("endless_touch"));
    m_engine->play();
    Tool& tool = m_tools->tool();
    QSignalSpy refused(m_tools.get(), &Toolbox::refused);
    QVERIFY(tool.press(at(kTop)));
    QElapsedTimer clock;
    clock.start();
    for (int k = 1; k <= 10; ++k) {
      Pointer pointer = at(kTop);
      pointer.seconds = 0.01 * k;
      tool.drag(pointer);
    }
    QVERIFY2(clock.elapsed() < 1000, qPrintable(QString::number(clock.elapsed())));  // each alone would take 2 s
    QVERIFY(!ongoingCalls().empty());
    QCOMPARE(heaters(), 0.0);
    qputenv("PS_LET_GO", "1");
    const double start = time();
    QVERIFY(QTest::qWaitFor([&] { return heaters() > 0 && time() > start + 0.1; }));
    tool.release(at(kTop));
    m_engine->pause();
    QVERIFY(settled());
    QCOMPARE(refused.count(), 0);
    QCOMPARE(m_document->undoStack().count(), 1);
    qunsetenv("PS_LET_GO");
  }

  /// Nor one that never comes back, which is put aside.
  void aBrushThatDoesNotComeBackIsPutAside() {
    takeFixture(QStringLiteral("endless_touch"));
    m_engine->play();
    QSignalSpy refused(m_tools.get(), &Toolbox::refused);
    QVERIFY(m_tools->tool().press(at(kTop)));
    QCOMPARE(refused.count(), 0);
    QTRY_COMPARE_WITH_TIMEOUT(refused.count(), 1, 30000);
    QVERIFY2(refused.front()[1].toString().contains(QStringLiteral("it does not come back")),
             qPrintable(refused.front()[1].toString()));
    m_tools->tool().release(at(kTop));
    QCOMPARE(m_document->undoStack().count(), 0);
    QVERIFY(m_tools->brush().shape != "fixture.touch");
    qputenv("PS_LET_GO", "1");  // what it says now is dropped
    QTRY_VERIFY(ongoingCalls().empty());
    qunsetenv("PS_LET_GO");
    QCOMPARE(heaters(), 0.0);
  }

  /// It heats all of the block where the hand is on it, and nothing of it where it sees none; once the hand has let go
  /// nothing that it saw is kept.
  void aHandSeesTheMatterWithinItsReach() {
    takeFixture(QStringLiteral("seeing_touch"));
    take("fixture.touch", 1);
    m_engine->play();
    Tool& tool = m_tools->tool();
    const auto hold = [&](const Vector3& place) {
      QVERIFY(tool.press(at(place)));
      const double start = time();
      QVERIFY(QTest::qWaitFor([&] { return time() > start + 0.1; }));
      tool.release(at(place));
    };
    hold(Vector3(0.4, 0, 0.4));
    QCOMPARE(heaters(), 0.0);
    const std::weak_ptr<const Snapshot> seen = m_engine->snapshot();
    hold(kTop);
    QVERIFY(heaters() > 0);
    QTRY_VERIFY(seen.expired());
  }

  /// Through a face of a periodic box too: the nearest image of what is there.
  void whatIsSeenLiesAroundTheHand() {
    Snapshot scene;
    for (const Vector3& place : {Vector3(0.95, 0, 0), Vector3(0.8, 0, 0), Vector3(-0.95, 0.95, 0)}) {
      scene.position.push_back(float4Of(place, 0.01F));
      scene.temperature.push_back(300), scene.speed.push_back(0), scene.body.push_back(0), scene.material.push_back(0);
      scene.phase.push_back(api::Phase::Solid), scene.motion.push_back(api::Motion::Solid);
    }
    const Vector3 hand(-0.95, 0, 0);
    QVERIFY(seenIn(scene, hand, 0.15).position.empty());
    scene.period = Period({-1, -1, -1}, {1, 1, 1}, {true, false, false});
    const SeenMatter seen = seenIn(scene, hand, 0.15);
    QCOMPARE(seen.position.size(), size_t{1});
    QVERIFY((vectorOf(seen.position[0]) - Vector3(-1.05, 0, 0)).norm() < 1e-6);  // in single precision
    QCOMPARE(seen.position[0].w, 0.01F);
  }

  void controlDoesTheOpposite() {
    take("heat");
    m_engine->play();
    Pointer pointer = at(kTop);
    pointer.control = true;
    QVERIFY(m_tools->tool().press(pointer));
    QVERIFY(!m_tools->tool().picture().cursor->erase);
    QVERIFY(QTest::qWaitFor([&] { return heaters() < 0; }));
    m_tools->tool().release(pointer);
    QVERIFY(m_document->undoStack().undoText().contains(QStringLiteral("opposite")));
  }

  void escTakesBackWhatWasGiven() {
    take("cool");
    m_engine->play();
    QVERIFY(m_tools->tool().press(at(kTop)));
    QVERIFY(QTest::qWaitFor([&] { return heaters() < 0; }));
    QVERIFY(m_tools->tool().cancel());
    QVERIFY(std::abs(heaters()) < 1e-3);
    m_tools->tool().release(at(kTop));
    QCOMPARE(m_document->undoStack().count(), 0);
  }

  /// With the power that a brush for heat begins with, where heat is as fast as it really is.
  void iceBeginsToMeltWithinTwoSeconds() {
    Project project = scenes::iceOnPlate(5, 263.15, 1);
    project.environment = scenes::tray(0.6, 1.2);
    close();
    open(project);
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot() != nullptr; }));
    take("heat");
    QVERIFY(standardValues(*m_document, "heat").values.empty());
    m_engine->play();
    QVERIFY(m_tools->tool().press(at(kTop)));
    const double start = time();
    const auto melts = [this] {
      const std::vector<api::Phase>& phase = m_engine->snapshot()->phase;
      return std::any_of(phase.begin(), phase.end(), [](api::Phase one) { return one != api::Phase::Solid; });
    };
    QVERIFY(QTest::qWaitFor(melts, 30000));
    QVERIFY2(time() < start + 2, qPrintable(QString::number(time() - start)));
    m_tools->tool().release(at(kTop));
  }

  /// The same power by the clock that people look at.
  void powersGoByTheSpeedOfHeat() {
    const auto power = [this](const char* brush) {
      return std::get<double>(standardValues(*m_document, brush).values.at("power"));
    };
    QVERIFY(std::abs(power("heat") - 10000 / kScale) < 1e-9 && std::abs(power("cool") - 10000 / kScale) < 1e-9);
    QVERIFY(standardValues(*m_document, "grab").values.empty());
    QCOMPARE(m_document->setParameter({Owner::Solver, "", "thermal_time_scale"}, 3000.0), QString());
    QVERIFY(std::abs(power("heat") - 3.3) < 1e-9);
  }

  void brushesForHeatTellHowWarmItIs() {
    const auto told = [this](const char* brush, const Vector3& place) {
      take(brush);
      m_tools->tool().hover(at(place));
      m_tools->tool().see(m_engine->snapshot().get());
      const auto tag = m_tools->tool().picture().tag;
      return tag ? tag->value : QString();
    };
    for (const char* brush : {"heat", "cool"}) {
      QVERIFY2(told(brush, kTop).contains(QStringLiteral("°C")), brush);
      QVERIFY(m_tools->tool().words().contains(QStringLiteral("°C")));
      QCOMPARE(told(brush, Vector3(0.25, 0, 0.25)), QString());  // on the floor, where nothing is
    }
    for (const char* brush : {"cut", "sphere"}) QCOMPARE(told(brush, kTop), QString());
  }

  void lockedBodiesAreSpared() {
    m_document->setLocked({{Owner::Body, "ice", ""}}, true);
    take("heat");
    m_engine->play();
    QVERIFY(m_tools->tool().press(at(kTop)));
    const double start = time();
    QVERIFY(QTest::qWaitFor([&] { return time() > start + 0.1; }));
    m_tools->tool().release(at(kTop));
    QCOMPARE(heaters(), 0.0);
  }

  void whatStandsInTheWayIsSaid() {
    take("heat");
    QSignalSpy refused(m_tools.get(), &Toolbox::refused);
    m_tools->tool().press(at(kTop));
    m_tools->tool().release(at(kTop));
    QCOMPARE(refused.count(), 1);
    QVERIFY(refused[0][1].toString().contains(QStringLiteral("Space")));
    Project cold = m_document->project();
    cold.solver.thermalModel.clear();
    m_document->open(cold, {}, false, true);
    QVERIFY(QTest::qWaitFor([&] { return m_engine->playing(); }));
    m_tools->tool().press(at(kTop));
    m_tools->tool().release(at(kTop));
    QCOMPARE(refused.count(), 2);
    QVERIFY(refused[1][1].toString().contains(QStringLiteral("thermal model")));
    QCOMPARE(m_document->undoStack().count(), 0);
  }

  /// Up, across the view, which is seen from above at 45 degrees: by 0.12 m, less some sag. No step of undo, as there
  /// is nothing that it could take back.
  void aHandCarriesAcrossTheView() {
    take("grab", 0.09);
    m_engine->play();
    const double before = height();
    QVERIFY(m_tools->tool().press(at(kTop)));
    for (int step = 1; step <= 20; ++step) {
      Pointer pointer = at(Vector3(0, kTop.y() + 0.01 * step, 0));
      pointer.seconds = 0.02 * step;
      m_tools->tool().drag(pointer);
      QTest::qWait(20);
    }
    QVERIFY(QTest::qWaitFor([&] { return height() > before + 0.09; }));
    m_tools->tool().release(at(kTop));
    QVERIFY(QTest::qWaitFor([&] { return height() < before + 0.02; }));
    QCOMPARE(m_document->undoStack().count(), 0);
  }

  /// Where the block has gone, the hand that stays comes to the floor.
  void aHandFollowsWhatIsThere() {
    take("heat");
    m_engine->play();
    Tool& tool = m_tools->tool();
    QVERIFY(tool.press(at(kTop)));
    const SnapshotPtr there = m_engine->snapshot();
    tool.see(there.get());
    QCoreApplication::processEvents();
    QVERIFY(tool.picture().cursor->centre.y() > 0.1);
    Snapshot gone = *there;
    gone.position.clear();
    tool.see(&gone);
    QVERIFY(QTest::qWaitFor([&] { return tool.picture().cursor->centre.y() < 0.01; }));
    QVERIFY(tool.cancel());
    tool.see(there.get());
    QCoreApplication::processEvents();
    QVERIFY(!tool.cancel());
  }

  /// Across the top of the block, as deep as it is: in two, as one step, and Control welds.
  void aHandCutsAndWelds() {
    take("cut", 0.3);
    m_engine->play();
    QCOMPARE(pieces(), size_t{1});
    const auto across = [&](bool control) {
      Tool& tool = m_tools->tool();
      for (int step = 0; step <= 8; ++step) {
        Pointer pointer = at(Vector3(0.004, kTop.y(), 0.06 - 0.015 * step));
        pointer.control = control;
        pointer.seconds = 0.02 * step;
        step == 0 ? static_cast<void>(tool.press(pointer)) : tool.drag(pointer);
        QTest::qWait(20);
      }
      tool.release(at(kTop));
    };
    across(false);
    QCOMPARE(m_document->undoStack().count(), 1);
    QCOMPARE(m_document->undoStack().undoText(), QStringLiteral("Cut matter"));
    QTRY_COMPARE(pieces(), size_t{2});
    m_document->undoStack().undo();
    QTRY_COMPARE(pieces(), size_t{1});
    m_document->undoStack().redo();
    QTRY_COMPARE(pieces(), size_t{2});
    across(true);
    QCOMPARE(m_document->undoStack().count(), 2);
    QTRY_COMPARE(pieces(), size_t{1});
    m_document->undoStack().undo();
    QTRY_COMPARE(pieces(), size_t{2});
  }

  /// What was drawn is rounded, in the document and in the scene, as one step; a reset makes the same, and its strokes
  /// do when they are drawn again.
  void aSketchIsSmoothed() {
    m_tools->activate(kBrushTool);
    take("cube", 0.1);
    const Vector3 beside(0.3, 0, 0);
    paintAt(beside);
    QVERIFY(count() > 0);
    const std::string before = writeProject(m_document->project());
    const size_t drawn = count();
    take("smooth", 0.25);
    QVERIFY(m_tools->reworks() && !m_tools->tool().words().contains(QStringLiteral("water")));
    const int steps = m_document->undoStack().count();
    paintAt(beside + Vector3(0, 0.2, 0));
    QCOMPARE(m_document->undoStack().count(), steps + 1);
    QCOMPARE(m_document->undoStack().undoText(), QStringLiteral("smoothing stroke"));
    const size_t smooth = count();
    QVERIFY2(smooth < drawn && smooth > drawn / 2, qPrintable(QString::number(smooth)));
    const std::string after = writeProject(m_document->project());
    const auto& voxels = std::get<VoxelShape>(m_document->project().bodies[1].shape);
    QCOMPARE(voxels.strokes.size(), size_t{2});
    QCOMPARE(VoxelCanvas(voxels.runs).size() + 125, smooth);
    const FreeOf all = [](const SketchGrid&, const CellSet& some) { return some; };
    const BrushOf brushOf = [this](const std::string& id) { return m_plugins->brush(id); };
    QVERIFY(redrawn(voxels, kSpacing, all, brushOf).runs == voxels.runs);
    m_document->undoStack().undo();
    QCOMPARE(count(), drawn);
    QCOMPARE(writeProject(m_document->project()), before);
    m_document->undoStack().redo();
    QCOMPARE(count(), smooth);
    QCOMPARE(writeProject(m_document->project()), after);
    m_link->reset();
    QCOMPARE(count(), smooth);
  }

  /// A cup of cells runs full to where one points, as a body of its own; further where the stroke goes up. The strokes
  /// make the same cells again. What would run out is refused, and nothing is left of it.
  void aCupRunsFull() {
    const VoxelShape walls = addCup();
    const size_t without = count();
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->position.size() == without; }));
    m_tools->activate(kBrushTool);
    take("fill");
    const Vector3 bottom = walls.origin + Vector3(0, 2 * kSpacing, 0);
    drawOnLevel(bottom.y());
    paintAt(bottom);
    QCOMPARE(count(), without + 25 * 2);
    QCOMPARE(m_document->project().bodies.size(), size_t{3});
    for (const VoxelShape::Run& run : filled().runs) QVERIFY(run.length == 5 && run.y >= 1 && run.y <= 2);
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->position.size() == without + 25 * 2; }));
    drawOnLevel(bottom.y() + kSpacing);
    paintAt(bottom + Vector3(0, kSpacing, 0));
    QCOMPARE(count(), without + 25 * 3);
    m_document->undoStack().undo();
    QCOMPARE(count(), without + 25 * 2);
    m_document->undoStack().redo();
    QCOMPARE(count(), without + 25 * 3);
    isFilledAgain(walls);
    isFilledWhileTheCupIsHidden(bottom + Vector3(0, 4 * kSpacing, 0), without);
    fillingTheSceneIsRefused();
    QCOMPARE(count(), without + 25 * 3);
  }

  /// A large one, from its bottom upwards: the pointer that has let go does not wait, is told how far it has come, and
  /// Esc gives it up at once.
  void aLargeHollowFillsBesideTheWindow() {
    close();
    Project project = scenes::iceOnPlate(5, 300, kScale);
    project.environment = scenes::tray(0.6, 1.2);
    // What asks each cell whether it lies before all of them takes its time.
    for (int k = 0; k < 1000; ++k) {
      project.environment.walls.push_back(project.environment.walls[0]);
      project.environment.walls.back().id = "floor " + std::to_string(k);
    }
    open(project);
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot() != nullptr; }));
    take("fill", kSpacing);
    const Environment& environment = m_document->project().environment;
    const double low = environment.boundsMinimum.y(), deep = 15 * kSpacing;
    BrushSettings brush = m_tools->brush();
    brush.drawOn = DrawOn::AcrossZ;
    m_tools->setBrush(brush);
    QSignalSpy working(m_tools.get(), &Toolbox::working), refused(m_tools.get(), &Toolbox::refused);
    const size_t before = count();
    Tool& tool = m_tools->tool();
    const auto fill = [&] {
      const auto place = [&](int k) { return at({0.2, low + kSpacing + deep * k / 200, 0}); };
      tool.press(place(0));
      for (int k = 1; k <= 200; ++k) tool.drag(place(k));
      tool.release(place(200));
    };
    QElapsedTimer clock;
    fill();
    QVERIFY2(working.count() > 0, "it was done at once: make it larger");
    QCOMPARE(working[0][0].toString(), QStringLiteral("filling, of the most that may run full"));
    QTRY_VERIFY(working.last()[1].toInt() > 0);
    tool.press(at({0.2, low + kSpacing, 0}));
    QCOMPARE(refused.count(), 1);
    clock.start();
    QVERIFY(tool.cancel());
    QVERIFY2(clock.elapsed() < 200, qPrintable(QString::number(clock.elapsed())));
    QCOMPARE(working.last()[1].toInt(), -1);
    QCOMPARE(m_document->undoStack().count(), 0);
    QCOMPARE(count(), before);
    fill();
    QTRY_COMPARE_WITH_TIMEOUT(m_document->undoStack().count(), 1, 60000);
    QCOMPARE(working.last()[1].toInt(), -1);
    QVERIFY2(count() > before + 5000, qPrintable(QString::number(count())));
    QCOMPARE(refused.count(), 1);
  }

  /// A reset names the matter of each stroke by cells, which have been turned with their body by then: undone after it,
  /// each stroke takes just what is its own.
  void strokesOfATurnedSketchAreUndoneAfterAReset() {
    take("sphere", 0.06);
    const Vector3 first(0.3, 0, 0), second(0.3, 0, 0.06);
    const size_t none = count();
    paintAt(first);
    const size_t one = count();
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->position.size() == one; }));
    paintAt(second);
    const size_t two = count();
    QVERIFY(two > one && one > none);
    QCOMPARE(m_document->project().bodies.size(), size_t{2});
    const Body before = m_document->project().bodies[1];
    Placement turned;
    turned.bodies.push_back(
        moved(before, RigidMove::about(pivotOf(before) + Vector3(0, 0.2, 0),
                                       Quaternion(Eigen::AngleAxisd(0.9, Vector3(0.2, 1, 0.1).normalized())))));
    m_document->place(turned, QStringLiteral("turning"));
    QVERIFY(std::get<VoxelShape>(m_document->project().bodies[1].shape).rotation != Vector3(0, 0, 0));
    m_link->reset();
    QCOMPARE(count(), two);
    m_document->undoStack().undo();
    m_document->undoStack().undo();
    QCOMPARE(count(), one);
    m_document->undoStack().redo();
    QCOMPARE(count(), two);
    m_document->undoStack().undo();
    m_document->undoStack().undo();
    QCOMPARE(count(), none);
  }

  /// Bodies that were not drawn, and scenes that have begun.
  void whatCannotBeSmoothedIsSaid() {
    take("smooth", 0.1);
    QSignalSpy refused(m_tools.get(), &Toolbox::refused);
    paintAt(kTop);
    QCOMPARE(refused.count(), 1);
    QVERIFY(refused[0][1].toString().contains(QStringLiteral("drawn")));
    m_engine->stepOnce();
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->stats.frame == 1; }));
    paintAt(kTop);
    QCOMPARE(refused.count(), 2);
    QVERIFY(refused[1][1].toString().contains(QStringLiteral("Home")));
    QCOMPARE(m_document->undoStack().count(), 0);
  }

  void erasingNothingLeavesNoStep_data() {
    QTest::addColumn<bool>("later");
    QTest::newRow("at the start") << false;
    QTest::newRow("in a run") << true;
  }
  /// On the floor beside the block there is nothing, which is said; what is locked is said to be so.
  void erasingNothingLeavesNoStep() {
    QFETCH(bool, later);
    if (later) {
      m_engine->stepOnce();
      QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->stats.frame == 1; }));
    }
    take("sphere", 1.5 * m_tools->spacing());
    m_tools->activate("erase");
    QSignalSpy refused(m_tools.get(), &Toolbox::refused);
    const int steps = m_document->undoStack().count();
    const size_t all = m_engine->snapshot()->position.size();
    const auto eraseAt = [&](const Vector3& place) {
      m_tools->tool().press(at(place));
      m_tools->tool().release(at(place));
    };
    eraseAt({-0.2, 0, 0.2});
    QCOMPARE(m_document->undoStack().count(), steps);
    QCOMPARE(refused.count(), 1);
    QCOMPARE(refused[0][0].toString(), QStringLiteral("The matter stays as it is."));
    QCOMPARE(refused[0][1].toString(), QStringLiteral("Nothing is there to erase."));
    QCOMPARE(heaters(), 0.0);  // of all that was asked before
    QCOMPARE(m_engine->snapshot()->position.size(), all);
    eraseAt(kTop);
    QCOMPARE(m_document->undoStack().count(), steps + 1);
    QCOMPARE(m_document->undoStack().undoText(), QStringLiteral("erasing stroke"));
    QTRY_VERIFY(m_engine->snapshot()->position.size() < all);
    m_document->undoStack().undo();
    QTRY_COMPARE(m_engine->snapshot()->position.size(), all);
    m_document->setLocked({{Owner::Body, "ice", ""}}, true);
    const int locked = m_document->undoStack().count();
    eraseAt(kTop);
    QCOMPARE(m_document->undoStack().count(), locked);
    QCOMPARE(refused.last()[1].toString(), QStringLiteral("What is there is locked."));
  }

  /// The way to a brush that draws, and from the eraser, is the one that the keys go.
  void drawingComesBack() {
    m_tools->activate("erase");
    m_tools->takeBrush("cube");
    QCOMPARE(m_tools->active(), std::string("erase"));
    m_tools->takeBrush("heat");
    QCOMPARE(m_tools->active(), std::string(kBrushTool));
    QVERIFY(m_tools->touchesMatter());
    m_tools->activate(kBrushTool);
    QCOMPARE(m_tools->brush().shape, std::string("cube"));
    m_tools->takeBrush("grab");
    m_tools->activate("erase");
    QCOMPARE(m_tools->brush().shape, std::string("cube"));
    QCOMPARE(m_tools->active(), std::string("erase"));
    m_tools->takeBrush("fill");
    QCOMPARE(m_tools->active(), std::string(kBrushTool));
    QCOMPARE(m_tools->brush().shape, std::string("fill"));
    m_tools->takeBrush("stir");
    m_tools->activate(kSelectTool);
    QCOMPARE(m_tools->brush().shape, std::string("stir"));
    QVERIFY(!m_tools->tool(kBrushTool).words().contains(QStringLiteral("water")));
  }

  /// The block becomes cells of two materials, each as warm as before; a reset makes just that matter, and undo knows
  /// then as well which of it was painted.
  void paintingAtTheStartChangesTheScene() {
    const Project before = m_document->project();
    takePaint();
    const int steps = m_document->undoStack().count();
    paintAt(kTop);
    QCOMPARE(m_document->undoStack().count(), steps + 1);
    QCOMPARE(m_document->undoStack().undoText(), QStringLiteral("painting stroke"));
    const auto& voxels = std::get<VoxelShape>(m_document->project().bodies.at(0).shape);
    QCOMPARE(voxels.palette.size(), size_t{2});
    QCOMPARE(voxels.palette[1].material, std::string("iron"));
    QCOMPARE(voxels.palette[1].temperature, 263.15);
    size_t cells = 0;
    for (const VoxelShape::Run& run : voxels.runs) cells += run.palette == 1 ? static_cast<size_t>(run.length) : 0;
    QVERIFY(cells > 4 && cells < 125);
    QCOMPARE(iron(), cells);
    const std::string text = writeProject(m_document->project());
    QCOMPARE(writeProject(parseProject(text, "what was written", *m_plugins).project), text);
    m_document->undoStack().undo();
    QCOMPARE(iron(), size_t{0});
    QVERIFY(m_document->project().bodies[0].shape == before.bodies[0].shape);
    m_document->undoStack().redo();
    QCOMPARE(iron(), cells);
    m_link->reset();
    QCOMPARE(iron(), cells);
    m_engine->stepOnce();
    m_document->undoStack().undo();
    QCOMPARE(iron(), size_t{0});
    m_link->reset();
    QCOMPARE(iron(), size_t{0});
    m_document->undoStack().redo();
    QCOMPARE(iron(), cells);
    QCOMPARE(writeProject(m_document->project()), text);
  }

  /// A stroke of a sketched body is noted with it, and drawn again with the others.
  void aSketchKeepsTheStrokeThatPaintedIt() {
    m_tools->activate(kBrushTool);
    take("sphere", 0.04);
    const Vector3 beside(0.3, 0, 0);
    paintAt(beside);
    QCOMPARE(m_document->project().bodies.size(), size_t{2});
    takePaint();
    QCOMPARE(iron(), size_t{0});  // and what is drawn is to be seen
    paintAt(beside + Vector3(0, 0.07, 0));
    const auto& voxels = std::get<VoxelShape>(m_document->project().bodies[1].shape);
    QCOMPARE(voxels.strokes.size(), size_t{2});
    QCOMPARE(voxels.strokes[1].brush, std::string("paint"));
    QCOMPARE(voxels.palette.at(static_cast<size_t>(voxels.strokes[1].palette)).material, std::string("iron"));
    const FreeOf all = [](const SketchGrid&, const CellSet& some) { return some; };
    const BrushOf brushOf = [this](const std::string& id) { return m_plugins->brush(id); };
    const VoxelShape again = redrawn(voxels, kSpacing, all, brushOf);
    QVERIFY(again.palette == voxels.palette);
    QVERIFY(again.runs == voxels.runs);
  }

  /// More of a material that a part of it was painted with goes on with the same body.
  void aSketchOfSeveralMaterialsIsDrawnOn() {
    m_tools->activate(kBrushTool);
    take("sphere", 0.04);
    const Vector3 beside(0.3, 0, 0);
    paintAt(beside);
    takePaint();
    QCOMPARE(iron(), size_t{0});  // and what is drawn is to be seen
    paintAt(beside + Vector3(0, 0.07, 0));
    const size_t painted = iron();
    QVERIFY(painted > 0);
    take("cube", 0.03);  // of iron
    paintAt(beside + Vector3(0, 0.07, 0));
    QCOMPARE(m_document->project().bodies.size(), size_t{2});
    QVERIFY(iron() > painted);
    const auto& voxels = std::get<VoxelShape>(m_document->project().bodies[1].shape);
    QCOMPARE(voxels.palette.size(), size_t{2});
    QCOMPARE(voxels.strokes.back().palette, 1);
    m_link->reset();
    const size_t cells = iron();
    QVERIFY(cells > painted);
    m_document->undoStack().undo();
    QCOMPARE(iron(), painted);
  }

  /// A reset that follows the stroke of one hand waits for that of the other.
  void twoHandsDrawAtTheStart() {
    HandBrush left(*m_tools), right(*m_tools);
    const auto hand = [](double x, double pressure) {
      return HandInScene{Vector3(x, 0.1, 0.3), {0, 1, 0}, {0, 0, -1}, pressure, false, 0};
    };
    take("sphere", 0.04);
    left.follow(hand(-0.3, 1), m_engine->snapshot());
    QVERIFY(left.active());
    takePaint();
    right.follow({Vector3(0, 0.15, 0), {0, 1, 0}, {0, 0, -1}, 1, false, 0}, m_engine->snapshot());
    right.follow(hand(0, 0), m_engine->snapshot());
    QCOMPARE(m_document->undoStack().undoText(), QStringLiteral("painting stroke"));
    const uint64_t run = m_engine->snapshot()->revision;
    QTest::qWait(500);  // longer than a drag rests before it is followed
    QCOMPARE(m_engine->snapshot()->revision, run);
    left.follow(hand(-0.3, 0), m_engine->snapshot());
    QCOMPARE(m_document->project().bodies.size(), size_t{2});
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->revision != run; }));
    const Snapshot& now = *m_engine->snapshot();
    QVERIFY(std::count(now.body.begin(), now.body.end(), 1U) > 4);
  }

  /// Of the matter as it stands, which no body's start can say.
  void paintingInARunChangesMatterAlone() {
    takePaint();
    const std::string before = writeProject(m_document->project());
    m_engine->stepOnce();
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->stats.frame == 1; }));
    paintAt(kTop);
    QVERIFY(iron() > 4);
    QCOMPARE(writeProject(m_document->project()), before);
    m_document->undoStack().undo();
    QCOMPARE(iron(), size_t{0});
    m_document->undoStack().redo();
    QVERIFY(iron() > 4);
    m_link->reset();
    QCOMPARE(iron(), size_t{0});
    m_document->undoStack().undo();
    m_document->undoStack().redo();
    QCOMPARE(iron(), size_t{0});
  }

  /// In a hole that an eraser has made there is something at the start: no project can say what is drawn there.
  void whatHasNoRoomAtTheStartIsOfTheRunAlone() {
    m_engine->stepOnce();
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->stats.frame == 1; }));
    take("cube", 0.09);  // all of the block's upper part
    Pointer eraser = at(kTop);
    eraser.control = true;
    m_tools->tool().press(eraser);
    m_tools->tool().release(eraser);
    QVERIFY(QTest::qWaitFor([&] { return m_link->strokesOfTheRun() == 1; }));
    take("cube", 0.015);
    paintAt(Vector3(0, 0.06, 0));
    QCOMPARE(m_document->project().bodies.size(), size_t{2});
    QVERIFY(std::get<VoxelShape>(m_document->project().bodies[1].shape).runs.empty());
    QCOMPARE(m_link->strokesOfTheRun(), size_t{2});
    m_document->undoStack().undo();
    QCOMPARE(m_link->strokesOfTheRun(), size_t{1});
    m_document->undoStack().redo();
    QCOMPARE(m_link->strokesOfTheRun(), size_t{2});
    m_link->reset();
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->stats.frame == 0; }));
    QCOMPARE(m_link->strokesOfTheRun(), size_t{0});
  }

  void whatIsLockedIsNotPainted() {
    takePaint();
    m_document->setLocked({{Owner::Body, "ice", ""}}, true);
    const std::string before = writeProject(m_document->project());
    paintAt(kTop);
    QCOMPARE(iron(), size_t{0});
    QCOMPARE(writeProject(m_document->project()), before);
  }

  /// It meets the surface instead of standing on it, erases with Control, and is put aside for what draws.
  void thePaintBrushIsAToolLikeTheOthers() {
    takePaint();
    Tool& tool = m_tools->tool();
    tool.hover(at(kTop));
    QVERIFY((tool.picture().cursor->centre - kTop).norm() < kSpacing);
    QVERIFY(!tool.picture().cursor->erase);
    QVERIFY(tool.words().contains(QStringLiteral("paint")) && tool.words().contains(QStringLiteral("ron")));
    Pointer pointer = at(kTop);
    pointer.control = true;
    tool.hover(pointer);
    QVERIFY(tool.picture().cursor->erase);
    const int steps = m_document->undoStack().count();
    tool.press(at(kTop));
    QTRY_VERIFY(iron() > 0);
    QVERIFY(tool.cancel());
    QCOMPARE(iron(), size_t{0});
    tool.release(at(kTop));
    QCOMPARE(m_document->undoStack().count(), steps);
    m_tools->activate("erase");
    QVERIFY(!m_tools->paints());
    m_tools->takeBrush("paint");
    QCOMPARE(m_tools->active(), std::string(kBrushTool));
  }

 private:
  static const Vector3 kTop;

  /// A brush for matter that behaves so, in hand in the same scene; an endless one takes as long as PS_LET_GO is not
  /// set.
  void takeFixture(const QString& behaviour) {
    close();
    m_plugins = fixtureNamed(behaviour, QStringLiteral("fixture_touch.so"));
    init();
    connect(m_tools.get(), &Toolbox::brushFailed, this, [this](const QString& brush, const QString& problem) {
      m_plugins->fault(brush.toStdString(), problem.toStdString());
    });
    take("fixture.touch");
    QCOMPARE(m_tools->brush().shape, std::string("fixture.touch"));
  }

  void takePaint() {
    take("paint");
    BrushSettings brush = m_tools->brush();
    brush.material = m_document->addMaterial("iron");
    m_tools->setBrush(brush);
  }
  void paintAt(const Vector3& place) {
    m_tools->tool().press(at(place));
    m_tools->tool().release(at(place));
  }
  /// Beside the block, held in place: seven cells wide and high, its walls one thick.
  VoxelShape addCup() {
    Body cup;
    cup.id = "cup", cup.material = m_document->project().materials[0].id;
    cup.parameters.values["fixed"] = true;
    VoxelShape walls;
    walls.spacing = kSpacing;
    walls.origin = Vector3::Constant(kSpacing / 2) + Vector3(8 * kSpacing, 0, 0);
    walls.palette = {{cup.material, 260}};
    for (int z = -3; z <= 3; ++z) {
      for (int y = 0; y <= 6; ++y) {
        if (y == 0 || std::abs(z) == 3) {
          walls.runs.push_back({-3, y, z, 7, 0});
        } else {
          walls.runs.push_back({-3, y, z, 1, 0});
          walls.runs.push_back({3, y, z, 1, 0});
        }
      }
    }
    cup.shape = walls;
    m_document->addBody(cup);
    return walls;
  }
  /// m, of what is pointed at.
  void drawOnLevel(double height) {
    BrushSettings brush = m_tools->brush();
    setValueOf(brush, "draw_on", std::string("level"));
    setValueOf(brush, "plane_at", height);
    m_tools->setBrush(brush);
  }
  /// What the cup holds.
  VoxelShape filled() const { return std::get<VoxelShape>(m_document->project().bodies[2].shape); }
  /// From its strokes, and on a finer lattice.
  void isFilledAgain(const VoxelShape& walls) {
    const Environment& environment = m_document->project().environment;
    const FreeOf besideTheCup = [&](const SketchGrid& grid, const CellSet& cells) {
      const CellSet cupCells = VoxelCanvas(walls.runs).cells();
      std::vector<api::Cell> free;
      for (const api::Cell& cell : cells.cells()) {
        if (isInScene(environment, grid, cell) && !cupCells.contains(gridOf(walls).cellAt(grid.centreOf(cell))))
          free.push_back(cell);
      }
      return CellSet(free);
    };
    QCOMPARE(m_document->project().bodies.size(), size_t{3});
    const BrushOf brushOf = [this](const std::string& id) { return m_plugins->brush(id); };
    QVERIFY(redrawn(filled(), kSpacing, besideTheCup, brushOf, environment.gravity).runs == filled().runs);
    const VoxelShape fine = redrawn(filled(), kSpacing / 2, besideTheCup, brushOf, environment.gravity);
    QVERIFY(VoxelCanvas(fine.runs).size() > size_t{25 * 3 * 6});
  }
  /// Its walls hold all the same; undone, it stands as full as before.
  void isFilledWhileTheCupIsHidden(const Vector3& top, size_t without) {
    drawOnLevel(top.y());
    m_document->setVisible({{Owner::Body, "cup", ""}}, false);
    const auto seen = std::make_shared<Snapshot>();
    seen->bodyIds = m_engine->snapshot()->bodyIds, seen->spacing = kSpacing;
    Pointer over = at(top);
    over.scene = seen;
    m_tools->tool().press(over);
    m_tools->tool().release(over);
    QCOMPARE(count(), without + 25 * 6);
    m_document->undoStack().undo();
    m_document->undoStack().undo();
    QCOMPARE(count(), without + 25 * 3);
  }
  void fillingTheSceneIsRefused() {
    QSignalSpy refused(m_tools.get(), &Toolbox::refused);
    drawOnLevel(0.9);
    const int steps = m_document->undoStack().count();
    paintAt(Vector3(0, 0.9, 0));
    QTRY_COMPARE(refused.count(), 1);
    QVERIFY2(refused[0][1].toString().contains(QStringLiteral("run full")), qPrintable(refused[0][1].toString()));
    QCOMPARE(m_document->undoStack().count(), steps);
  }
  /// Particles of the second material.
  size_t iron() {
    return tests::onEngine<size_t>(*m_engine, [](Engine& engine) {
      const uint32_t* first = engine.particles().material();
      return static_cast<size_t>(std::count(first, first + engine.particles().size(), 1U));
    });
  }

  size_t count() {
    return tests::onEngine<size_t>(*m_engine, [](Engine& engine) { return engine.particles().size(); });
  }
  /// What hangs together, single grains left out.
  size_t pieces() {
    return tests::onEngine<size_t>(*m_engine, [](Engine& engine) {
      const std::vector<uint32_t> all = engine.solver().pieces();
      std::set<uint32_t> some(all.begin(), all.end());
      some.erase(Solver::kNoPiece);
      return some.size();
    });
  }

  double time() const { return m_engine->snapshot()->stats.time; }
  double height() const {
    double sum = 0;
    const SnapshotPtr now = m_engine->snapshot();
    for (const api::Float4& p : now->position) sum += p.y;
    return sum / static_cast<double>(now->position.size());
  }
  bool settled() {
    const double now = heaters();  // of all that was asked before
    return now != 0;
  }
  /// J that have come so far by hands.
  double heaters() {
    return tests::onEngine<double>(*m_engine, [](Engine& engine) { return engine.solver().heatLedger().heaters; });
  }
};

const Vector3 TestTouchTools::kTop{0, 0.15, 0};

QTEST_GUILESS_MAIN(TestTouchTools)
#include "tst_touchtools.moc"
