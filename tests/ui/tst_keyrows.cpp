// SPDX-License-Identifier: Apache-2.0
// Keys over time as hands change several, and as a curve: in their rows, and in the workspace Tune.
#include "core/io/projectio.h"
#include "core/scene/track.h"
#include "tests/ui/curvewindow.h"
#include "ui/curves/responselist.h"
#include "ui/timeline/keyrows.h"
#include "ui/window/noticebar.h"
#include "ui/window/statusline.h"

#include <QtGui/QContextMenuEvent>
#include <QtTest/QSignalSpy>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QListWidget>
#include <QtWidgets/QMenu>

#include <cmath>

using namespace ps;

namespace {

const Address kFloor{Owner::Wall, "floor", "temperature"}, kGravity{Owner::Scene, "", "gravity"};

}  // namespace

class TestKeyRows : public CurveWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { openTune(); }
  void init() {
    backToTheStart();
    m_window->showWorkspace(MainWindow::kSceneTab);
    for (const double time : {5.0, 10.0, 20.0}) QCOMPARE(document().putKey(kFloor, time, 300 + time), QString());
    QCOMPARE(document().putKey(kGravity, 10, 3), QString());
    QTRY_VERIFY(rows().isVisible() && rows().width() > 400);
    m_steps = document().undoStack().count();
  }

  /// Where all is shorter than a second a tenth would be far from the pointer. Within half a hundredth, half a frame of
  /// a sixtieth, and a pixel.
  void aDoubleClickInAShortSceneIsFiner() {
    while (document().undoStack().canUndo()) document().undoStack().undo();
    ProjectAbout about = document().about();
    about.duration = 0.5;
    document().setAbout(about, QStringLiteral("duration"));
    QCOMPARE(document().putKey(kFloor, 0, 300), QString());
    QTRY_VERIFY(rows().xOf(0.5) > rows().width() / 2);  // the first of all: nothing that was recorded is longer
    QTest::mouseDClick(&rows(), Qt::LeftButton, {},
                       {static_cast<int>(rows().xOf(0.25)), rows().placeOf(kFloor, 0).y()});
    QCOMPARE(keys(kFloor).size(), size_t{2});
    QVERIFY2(std::abs(keys(kFloor)[1].time - 0.25) < 0.02, qPrintable(QString::number(keys(kFloor)[1].time)));
  }

  /// A box around three of four keys in two rows; they go as one, and with Delete.
  void keysInABoxGoTogether() {
    const std::string before = text();
    box(rows().placeOf(kFloor, 1) - QPoint(12, 8), rows().placeOf(kGravity, 0) + QPoint(250, 8));
    QCOMPARE(rows().chosen().size(), size_t{3});
    hands::pull(rows(), rows().placeOf(kFloor, 1), {30, 0});
    QCOMPARE(document().undoStack().count(), m_steps + 1);
    const double shift = keys(kFloor)[1].time - 10;
    QVERIFY(shift > 0.5);
    QCOMPARE(keys(kFloor)[0].time, 5.0);
    QVERIFY(std::abs(keys(kFloor)[2].time - 20 - shift) < 1e-5 && std::abs(keys(kGravity)[0].time - 10 - shift) < 1e-5);
    QCOMPARE(keys(kFloor)[1].value, 310.0);
    hands::pull(rows(), rows().placeOf(kFloor, 1),
                {-2000, 0});  // no farther than the key that stays, all of them alike
    QVERIFY(keys(kFloor)[1].time > 5 && keys(kFloor)[1].time < 5.1);
    QVERIFY(std::abs(keys(kFloor)[2].time - keys(kFloor)[1].time - 10) < 1e-5);
    document().undoStack().undo();
    document().undoStack().undo();
    QCOMPARE(text(), before);
    rows().setFocus();
    QTest::keyClick(&rows(), Qt::Key_Delete);
    QCOMPARE(document().undoStack().count(), m_steps + 1);
    QCOMPARE(keys(kFloor).size(), size_t{1});
    QVERIFY(!document().track(kGravity));
    document().undoStack().undo();
    QCOMPARE(text(), before);
  }

  /// A copy that is held over another key, or was on its way, leaves that one be where Escape takes it back.
  void escapeBringsBackWhatACopyCovered() {
    const std::string before = text();
    const QPoint from = rows().placeOf(kFloor, 0), over = rows().placeOf(kFloor, 1), on = rows().placeOf(kFloor, 2);
    QTest::mousePress(&rows(), Qt::LeftButton, Qt::ControlModifier, from);
    for (const QPoint& to : {over, on}) {
      QMouseEvent move(QEvent::MouseMove, QPointF(to), rows().mapToGlobal(to), Qt::NoButton, Qt::LeftButton,
                       Qt::ControlModifier);
      QApplication::sendEvent(&rows(), &move);
      QCOMPARE(keys(kFloor).size(), size_t{3});
      QCOMPARE(keys(kFloor)[to == on ? 2 : 1].value, 305.0);  // instead of the one there
    }
    QCOMPARE(keys(kFloor)[1].value, 310.0);  // it only passed there
    QTest::keyClick(&rows(), Qt::Key_Escape);
    QTest::mouseRelease(&rows(), Qt::LeftButton, Qt::ControlModifier, on);
    QCOMPARE(text(), before);
    QCOMPARE(document().undoStack().count(), m_steps);
  }

  void aDragEndsWhereTheRowsAreHidden() {
    const QPoint from = rows().placeOf(kFloor, 2);
    QTest::mousePress(&rows(), Qt::LeftButton, {}, from);
    QTest::mouseMove(&rows(), from + QPoint(30, 0));
    QCOMPARE(document().undoStack().count(), m_steps + 1);
    rows().hide();
    for (const double kelvin : {400.0, 410.0}) QCOMPARE(document().setParameter(kFloor, kelvin), QString());
    QCOMPARE(document().undoStack().count(), m_steps + 3);  // two steps of their own
    rows().show();
    QTest::mouseRelease(&rows(), Qt::LeftButton, {}, from);
    QCOMPARE(document().undoStack().count(), m_steps + 3);
  }

  /// Keys get other numbers by undo: a chosen one stays the one of its time, or is none.
  void deleteAfterUndoTakesTheChosenKey() {
    QCOMPARE(document().putKey(kFloor, 1, 500), QString());
    QTest::mouseClick(&rows(), Qt::LeftButton, {}, rows().placeOf(kFloor, 2));  // at 10 s
    document().undoStack().undo();                                              // the one at 1 s
    QCOMPARE(rows().chosen(), (std::vector{KeyRows::Chosen{kFloor, 1}}));
    rows().setFocus();
    QTest::keyClick(&rows(), Qt::Key_Delete);
    QCOMPARE(keys(kFloor).size(), size_t{2});
    QCOMPARE(keys(kFloor)[1].time, 20.0);
    document().undoStack().undo();
    QVERIFY(rows().chosen().empty());
  }

  /// A double-click on the name opens the keys as a curve, where they are points over time.
  void keysAreEditedAsACurve() {
    QTest::mouseDClick(&rows(), Qt::LeftButton, {}, {30, rows().placeOf(kFloor, 0).y()});
    QCOMPARE(m_window->workspaceTab(), MainWindow::kTuneTab);
    QCOMPARE(curves().track(), std::optional(kFloor));
    QTRY_VERIFY(curve().width() > 300);
    curve().fit();
    QCOMPARE(response().points.size(), size_t{3});
    QVERIFY(curve().kelvinAt(curve().plot().left()) <= 5 && curve().kelvinAt(curve().plot().right()) >= 20);
    std::vector<std::string> states{text()};
    const auto step = [&](const char* what) {
      QVERIFY2(text() != states.back(), what);
      states.push_back(text());
      QCOMPARE(document().undoStack().count(), m_steps + static_cast<int>(states.size()) - 1);
    };
    drag(1, {20, -30});
    step("dragged");
    const TrackKey moved = keys(kFloor)[1];
    QVERIFY(moved.time > 10 && moved.value > 310 && moved.toNext == ToNext::Linear);
    QVERIFY(std::abs(moved.time * 60 - std::round(moved.time * 60)) < 1e-3);  // on a frame
    Response smooth = response();
    for (size_t piece = 0; piece < 2; ++piece) setBetween(smooth, piece, Between::Monotone);
    QVERIFY(curves().set(smooth, QStringLiteral("Way")));
    step("smooth");
    curves().choosePoint(1);
    QVERIFY(curve().handleAt(true).has_value());
    pull(curve().handleAt(true)->toPoint(), {0, 25}, {});
    step("a slope");
    QVERIFY(keys(kFloor)[1].slopeAfter && keys(kFloor)[1].slopeBefore);
    const double time = 0.5 * (keys(kFloor)[1].time + keys(kFloor)[2].time);
    QTest::mouseDClick(&curve(), Qt::LeftButton, {}, curve().at(time, response().at(time)).toPoint());
    step("added");
    QCOMPARE(keys(kFloor).size(), size_t{4});
    QTest::keyClick(&curve(), Qt::Key_Delete);
    step("deleted");
    shoot("track-curve");
    for (size_t k = states.size(); k-- > 1;) {
      QCOMPARE(text(), states[k]);
      document().undoStack().undo();
    }
    QCOMPARE(text(), states[0]);
    QCOMPARE(curves().track(), std::optional(kFloor));
    document().removeTrack(kFloor);  // then a property is shown again
    QVERIFY(!curves().track());
    QCOMPARE(response().kind, Response::Kind::Law);
    document().undoStack().undo();
    auto* list = m_window->findChild<ResponseList*>()->tracks();
    QCOMPARE(list->count(), 2);
    list->setCurrentRow(1);
    QCOMPARE(curves().track(), std::optional(kGravity));
    Response steep = response();
    QVERIFY(curves().set(curveThrough({{1, 0}, {2, 0}}), QStringLiteral("Keys")));
    steep = response();
    stateSlope(steep, 0, -1e6, Sides::After);
    QSignalSpy refused(&curves(), &CurveTarget::refused);
    QVERIFY(!curves().set(steep, QStringLiteral("Slope")));
    QVERIFY(refused.last()[0].toString().contains(QStringLiteral("where the slopes of its keys lead")));
  }

  /// Keys are of a point, not of its number: a point before it gives it another one, and takes no keys along but its
  /// own.
  void tracksFollowTheirPoints() {
    curves().choose(kConductivity);
    QVERIFY(curves().set(curveThrough({{280, 0.5}, {310, 0.6}, {350, 0.7}}), QStringLiteral("Points")));
    const Address second{Owner::Material, "water", "conductivity_liquid[1]"},
        third{Owner::Material, "water", "conductivity_liquid[2]"},
        fourth{Owner::Material, "water", "conductivity_liquid[3]"};
    QCOMPARE(document().putKey(second, 1, 0.65), QString());
    QCOMPARE(document().putKey(third, 1, 0.75), QString());
    const std::string before = text();
    const int steps = document().undoStack().count();
    Response more = response();
    QVERIFY(addPoint(more, {295, 0.55}));
    QVERIFY(curves().set(more, QStringLiteral("Add")));
    QCOMPARE(document().undoStack().count(), steps + 1);
    QVERIFY(!document().track(second));
    QCOMPARE(keys(third)[0].value, 0.65);
    QCOMPARE(keys(fourth)[0].value, 0.75);
    const std::string with = text();
    Response fewer = response();
    removePoint(fewer, 2);  // the one of 310 K, with its keys
    QVERIFY(curves().set(fewer, QStringLiteral("Remove")));
    QCOMPARE(keys(third)[0].value, 0.75);
    QVERIFY(!document().track(fourth));
    document().undoStack().undo();
    QCOMPARE(text(), with);
    document().undoStack().undo();
    QCOMPARE(text(), before);
  }

  /// What a file or an older range left is no reason to refuse other edits; and what is refused is said.
  void keysThatCannotBeDoNotBlockOthers() {
    Project project = document().project();
    project.tracks[0].keys[1].value = 2e4;  // the wall takes 10000 K
    document().open(project, kSample);
    QTRY_VERIFY(rows().isVisible());
    hands::pull(rows(), rows().placeOf(kFloor, 2), {10, 0});
    QVERIFY(keys(kFloor)[2].time > 20);
    const QString problem = document().setKeys({{kFloor, {{1, 3e4}}}}, {});
    QVERIFY2(problem.contains(QStringLiteral("Temperature at 1 s must be at most")), qPrintable(problem));
    QSignalSpy refused(&rows(), &KeyRows::refused);
    hands::pull(rows(), rows().placeOf(kFloor, 1), {10, 0});  // the one that cannot be
    QCOMPARE(refused.count(), 1);
    QTRY_VERIFY(m_window->notice()->isVisible());
    QTest::mouseClick(&rows(), Qt::LeftButton, {}, rows().placeOf(kFloor, 1));
    rows().setFocus();
    QTest::keyClick(&rows(), Qt::Key_Delete);
    QCOMPARE(keys(kFloor).size(), size_t{2});
  }

  /// A double-click means a tenth of a second, with Ctrl a frame.
  void aDoubleClickSetsAKeyAtATenth() {
    const int y = rows().placeOf(kFloor, 0).y();
    const auto added = [&](double seconds, Qt::KeyboardModifiers modifiers) {
      QTest::mouseDClick(&rows(), Qt::LeftButton, modifiers, {static_cast<int>(rows().xOf(seconds)), y});
      return rows().chosen().size() == 1 ? keys(kFloor)[rows().chosen()[0].key].time : -1;
    };
    const auto isWhole = [](double steps) { return std::abs(steps - std::round(steps)) < 1e-4; };
    const double tenth = added(15, {}), frame = added(30, Qt::ControlModifier);
    QVERIFY(std::abs(tenth - 15) < 0.5 && isWhole(10 * tenth));
    QVERIFY(std::abs(frame - 30) < 0.5 && isWhole(60 * frame));
    QCOMPARE(keys(kFloor).size(), size_t{5});
  }

  /// By the menu of a key, also past another one.
  void aKeyIsTyped() {
    m_window->activateWindow();
    const std::string before = text();
    const auto enter = [this](const QString& time, const QString& value) {
      choose(QStringLiteral("Set time and value…"), rows().placeOf(kFloor, 0));
      const auto field = [this](const char* name) {
        for (QLineEdit* line : rows().findChildren<QLineEdit*>()) {
          if (line->isVisible() && line->accessibleName() == QLatin1String(name)) return line;
        }
        return static_cast<QLineEdit*>(nullptr);
      };
      QVERIFY(field("Time of the key") && field("Value of the key"));
      QCOMPARE(field("Time of the key")->text(), QStringLiteral("5 s"));
      field("Time of the key")->setText(time);
      field("Value of the key")->setText(value);
      QTest::keyClick(field("Value of the key"), Qt::Key_Return);
    };
    enter(QStringLiteral("12.5 s"), QStringLiteral("400 K"));
    QCOMPARE(document().undoStack().count(), m_steps + 1);
    QCOMPARE(keys(kFloor).size(), size_t{3});
    QCOMPARE(keys(kFloor)[1].time, 12.5);
    QVERIFY(std::abs(keys(kFloor)[1].value - 400) < 1e-9);
    document().undoStack().undo();
    QCOMPARE(text(), before);
    QSignalSpy refused(&rows(), &KeyRows::refused);
    enter(QStringLiteral("soon"), QStringLiteral("400 K"));
    QCOMPARE(refused.count(), 1);
    QCOMPARE(text(), before);
  }

  /// Its texts are shorter than its numbers: one that nobody changes leaves them as they are.
  void aKeyThatIsTypedKeepsWhatIsNotTyped() {
    m_window->activateWindow();
    const double time = 12.3456789, value = 333.123456789;
    const std::vector<TrackKey> one{TrackKey{time, value}};
    QCOMPARE(document().setKeys({{kFloor, one}}, QStringLiteral("keys")), QString());
    const std::string before = text();
    const int steps = document().undoStack().count();
    const auto enter = [this](const char* name, const QString& typed) {
      choose(QStringLiteral("Set time and value…"), rows().placeOf(kFloor, 0));
      for (QLineEdit* line : rows().findChildren<QLineEdit*>()) {
        if (!line->isVisible() || line->accessibleName() != QLatin1String(name)) continue;
        if (!typed.isEmpty()) line->setText(typed);
        QTest::keyClick(line, Qt::Key_Return);
        return;
      }
      QFAIL(name);
    };
    enter("Time of the key", {});
    QCOMPARE(document().undoStack().count(), steps);
    QCOMPARE(text(), before);
    enter("Time of the key", QStringLiteral("15 s"));
    QCOMPARE(keys(kFloor)[0].time, 15.0);
    QCOMPARE(keys(kFloor)[0].value, value);
    document().undoStack().undo();
    QCOMPARE(text(), before);
    enter("Value of the key", QStringLiteral("350 K"));
    QCOMPARE(keys(kFloor)[0].time, time);
    QVERIFY(std::abs(keys(kFloor)[0].value - 350) < 1e-9);
  }

  /// Ahead of what is recorded the ruler says what a click does, and its menu has a marker for it.
  void theRulerAheadOfTheRunIsNoDeadEnd() {
    const QPoint ahead(static_cast<int>(rows().xOf(30)), rows().ruler() / 2);
    QSignalSpy hint(&rows(), &KeyRows::hint);
    QTest::mouseClick(&rows(), Qt::LeftButton, {}, ahead);
    QCOMPARE(hint.count(), 1);
    const QString parts = m_window->statusLine()->parts().join(QLatin1Char('\n'));
    QVERIFY2(parts.contains(QStringLiteral("has only run up to")), qPrintable(parts));
    QTest::mouseClick(&rows(), Qt::LeftButton, {}, {static_cast<int>(rows().xOf(0)), ahead.y()});
    QCOMPARE(hint.count(), 1);
    choose(QStringLiteral("Add marker here"), ahead);
    QCOMPARE(document().project().markers.size(), size_t{1});
    const double time = document().project().markers[0].time;
    QVERIFY(std::abs(time - 30) < 0.5 && std::abs(10 * time - std::round(10 * time)) < 1e-4);
  }

 private:
  /// In the menu that a right click opens.
  void choose(const QString& text, const QPoint& at) {
    QContextMenuEvent asked(QContextMenuEvent::Mouse, at, rows().mapToGlobal(at));
    QApplication::sendEvent(&rows(), &asked);
    auto* menu = rows().findChild<QMenu*>();
    QVERIFY(menu);
    QAction* action = nullptr;
    for (QAction* each : menu->actions()) {
      if (each->text() == text) action = each;
    }
    QVERIFY2(action, qPrintable(text));
    menu->close();
    action->trigger();
    delete menu;
  }
  KeyRows& rows() { return *m_window->findChild<KeyRows*>(); }
  std::string text() { return writeProject(document().project()); }
  const std::vector<TrackKey>& keys(const Address& address) { return document().track(address)->keys; }
  void box(const QPoint& from, const QPoint& to) {
    QTest::mousePress(&rows(), Qt::LeftButton, {}, from);
    QTest::mouseMove(&rows(), (from + to) / 2);
    QTest::mouseMove(&rows(), to);
    QTest::mouseRelease(&rows(), Qt::LeftButton, {}, to);
  }
  int m_steps = 0;
};

QTEST_MAIN(TestKeyRows)
#include "tst_keyrows.moc"
