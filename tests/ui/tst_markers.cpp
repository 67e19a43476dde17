// SPDX-License-Identifier: Apache-2.0
// Markers as hands set them, in the real window.
#include "core/io/projectio.h"
#include "core/simulation/engine.h"
#include "core/simulation/runrecord.h"
#include "tests/ui/samplewindow.h"
#include "ui/graphs/graphspanel.h"
#include "ui/graphs/graphview.h"
#include "ui/session/recordedview.h"
#include "ui/timeline/keyrows.h"
#include "ui/timeline/markerrow.h"
#include "ui/timeline/timeline.h"

#include <QtTest/QtTest>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>

using namespace ps;

class TestMarkers : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    open();
    QVERIFY(m_window);
    session().pause();
  }
  void init() { backToTheStart(); }

  /// Each edit is a step; undone and done again, the project is the same to the byte.
  void everyEditIsAStepThereAndBack() {
    const auto text = [this] { return writeProject(document().project()); };
    History& stack = document().undoStack();
    std::vector<std::string> states;
    states.push_back(text());
    QCOMPARE(document().addMarker(2.5), size_t{0});
    states.push_back(text());
    document().addMarker(1);
    states.push_back(text());
    document().editMarker(0, 2.5, QStringLiteral("Ice is gone"));
    states.push_back(text());
    document().beginGesture();
    document().editMarker(1, 3, {});
    document().editMarker(1, 4, {});
    document().endGesture();
    states.push_back(text());
    document().removeMarker(0);
    states.push_back(text());
    QCOMPARE(stack.count(), static_cast<int>(states.size()) - 1);
    for (size_t k = states.size() - 1; k-- > 0;) {
      stack.undo();
      QCOMPARE(text(), states[k]);
    }
    for (size_t k = 1; k < states.size(); ++k) {
      stack.redo();
      QCOMPARE(text(), states[k]);
    }
    QCOMPARE(markers(), (std::vector<Marker>{{4, "Marker 2"}}));
    // What ends where it began is no step, and one of an emptied name keeps it.
    const int steps = stack.count();
    document().beginGesture();
    document().editMarker(0, 5, {});
    document().editMarker(0, 4, {});
    document().endGesture();
    document().editMarker(0, 4, QStringLiteral("  "));
    QCOMPARE(stack.count(), steps);
  }

  void aHandSetsMovesNamesAndDeletesThem() {
    MarkerRow& row = *m_window->findChild<MarkerRow*>();
    QVERIFY(!row.isVisible());
    const int height = m_window->findChild<Timeline*>()->height();
    const std::string empty = writeProject(document().project());
    QTest::keyClick(m_window.get(), Qt::Key_M, Qt::ShiftModifier);
    QTRY_VERIFY_WITH_TIMEOUT(row.isVisible(), kLong);
    QCOMPARE(m_window->findChild<Timeline*>()->height(), height + MarkerRow::kHeight);
    QCOMPARE(markers(), (std::vector<Marker>{{0, "Marker 1"}}));
    const KeyRows& scale = *m_window->findChild<KeyRows*>();
    const auto at = [&](double seconds) {
      return QPoint(static_cast<int>(std::lround(scale.xOf(seconds))), MarkerRow::kHeight / 2);
    };
    QVERIFY(at(60).x() > row.width() * 3 / 4 && at(60).x() < row.width());
    QTest::mouseDClick(&row, Qt::LeftButton, {}, at(20));
    QCOMPARE(markers().size(), size_t{2});
    QVERIFY(std::abs(markers()[1].time - 20) < 60.0 / row.width());
    const double frame = markers()[1].time * 60;  // kept to a microsecond
    QVERIFY(std::abs(frame - std::round(frame)) < 1e-4);
    // Dragged: one step.
    const int steps = document().undoStack().count();
    QTest::mousePress(&row, Qt::LeftButton, {}, row.placeOf(1));
    for (int k = 1; k <= 8; ++k) QTest::mouseMove(&row, row.placeOf(1) + QPoint(10, 0));
    QTest::mouseRelease(&row, Qt::LeftButton, {}, row.placeOf(1));
    QCOMPARE(document().undoStack().count(), steps + 1);
    QVERIFY(markers()[1].time > 22);
    document().undoStack().undo();
    QVERIFY(std::abs(markers()[1].time - 20) < 60.0 / row.width());
    QTest::mousePress(&row, Qt::LeftButton, {}, row.placeOf(1));
    QTest::mouseMove(&row, row.placeOf(1) + QPoint(40, 0));
    QTest::keyClick(&row, Qt::Key_Escape);
    QTest::mouseRelease(&row, Qt::LeftButton, {}, row.placeOf(1));
    QVERIFY(std::abs(markers()[1].time - 20) < 60.0 / row.width());
    // Named in its place.
    m_window->activateWindow();
    row.setFocus();
    QTest::keyClick(&row, Qt::Key_F2);
    auto* line = row.findChild<QLineEdit*>();
    QVERIFY(line);
    QTest::keyClicks(line, QStringLiteral("half gone"));
    QTest::keyClick(line, Qt::Key_Return);
    QCOMPARE(markers()[1].name, std::string("half gone"));
    QTRY_VERIFY_WITH_TIMEOUT(!row.findChild<QLineEdit*>(), kLong);
    for (const Plot* plot : m_window->graphs()->plots()) {
      const auto* over = qobject_cast<const TimePlot*>(plot);
      QVERIFY(!over || (over->markers().size() == 2 && over->markers()[1].second == QStringLiteral("half gone")));
    }
    QCOMPARE(document().putKey({Owner::Wall, "floor", "temperature"}, 30, 400), QString());
    QTRY_VERIFY_WITH_TIMEOUT(m_window->findChild<KeyRows*>()->isVisible(), kLong);
    auto* timeline = m_window->findChild<Timeline*>();
    const auto end = [&] { return timeline->mapTo(m_window.get(), QPoint(0, timeline->height())).y(); };
    QTRY_VERIFY_WITH_TIMEOUT(end() <= m_window->height() - 24, kLong);  // the status line is below it
    picture("tst_markers.png");
    m_window->action(QStringLiteral("view.light"))->trigger();
    picture("tst_markers_light.png");
    m_window->action(QStringLiteral("view.dark"))->trigger();
    QTest::mouseClick(&row, Qt::LeftButton, {}, row.placeOf(1));
    QTest::keyClick(&row, Qt::Key_Delete);
    QCOMPARE(markers().size(), size_t{1});
    QMenu menu;
    row.fillMenu(menu, 0);
    menu.actions().back()->trigger();
    QVERIFY(markers().empty());
    QTRY_VERIFY_WITH_TIMEOUT(!row.isVisible(), kLong);
    while (document().undoStack().canUndo()) document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), empty);
  }

  /// Others come and go, by hands and by undo: the chosen one is the same, or none where it went itself.
  void theChosenMarkerStaysTheSame() {
    MarkerRow& row = *m_window->findChild<MarkerRow*>();
    for (const double time : {10.0, 20.0, 30.0}) document().addMarker(time);
    QTRY_VERIFY_WITH_TIMEOUT(row.isVisible(), kLong);
    const auto chosen = [&] { return row.chosen() ? markers()[*row.chosen()].name : std::string(); };
    QTest::mouseClick(&row, Qt::LeftButton, {}, row.placeOf(1));
    QCOMPARE(chosen(), std::string("Marker 2"));
    QTest::keyClick(m_window.get(), Qt::Key_M, Qt::ShiftModifier);  // another one
    QCOMPARE(markers().size(), size_t{4});
    QCOMPARE(chosen(), std::string("Marker 2"));
    document().removeMarker(0);
    QCOMPARE(row.chosen(), std::optional<size_t>(0));
    QCOMPARE(chosen(), std::string("Marker 2"));
    document().undoStack().undo();
    QCOMPARE(chosen(), std::string("Marker 2"));
    document().editMarker(0, 20, QStringLiteral("Marker 2"));  // one that is alike
    document().editMarker(1, 25, {});
    QCOMPARE(row.chosen(), std::optional<size_t>(1));
    document().undoStack().undo();
    document().undoStack().undo();
    QCOMPARE(row.chosen(), std::optional<size_t>(1));
    row.setFocus();
    QTest::keyClick(&row, Qt::Key_Delete);
    QCOMPARE(markers()[1].name, std::string("Marker 3"));
    QVERIFY(!row.chosen());
  }

  /// Shift and arrows go to markers and keys alike; a click shows its time.
  void whatIsRecordedIsShownFromMarkToMark() {
    for (int frame = 1; frame <= 12; ++frame) {
      session().engine()->stepOnce();
      onEngine<bool>(session(), [](Engine&) { return true; });
      session().engine()->recording().settle();  // none is left out
    }
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), uint64_t{12}, kLong);
    document().addMarker(4.0 / 60);
    document().addMarker(100);  // beyond what is recorded
    QCOMPARE(document().putKey({Owner::Wall, "floor", "temperature"}, 8.0 / 60, 400), QString());
    const auto goes = [this](const char* id, uint64_t to) {
      m_window->action(QLatin1String(id))->trigger();
      QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), to, kLong);
    };
    goes("simulation.previousMark", 8);
    goes("simulation.previousMark", 4);
    goes("simulation.previousMark", 0);
    goes("simulation.nextMark", 4);
    goes("simulation.nextMark", 8);
    MarkerRow& row = *m_window->findChild<MarkerRow*>();
    QTest::mouseClick(&row, Qt::LeftButton, {}, row.placeOf(0));
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), uint64_t{4}, kLong);
    session().recorded().showNewest();
  }

 private:
  const std::vector<Marker>& markers() { return document().project().markers; }
  uint64_t shownFrame() { return session().snapshot()->stats.frame; }
};

QTEST_MAIN(TestMarkers)
#include "tst_markers.moc"
