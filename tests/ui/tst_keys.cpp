// SPDX-License-Identifier: Apache-2.0
// Keys over time as hands set them: in the document, in a row, and in the real window.
#include "core/io/projectio.h"
#include "core/scene/track.h"
#include "core/simulation/engine.h"
#include "tests/ui/samplewindow.h"
#include "ui/panels/inspector.h"
#include "ui/panels/outliner.h"
#include "ui/timeline/keyrows.h"
#include "ui/timeline/transport.h"

#include <QtCore/QTimer>
#include <QtGui/QContextMenuEvent>
#include <QtGui/QMouseEvent>
#include <QtTest/QSignalSpy>
#include <QtWidgets/QDockWidget>
#include <QtWidgets/QMenu>
#include <QtWidgets/QTreeView>

#include <algorithm>
#include <cmath>

using namespace ps;

namespace {

const Address kFloor{Owner::Wall, "floor", "temperature"};
const QString kFloorKey = QStringLiteral("wall/floor/temperature");

std::vector<double> timesOf(const Document& document, const Address& address) {
  std::vector<double> times;
  if (const Track* track = document.track(address)) {
    for (const TrackKey& key : track->keys) times.push_back(key.time);
  }
  return times;
}

}  // namespace

class TestKeys : public SampleWindowTest {
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
    std::vector<std::string> states{text()};
    const auto step = [&](const char* what, int index) {
      QVERIFY2(text() != states.back() && stack.index() == index, what);
      states.push_back(text());
    };
    QCOMPARE(document().putKey(kFloor, 2, 350), QString());
    step("first key", 1);
    QCOMPARE(document().putKey(kFloor, 0, 400), QString());
    step("a key before it", 2);
    QCOMPARE(document().putKey({Owner::Scene, "", "gravity"}, 1, 3), QString());
    step("another parameter", 3);
    document().beginGesture();
    for (int k = 1; k <= 5; ++k) QCOMPARE(document().moveKey(kFloor, 1, 2 + 0.1 * k, 350 + k), QString());
    document().endGesture();
    step("a drag", 4);
    QCOMPARE(document().setWay(kFloor, 0, ToNext::Smooth), QString());
    step("another way", 5);
    document().removeKey(kFloor, 0);
    step("a key less", 6);
    document().removeTrack(kFloor);
    step("no keys", 7);
    QVERIFY(!document().track(kFloor));
    for (size_t k = states.size(); k-- > 1;) {
      QCOMPARE(text(), states[k]);
      stack.undo();
    }
    QCOMPARE(text(), states[0]);
    for (size_t k = 1; k < states.size(); ++k) {
      stack.redo();
      QCOMPARE(text(), states[k]);
    }
  }

  void aDragThatEndsWhereItBeganIsNoStep() {
    QCOMPARE(document().putKey(kFloor, 1, 350), QString());
    document().beginGesture();
    QCOMPARE(document().moveKey(kFloor, 0, 2, 360), QString());
    QCOMPARE(document().moveKey(kFloor, 0, 1, 350), QString());
    document().endGesture();
    QCOMPARE(document().undoStack().count(), 1);
  }

  void keysStayBetweenTheirNeighboursAndInRange() {
    for (const double time : {0.0, 1.0, 2.0}) QCOMPARE(document().putKey(kFloor, time, 350), QString());
    QCOMPARE(document().moveKey(kFloor, 1, 7, 350), QString());
    QVERIFY(timesOf(document(), kFloor)[1] < 2);
    QCOMPARE(document().moveKey(kFloor, 1, -3, 350), QString());
    QVERIFY(timesOf(document(), kFloor)[1] > 0);
    QVERIFY(document().moveKey(kFloor, 1, 1, 1e9).contains(QStringLiteral("at 1 s must be at most 9\u202F727 °C")));
    std::vector<TrackKey> twice = document().track(kFloor)->keys;
    twice[1].time = twice[2].time;
    QVERIFY(document().setKeys({{kFloor, twice}}, {}).contains(QStringLiteral("same time as the key before it")));
    const QString cold = document().putKey(kFloor, 1.5, -5);
    QVERIFY2(cold.contains(QStringLiteral("must be at least −27")) && cold.contains(QStringLiteral(" °C, not −278")),
             qPrintable(cold));
    QVERIFY(document().putKey({Owner::Wall, "floor", "heat"}, 0, 1).contains(QStringLiteral("is a choice")));
    QVERIFY(document().putKey({Owner::Body, "ice", "velocity_x"}, 0, 1).contains(QStringLiteral("not held in place")));
    QVERIFY(document().putKey({Owner::Solver, "", "particle_spacing"}, 0, 0.02).contains(QStringLiteral("the start")));
    QCOMPARE(document().undoStack().count(), 5);
  }

  /// A body that goes takes its tracks out of the file, and brings them back.
  void tracksComeBackWithTheirOwner() {
    const Address power{Owner::Body, "ice", "heating_power"};
    QCOMPARE(document().putKey(power, 0, 100), QString());
    const std::string before = writeProject(document().project());
    QCOMPARE(document().removeBody("ice"), QString());
    QVERIFY(writeProject(document().project()).find("tracks") == std::string::npos);
    document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), before);
  }

  void theEngineGoesByWhatIsEdited() {
    const auto floor = [this] {
      return onEngine<double>(session(), [](Engine& engine) {
        return std::get<double>(engine.project().environment.walls[0].parameters.values.at("temperature"));
      });
    };
    const double own = std::get<double>(document().value(kFloor));
    QCOMPARE(document().putKey(kFloor, 0, 300), QString());
    QCOMPARE(floor(), 300.0);
    document().undoStack().undo();
    QCOMPARE(floor(), own);
    document().undoStack().redo();
    QCOMPARE(document().setParameter(kFloor, 555.0), QString());
    QCOMPARE(floor(), 300.0);
    document().removeTrack(kFloor);
    QCOMPARE(floor(), 555.0);
  }

  /// As somebody would: K over a row, some frames on another value, and the row goes between the two.
  void kOverARowSetsAndRemovesKeys() {
    ParameterRow& row = *shownRow();
    hover(row);
    QCOMPARE(row.model().keyMark, KeyMark::None);
    const double own = row.number();
    QTest::keyClick(m_window.get(), Qt::Key_K);
    QCOMPARE(timesOf(document(), kFloor), std::vector<double>{0});
    QCOMPARE(row.model().keyMark, KeyMark::OnKey);
    stepTo(30);
    QTRY_COMPARE_WITH_TIMEOUT(row.model().keyMark, KeyMark::Between, kLong);
    QCOMPARE(row.number(), own);
    QVERIFY(row.enterNumber(own - 60));  // a key takes it, since the next frame would hide it
    QCOMPARE(timesOf(document(), kFloor), (std::vector<double>{0, 0.5}));
    QCOMPARE(document().track(kFloor)->keys[1].value, own - 60);
    QCOMPARE(row.model().keyMark, KeyMark::OnKey);
    session().reset();
    QTRY_COMPARE_WITH_TIMEOUT(row.model().keyMark, KeyMark::OnKey, kLong);
    QTRY_COMPARE_WITH_TIMEOUT(row.number(), own, kLong);
    stepTo(15);
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(row.number() - (own - 30)) < 1e-9, kLong);
    QCOMPARE(row.model().keyMark, KeyMark::Between);
    QTRY_VERIFY_WITH_TIMEOUT(outlined(QStringLiteral("Hot plate")) == QStringLiteral("117 °C"), kLong);
    picture("tst_keys_between.png");
    stepTo(30);
    QTRY_COMPARE_WITH_TIMEOUT(row.model().keyMark, KeyMark::OnKey, kLong);
    picture("tst_keys_on.png");
    hover(row);
    QTest::keyClick(m_window.get(), Qt::Key_K);  // it is gone, and the one at the start holds
    QCOMPARE(timesOf(document(), kFloor), std::vector<double>{0});
    QCOMPARE(row.number(), own);
  }

  /// The clock of accelerated heat says by how much it is now.
  void theClocksFollow() {
    const Address scale{Owner::Solver, "", "thermal_time_scale"};
    QCOMPARE(document().putKey(scale, 0, 100), QString());
    QCOMPARE(m_window->transport()->thermalTexts().before, QStringLiteral("Heat ×100 = "));
    QCOMPARE(document().putKey(scale, 0.1, 700), QString());
    QCOMPARE(document().setWay(scale, 0, ToNext::Step), QString());
    stepTo(6);
    QTRY_COMPARE_WITH_TIMEOUT(m_window->transport()->thermalTexts().before, QStringLiteral("Heat ×700 = "), kLong);
  }

  /// A curve's row has no keys of its own, and shows what those of its points give.
  void aCurvesRowShowsTheKeysOfItsPoints() {
    const Address conductivity{Owner::Material, "water", "conductivity_solid"};
    Response curve;
    curve.kind = Response::Kind::Curve;
    curve.points = {{200, 3}, {263.15, 2.5}, {273.15, 2.2}};
    QCOMPARE(document().setParameter(conductivity, curve), QString());
    const std::string before = writeProject(document().project());
    QCOMPARE(document().putKey({Owner::Material, "water", "conductivity_solid[0]"}, 0.1, 4), QString());
    QCOMPARE(document().putKey({Owner::Material, "water", "conductivity_solid[2]"}, 0, 1), QString());
    QVERIFY(document().putKey(conductivity, 0, 1).contains(QStringLiteral("is a curve")));
    QVERIFY(m_window->revealParameter(conductivity, false));
    ParameterRow& row =
        *m_window->findChild<Inspector*>()->materialPanel()->row(QStringLiteral("material/water/conductivity_solid"));
    const auto point = [&](size_t k) { return std::get<Response>(row.model().value).points[k].y; };
    QCOMPARE(row.model().keyMark, KeyMark::OnKey);
    QCOMPARE(point(0), 3.0);
    QCOMPARE(point(2), 1.0);
    picture("tst_keys_curve.png");
    stepTo(8);
    QTRY_COMPARE_WITH_TIMEOUT(point(0), 4.0, kLong);
    QTRY_COMPARE_WITH_TIMEOUT(row.model().keyMark, KeyMark::Between, kLong);
    choose(row, {QStringLiteral("Remove all keys")});
    QCOMPARE(writeProject(document().project()), before);
    QCOMPARE(row.model().keyMark, KeyMark::None);
    QCOMPARE(point(0), 3.0);
  }

  void aClickOnTheDiamondIsTheSame() {
    ParameterRow& row = *shownRow();
    hover(row);
    QTest::mouseClick(&row, Qt::LeftButton, {}, row.keyRect().center());
    QCOMPARE(timesOf(document(), kFloor), std::vector<double>{0});
    QTest::mouseClick(&row, Qt::LeftButton, {}, row.keyRect().center());
    QVERIFY(!document().track(kFloor));
    QCOMPARE(document().undoStack().count(), 2);
  }

  void theMenuKnowsKeys() {
    ParameterRow& row = *shownRow();
    choose(row, {QStringLiteral("Set key")});
    QCOMPARE(timesOf(document(), kFloor), std::vector<double>{0});
    choose(row, {QStringLiteral("To the next key"), QStringLiteral("Smooth curve")});
    QVERIFY(document().track(kFloor)->keys[0].toNext == ToNext::Smooth);
    QVERIFY(row.model().way == ToNext::Smooth);
    hover(row);
    m_window->action(QStringLiteral("edit.row.hold"))->trigger();  // which Ctrl+K has
    QVERIFY(document().track(kFloor)->keys[0].toNext == ToNext::Step);
    choose(row, {QStringLiteral("Remove all keys")});
    QVERIFY(!document().track(kFloor));
    QCOMPARE(row.model().keyMark, KeyMark::None);
  }

  /// A row for each animated parameter; where there is none, the ruler stands alone, and takes no keys.
  void theTimelineHasARowOfKeysForEach() {
    QVERIFY(rows().isVisible());
    QCOMPARE(rows().height(), KeyRows::kRuler);
    QCOMPARE(rows().focusPolicy(), Qt::NoFocus);
    const auto* dock = m_window->findChild<QDockWidget*>(QStringLiteral("dock.transport"));
    const int without = dock->height();
    QCOMPARE(document().putKey(kFloor, 0, 400), QString());
    QCOMPARE(document().putKey(kFloor, 20, 300), QString());
    QTRY_COMPARE(rows().height(), KeyRows::kRuler + KeyRows::kRow);
    QCOMPARE(document().putKey({Owner::Scene, "", "gravity"}, 10, 3), QString());
    QTRY_COMPARE(rows().height(), KeyRows::kRuler + 2 * KeyRows::kRow);
    QTRY_VERIFY(rows().isVisible() && rows().visibleRegion().boundingRect() == rows().rect());
    picture("tst_keys_timeline.png");
    document().removeTrack(kFloor);
    document().removeTrack({Owner::Scene, "", "gravity"});
    QTRY_COMPARE(rows().height(), KeyRows::kRuler);
    QTRY_COMPARE(dock->height(), without);
  }

  void aKeyIsDraggedSetAndDeletedInItsRow() {
    QCOMPARE(document().putKey(kFloor, 0, 400), QString());
    QCOMPARE(document().putKey(kFloor, 20, 300), QString());
    QTRY_VERIFY(rows().isVisible());
    const int steps = document().undoStack().count();
    const QPoint from = rows().placeOf(kFloor, 1), to(static_cast<int>(rows().xOf(40)), from.y());
    QTest::mousePress(&rows(), Qt::LeftButton, {}, from);
    for (int k = 1; k <= 4; ++k) QTest::mouseMove(&rows(), from + (to - from) * k / 4);
    QTest::mouseRelease(&rows(), Qt::LeftButton, {}, to);
    QCOMPARE(document().undoStack().count(), steps + 1);
    const double moved = timesOf(document(), kFloor)[1];
    QVERIFY(std::abs(moved - 40) < 60.0 / (rows().width() - KeyRows::kLabel) + 1.0 / 60);  // a pixel, and the frame
    QVERIFY(std::abs(moved * 60 - std::round(moved * 60)) < 1e-3);
    QCOMPARE(document().track(kFloor)->keys[1].value, 300.0);
    QCOMPARE(rows().chosen(), (std::vector{KeyRows::Chosen{kFloor, 1}}));
    // Escape takes a drag back.
    const std::string before = writeProject(document().project());
    QTest::mousePress(&rows(), Qt::LeftButton, {}, rows().placeOf(kFloor, 1));
    QTest::mouseMove(&rows(), from + QPoint(-30, 0));
    QVERIFY(writeProject(document().project()) != before);
    QTest::keyClick(&rows(), Qt::Key_Escape);
    QTest::mouseRelease(&rows(), Qt::LeftButton, {}, from);
    QCOMPARE(writeProject(document().project()), before);
    QCOMPARE(document().undoStack().count(), steps + 1);
    // With Ctrl it leaves a copy, as one step.
    const QPoint copyTo(static_cast<int>(rows().xOf(50)), from.y());
    for (const bool keep : {false, true}) {
      dragCopy(1, copyTo);
      QCOMPARE(timesOf(document(), kFloor).size(), size_t{3});
      if (!keep) QTest::keyClick(&rows(), Qt::Key_Escape);
      QTest::mouseRelease(&rows(), Qt::LeftButton, Qt::ControlModifier, copyTo);
      QCOMPARE(writeProject(document().project()) == before, !keep);
    }
    QCOMPARE(document().undoStack().count(), steps + 2);
    QCOMPARE(document().track(kFloor)->keys[2].value, 300.0);
    document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), before);
    // A double-click between the two sets one on their line.
    const QPoint middle(static_cast<int>(rows().xOf(moved / 2)), from.y());
    QTest::mouseDClick(&rows(), Qt::LeftButton, {}, middle);
    QCOMPARE(timesOf(document(), kFloor).size(), size_t{3});
    const TrackKey key = document().track(kFloor)->keys[1];
    QVERIFY(std::abs(key.value - (400 - 100 * key.time / moved)) < 1e-6);
    QCOMPARE(rows().chosen(), (std::vector{KeyRows::Chosen{kFloor, 1}}));
    rows().setFocus();
    QTest::keyClick(&rows(), Qt::Key_Delete);
    QCOMPARE(timesOf(document(), kFloor), (std::vector<double>{0, moved}));
    QVERIFY(document().body("ice"));  // what is selected in the scene stays
    while (document().undoStack().count() > 0 && document().undoStack().canUndo()) document().undoStack().undo();
    QVERIFY(document().project().tracks.empty());
  }

  /// The way to the next key goes along.
  void aCopyIsTheKeyItself() {
    QCOMPARE(document().putKey(kFloor, 0, 400), QString());
    QCOMPARE(document().putKey(kFloor, 20, 300), QString());
    QCOMPARE(document().setWay(kFloor, 1, ToNext::Step), QString());
    QCOMPARE(document().setWay(kFloor, 0, ToNext::Smooth), QString());
    QTRY_VERIFY(rows().isVisible());
    const std::string before = writeProject(document().project());
    const QPoint to(static_cast<int>(rows().xOf(50)), rows().placeOf(kFloor, 1).y());
    dragCopy(1, to);
    QTest::mouseRelease(&rows(), Qt::LeftButton, Qt::ControlModifier, to);
    QCOMPARE(timesOf(document(), kFloor).size(), size_t{3});
    QCOMPARE(document().track(kFloor)->keys[2].value, 300.0);
    QVERIFY(document().track(kFloor)->keys[2].toNext == ToNext::Step);
    document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), before);
  }

  void whatCannotHaveKeysSaysSo() {
    ParameterRow& row = *m_window->findChild<Inspector*>()->scenePanel()->row(QStringLiteral("wall/floor/heat"));
    QVERIFY(m_window->revealParameter({Owner::Wall, "floor", "heat"}));
    hover(row);
    QTest::keyClick(m_window.get(), Qt::Key_K);
    QVERIFY(document().project().tracks.empty());
    QTRY_VERIFY(m_window->notice()->isVisible());
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("is a choice")),
             qPrintable(m_window->notice()->text()));
  }

 private:
  KeyRows& rows() { return *m_window->findChild<KeyRows*>(); }
  /// What stands beside a name in the outliner.
  QString outlined(const QString& name) {
    const QAbstractItemModel* model = m_window->outliner()->findChild<QTreeView*>()->model();
    const QModelIndexList found = model->match(model->index(0, 0), Qt::DisplayRole, name, 1, Qt::MatchRecursive);
    return found.isEmpty() ? QString() : found[0].data(outline::kDetail).toString();
  }
  ParameterRow* shownRow() {
    if (!m_window->revealParameter(kFloor, false)) return nullptr;
    return m_window->findChild<Inspector*>()->scenePanel()->row(kFloorKey);
  }
  void hover(ParameterRow& row) {
    for (const int x : {20, 24}) QTest::mouseMove(&row, QPoint(x, 12));
    QTRY_VERIFY(row.isHovered());
  }
  void stepTo(uint64_t frame) {
    while (session().snapshot()->stats.frame < frame) {
      const uint64_t before = session().snapshot()->stats.frame;
      session().step();
      QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->stats.frame > before, kLong);
    }
  }
  void choose(ParameterRow& row, const QStringList& way) {
    QTimer::singleShot(0, &row, [&] {
      auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
      QVERIFY(menu);
      const QMenu* in = menu;
      for (const QString& text : way) {
        const QList<QAction*> actions = in->actions();
        const auto found = std::find_if(actions.begin(), actions.end(), [&](QAction* a) { return a->text() == text; });
        QVERIFY2(found != actions.end(), qPrintable(text));
        if ((*found)->menu())
          in = (*found)->menu();
        else
          (*found)->trigger();
      }
      menu->close();
    });
    QContextMenuEvent ask(QContextMenuEvent::Keyboard, QPoint(20, 10), row.mapToGlobal(QPoint(20, 10)));
    QApplication::sendEvent(&row, &ask);
  }
  /// With Ctrl; the button stays down.
  void dragCopy(size_t key, const QPoint& to) {
    const QPoint at = rows().placeOf(kFloor, key);
    QTest::mousePress(&rows(), Qt::LeftButton, Qt::ControlModifier, at);
    for (int k = 1; k <= 4; ++k) {
      QMouseEvent move(QEvent::MouseMove, at + (to - at) * k / 4, rows().mapToGlobal(to), Qt::NoButton, Qt::LeftButton,
                       Qt::ControlModifier);
      QApplication::sendEvent(&rows(), &move);
    }
  }
};

QTEST_MAIN(TestKeys)
#include "tst_keys.moc"
