// SPDX-License-Identifier: Apache-2.0
// Pages of the window on the board in the headset, worked on by beam and by fingertip: they do what a mouse does there.
#include "tests/ui/curvewindow.h"
#include "tests/ui/recordhands.h"
#include "tests/vr/panelhands.h"
#include "ui/curves/responselist.h"
#include "ui/graphs/graphspanel.h"
#include "ui/graphs/graphview.h"
#include "ui/panels/outliner.h"
#include "ui/panels/wayout.h"
#include "ui/rows/parameterpanel.h"
#include "ui/session/selection.h"
#include "ui/theme/theme.h"
#include "ui/timeline/keyrows.h"
#include "ui/timeline/markerrow.h"
#include "ui/timeline/timeline.h"
#include "ui/tools/toolbox.h"
#include "ui/window/vrwithout.h"

#include <QtGui/QWheelEvent>
#include <QtWidgets/QLabel>
#include <QtWidgets/QListWidget>
#include <QtWidgets/QScrollArea>

#include <algorithm>
#include <cmath>

using namespace ps;

namespace {

constexpr uint64_t kFrames = 12, kFrom = 2, kTo = 8;
constexpr size_t kOnRight = vr::kBoard + 1, kOnLeft = vr::kBoard + 2;  // panels beside the board
constexpr double kDuration = 0.4;  // s: a frame is then some fifteen pixels of the board wide

}  // namespace

class VrPagesTest : public PanelsTest {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() {
    session().recorded().showNewest();
    backToTheStart();
  }
  void cleanup() { leaveAtLast(); }
  void cleanupTestCase() { m_window.reset(); }

  void theTimelineIsScrubbed_data();
  void theTimelineIsScrubbed();
  void theTimelinesTargetsAreLargeEnough();
  void marksOfRowsAreLargeEnough();
  void aValueIsDragged_data() { byBeamAndTip(); }
  void aValueIsDragged();
  void aPointOfACurveIsMoved_data() { byBeamAndTip(); }
  void aPointOfACurveIsMoved();
  void aGraphIsZoomed_data();
  void aGraphIsZoomed();
  void onePageLeadsToAnother();
  void pagesAreSetBeside();
  void panelsAreWorkedOnAtOnce();
  void whatIsPressedOfAPageThatGoesBeside();
  void whatIsPressedOfAPageThatGoes();
  void aPanelIsCarriedAndPutAway();
  void rowsReachTheWearer();

 private:
  static void byBeamAndTip() {
    QTest::addColumn<bool>("byTip");
    QTest::newRow("by a beam") << false;
    QTest::newRow("by a fingertip") << true;
  }
  void setBeside(const QString& page) {
    panels().showPage(page);
    painted();
    QToolButton* beside = button(vr::kBoard, "Set this page beside");
    QVERIFY(beside);
    click(vr::kBoard, *beside);
  }
  uint64_t shownFrame() { return session().snapshot()->stats.frame; }
  Transport* transport() {
    QWidget* board = panels().widget(vr::kBoard);
    auto* one = board ? board->findChild<Transport*>() : nullptr;
    if (one) one->setDuration(kDuration);
    return one;
  }
  /// Whether the board says something that begins so.
  bool noted(const QString& text) {
    const auto labels = panels().widget(vr::kBoard)->findChildren<QLabel*>();
    return std::any_of(labels.begin(), labels.end(),
                       [&](const QLabel* label) { return label->isVisible() && label->text().startsWith(text); });
  }
};

void VrPagesTest::theTimelineIsScrubbed_data() {
  QTest::addColumn<bool>("byTip");
  QTest::newRow("by a beam") << false;
  QTest::newRow("by a fingertip") << true;
}

/// From the second frame to the eighth, end to end: what is shown then is what a drag of the mouse in the dock shows.
void VrPagesTest::theTimelineIsScrubbed() {
  QFETCH(bool, byTip);
  for (uint64_t frame = 1; frame <= kFrames; ++frame) hands::stepKept(session());
  QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), kFrames, kLong);
  m_window->transport()->setDuration(kDuration);
  hands::scrubTo(*m_window->transport(), kTo);
  QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), kTo, kLong);
  session().recorded().showNewest();
  QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), kFrames, kLong);

  ScriptedRun run(vrScript());
  enter();
  panels().showPage(QStringLiteral("Transport"));
  QTest::qWait(100);
  QVERIFY(transport());
  const Transport& bar = *transport();
  const QPointF from = bar.placeOf(double(kFrom) / 60), to = bar.placeOf(double(kTo) / 60);
  run.goOn(vrScript(QStringLiteral(R"(, "pictures": [70, 100])"),
                    boardKey(0, bar, from, byTip, false) + boardKey(20, bar, from, byTip, false) +
                        boardKey(30, bar, from, byTip, true) + boardKey(60, bar, to, byTip, true) +
                        boardKey(80, bar, to, byTip, true) + boardKey(90, bar, to, byTip, false)));
  QTRY_COMPARE_WITH_TIMEOUT(run.lines("picture").size(), size_t{4}, 2 * kLong);  // it is let go by then
  leave();
  QVERIFY(run.lines("violation").empty());
  QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), kTo, kLong);
  QVERIFY(session().recorded().isActive());
  QCOMPARE(session().newest()->stats.frame, kFrames);
  QVERIFY(document().undoStack().index() == 0);  // nothing was drawn or edited
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  const auto names = run.texts("picture");
  for (size_t eye = 0; !folder.isEmpty() && eye < 2; ++eye)
    QImage(QString::fromStdString(names[eye])).save(folder + QStringLiteral("/vr-timeline-%1.png").arg(eye));
  session().recorded().showNewest();
}

/// Of 2.5 degrees, 0.75 m away: buttons and the bar.
void VrPagesTest::theTimelinesTargetsAreLargeEnough() {
  enterWithout();
  panels().showPage(QStringLiteral("Transport"));
  const vr::HeadsetView view = painted();
  const QWidget* board = panels().widget(vr::kBoard);
  const double pixel = view.panels[vr::kBoard].width / board->width();
  const auto large = [&](double pixels) { return std::atan(pixels * pixel / 0.75) / kDegree > 2.5; };
  QVERIFY(transport());
  for (const auto* one : transport()->findChildren<QAbstractButton*>()) {
    if (!one->isVisible()) continue;
    QVERIFY2(one->isEnabled(), qPrintable(one->accessibleName()));
    QVERIFY2(large(one->height()) && large(one->width()), qPrintable(one->accessibleName()));
    const QRect there(one->mapTo(board, QPoint(0, 0)), one->size());
    QVERIFY2(board->rect().contains(there), qPrintable(one->accessibleName()));
  }
  // Both transports say how fast it runs.
  session().setSpeed(2);
  for (Transport* one : {transport(), m_window->transport()})
    QCOMPARE(one->speedButton()->text(), QStringLiteral("2×"));
  click(vr::kBoard, *transport()->loopButton());
  QVERIFY(m_window->transport()->loopButton()->isChecked() && session().recorded().loops());
  click(vr::kBoard, *transport()->loopButton());
  QVERIFY(!m_window->transport()->loopButton()->isChecked());
  session().setSpeed(1);
  // A press at the bar's upper end scrubs as one in its middle does.
  hands::stepKept(session());
  QTRY_COMPARE_WITH_TIMEOUT(session().newest()->stats.frame, uint64_t{1}, kLong);
  int reach = 0;
  for (int up = 1; up <= 40; ++up) {
    session().recorded().showNewest();
    const QPointF there(transport()->placeOf(0).x() + 1, transport()->height() - up);
    for (const bool pressed : {false, true, false}) at(vr::kBoard, *transport(), there, pressed);
    if (session().recorded().isActive() || QTest::qWaitFor([&] { return session().recorded().isActive(); }, 200))
      reach = up;
  }
  QVERIFY2(large(reach), qPrintable(QString::number(reach)));
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  if (!folder.isEmpty()) {
    panels().widget(vr::kBoard)->grab().save(folder + "/vr-board-timeline.png");
    panels().widget(vr::kPalette)->grab().save(folder + "/vr-palette-pages.png");
  }
  session().recorded().showNewest();
}

/// The diamond is smaller than what is taken as it: 26 pixels, which are 2.6 degrees. So are rows of keys and markers.
void VrPagesTest::marksOfRowsAreLargeEnough() {
  const Address floor{Owner::Wall, "floor", "temperature"};
  enterWithout();
  panels().showPage(QStringLiteral("Material"));
  QTest::qWait(100);
  ParameterRow* row = rowOf(QStringLiteral("wall/floor/temperature"));
  QVERIFY(row);
  const QRect end(row->width() - 26, 0, 26, row->height());
  QVERIFY(end.contains(row->keyRect()) && end.left() > row->fieldRect().right());
  for (const QPoint corner : {end.topLeft(), end.topRight(), end.bottomLeft(), end.bottomRight()}) {
    for (const bool pressed : {false, true, false}) at(vr::kBoard, *row, corner, pressed);
    QTRY_COMPARE(document().project().tracks.size(), size_t{1});
    document().undoStack().undo();
    QVERIFY(document().project().tracks.empty());
  }
  QCOMPARE(document().putKey(floor, 5, 400), QString());
  document().addMarker(3);
  panels().showPage(QStringLiteral("Transport"));
  QTest::qWait(100);
  const QWidget* board = panels().widget(vr::kBoard);
  auto* keys = board->findChild<KeyRows*>();
  const auto* markers = board->findChild<MarkerRow*>();
  QVERIFY(keys && markers && markers->isVisible());
  QVERIFY(keys->rowHeight() >= 26 && keys->ruler() >= 26 && markers->height() >= 26);
  // Of the key 12 pixels beside its middle takes hold, which a mouse does not.
  const QPoint beside = keys->placeOf(floor, 0) + QPoint(12, 0);
  QTest::mouseClick(keys, Qt::LeftButton, {}, beside);
  QVERIFY(keys->chosen().empty());
  for (const bool pressed : {false, true, false}) at(vr::kBoard, *keys, beside, pressed);
  QTRY_COMPARE(keys->chosen().size(), size_t{1});
  document().undoStack().undo();
  document().undoStack().undo();
}

/// A slider of the document, by the hand that the headset has: as one step of undo, to where the mouse drags it.
void VrPagesTest::aValueIsDragged() {
  QFETCH(bool, byTip);
  const std::string body = document().project().bodies.front().id;
  const Address address{Owner::Body, body, "temperature"};
  const auto kelvin = [&] { return responseOf(document().value(address)).at(293.15); };
  m_window->selection().selectBody(body);
  ScriptedRun run(vrScript());
  enter();
  panels().showPage(QStringLiteral("Body"));
  QTest::qWait(100);
  ParameterRow* row = rowOf(QStringLiteral("body/%1/temperature").arg(QString::fromStdString(body)));
  QVERIFY(row);
  for (QWidget* parent = row->parentWidget(); parent; parent = parent->parentWidget())
    if (auto* area = qobject_cast<QScrollArea*>(parent)) area->ensureWidgetVisible(row);
  QTest::qWait(50);
  const QRect track = row->sliderRect();
  const QPoint from(track.left() + track.width() / 4, track.center().y()), way(track.width() / 2, 0);
  const int steps = document().undoStack().index();
  const double before = kelvin();
  hands::pull(*row, from, way);
  const double wanted = kelvin();
  QCOMPARE(document().undoStack().index(), steps + 1);
  document().undoStack().undo();
  QVERIFY(kelvin() == before && std::abs(wanted - before) > 10);
  run.goOn(vrScript({}, boardKey(0, *row, from, byTip, false) + boardKey(20, *row, from, byTip, false) +
                            boardKey(30, *row, from, byTip, true) + boardKey(60, *row, from + way, byTip, true) +
                            boardKey(70, *row, from + way, byTip, true) +
                            boardKey(80, *row, from + way, byTip, false)));
  QTRY_COMPARE_WITH_TIMEOUT(document().undoStack().index(), steps + 1, 2 * kLong);
  QTRY_VERIFY_WITH_TIMEOUT(std::abs(kelvin() - wanted) < 0.05 * std::abs(wanted - before), kLong);  // some pixels
  leave();  // while the trigger is pulled, perhaps: the gesture ends all the same
  QCOMPARE(document().undoStack().index(), steps + 1);
  QVERIFY(document().setParameter(address, before).isEmpty());
  QCOMPARE(document().undoStack().index(), steps + 2);
  QVERIFY(run.lines("violation").empty());
  document().undoStack().undo();
  document().undoStack().undo();
}

/// By the hand that the headset has, as one step of undo, to where the same way of the mouse moves it.
void VrPagesTest::aPointOfACurveIsMoved() {
  QFETCH(bool, byTip);
  CurveTarget& curves = m_window->curves();
  curves.choose(kViscosity);
  QVERIFY(curves.set(curveThrough({{280, 0.0015}, {310, 0.001}, {350, 0.0005}}), QStringLiteral("Points")));
  ScriptedRun run(vrScript());
  enter();
  panels().showPage(QStringLiteral("Curve"));
  QTest::qWait(100);
  auto* page = panels().widget(vr::kBoard)->findChild<CurvePanel*>();
  QVERIFY(page && page->isVisible());
  CurveView& view = *page->view();
  view.fit();
  const auto placeOf = [&](size_t k) {
    const CurvePoint point = curves.response().points[k];
    return view.at(point.x, point.y);
  };
  curves.choosePoint(1);  // its numbers take a row below
  QTest::qWait(50);
  // Hands take hold of it within 13 pixels, which are 1.25 degrees.
  const QPointF from = placeOf(1), way(20, -30), held = from + QPointF(-9, 8);
  const int steps = document().undoStack().index();
  hands::pull(view, from.toPoint(), way.toPoint());
  const CurvePoint wanted = curves.response().points[1];
  QCOMPARE(document().undoStack().index(), steps + 1);
  document().undoStack().undo();
  curves.choosePoint(1);
  QTest::qWait(50);
  QCOMPARE(placeOf(1), from);
  run.goOn(vrScript(QStringLiteral(R"(, "pictures": [50])"),
                    boardKey(0, view, held, byTip, false) + boardKey(20, view, held, byTip, false) +
                        boardKey(30, view, held, byTip, true) + boardKey(60, view, held + way, byTip, true) +
                        boardKey(70, view, held + way, byTip, true) + boardKey(80, view, held + way, byTip, false)));
  QTRY_COMPARE_WITH_TIMEOUT(document().undoStack().index(), steps + 1, 2 * kLong);
  QTRY_COMPARE_WITH_TIMEOUT(run.lines("picture").size(), size_t{2}, kLong);
  const uint64_t after = vr().frames() + 20;
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > after, kLong);  // the gesture is over
  const CurvePoint moved = curves.response().points[1];
  const QPointF is = view.at(moved.x, moved.y), meant = view.at(wanted.x, wanted.y);
  leave();
  QCOMPARE(document().undoStack().index(), steps + 1);
  QVERIFY(moved.x > 310 && moved.y > 0.001);
  // Rows and columns of pixels are where both stop.
  QVERIFY2(std::abs(is.x() - meant.x()) <= 1 && std::abs(is.y() - meant.y()) <= 1,
           qPrintable(QStringLiteral("%1 %2").arg(is.x() - meant.x()).arg(is.y() - meant.y())));
  QVERIFY(run.lines("violation").empty());
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  const auto names = run.texts("picture");
  for (size_t eye = 0; !folder.isEmpty() && eye < names.size(); ++eye)
    QImage(QString::fromStdString(names[eye])).save(folder + QStringLiteral("/vr-curve-%1.png").arg(eye));
}

void VrPagesTest::aGraphIsZoomed_data() {
  QTest::addColumn<bool>("byTip");
  QTest::newRow("by a beam") << false;
  QTest::newRow("by a fingertip") << true;
}

/// By the hand that the headset has: stick, drag and double press show what wheel, drag and double click show.
void VrPagesTest::aGraphIsZoomed() {
  QFETCH(bool, byTip);
  for (uint64_t frame = 1; frame <= kFrames; ++frame) hands::stepKept(session());
  QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), kFrames, kLong);
  ScriptedRun run(vrScript());
  enter();
  panels().showPage(QStringLiteral("Graphs"));
  QTest::qWait(100);
  auto* graph = panels().widget(vr::kBoard)->findChild<GraphView*>();
  QVERIFY(graph && graph->isVisible() && graph->isFitted());
  const auto ends = [&] { return std::vector{graph->range().first, graph->range().second}; };
  const auto areNear = [&](const std::vector<double>& a, const std::vector<double>& b) {
    const double pixel = (b[1] - b[0]) / graph->plotRect().width();
    return std::abs(a[0] - b[0]) < 2 * pixel && std::abs(a[1] - b[1]) < 2 * pixel;
  };
  const QRectF plot = graph->plotRect();
  const QPoint from(static_cast<int>(plot.left() + 0.7 * plot.width()), static_cast<int>(plot.center().y())),
      way(-30, 0);
  const std::vector<double> whole = ends();
  QWheelEvent wheel(from, graph->mapToGlobal(from), {}, {0, 120}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase,
                    false);
  QApplication::sendEvent(graph, &wheel);
  const std::vector<double> zoomed = ends();
  hands::pull(*graph, from, way);
  const std::vector<double> panned = ends();
  QTest::mouseDClick(graph, Qt::LeftButton, {}, from);
  QVERIFY(graph->isFitted() && zoomed[1] - zoomed[0] < 0.9 * (whole[1] - whole[0]) && !areNear(panned, zoomed));

  const auto there = [&](int frame, const QPointF& place, bool presses, double stick = 0) {
    return boardKey(frame, *graph, place, byTip, presses, QStringLiteral(R"(, "/input/thumbstick/y": %1)").arg(stick));
  };
  // A push of three frames is one notch.
  run.goOn(vrScript({}, there(0, from, false) + there(20, from, false, 1) + there(23, from, false)));
  QTRY_VERIFY_WITH_TIMEOUT(areNear(ends(), zoomed), kLong);
  run.goOn(vrScript({}, there(0, from, false) + there(10, from, false) + there(20, from, true) +
                            there(50, from + way, true) + there(60, from + way, true) + there(70, from + way, false)));
  QTRY_VERIFY_WITH_TIMEOUT(areNear(ends(), panned), kLong);
  const uint64_t after = vr().frames() + 80;
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > after, kLong);
  QVERIFY(areNear(ends(), panned));
  run.goOn(vrScript({}, there(0, from + way, false) + there(20, from + way, false, -1) + there(23, from + way, false)));
  QTRY_VERIFY_WITH_TIMEOUT(ends()[1] - ends()[0] > 1.1 * (panned[1] - panned[0]), kLong);
  const QPointF other = plot.center();
  run.goOn(vrScript({}, there(0, other, false) + there(19, other, false) + there(21, other, true) +
                            there(24, other, false) + there(27, other, true) + there(30, other, false)));
  QTRY_VERIFY_WITH_TIMEOUT(graph->isFitted(), kLong);
  leave();
  QVERIFY(run.lines("violation").empty());
  QCOMPARE(document().undoStack().index(), 0);  // as with the mouse, no step
}

/// What opens on the board comes in the place of what it shows.
void VrPagesTest::onePageLeadsToAnother() {
  enterWithout();
  CurveTarget& curves = m_window->curves();
  curves.choose(kConductivity);
  m_window->selection().setMaterial("water");
  panels().showPage(QStringLiteral("Material"));
  QTest::qWait(100);
  const auto curve = [&] { return panels().widget(vr::kBoard)->findChild<CurvePanel*>(); };
  QVERIFY(!curve());
  ParameterRow* row = rowOf(QString::fromStdString(kViscosity.text()));
  QVERIFY(row);
  for (QWidget* up = row->parentWidget(); up; up = up->parentWidget())
    if (auto* scroll = qobject_cast<QScrollArea*>(up)) scroll->ensureWidgetVisible(row);
  QTest::qWait(50);
  const QPointF mark(row->fieldRect().right() + 13, row->rect().center().y());
  for (const bool pressed : {false, true, false}) at(vr::kBoard, *row, mark, pressed);
  QVERIFY(curve() && curve()->isVisible());
  QCOMPARE(curves.address().text(), kViscosity.text());
  // Another one of the list.
  panels().showPage(QStringLiteral("Responses"));
  QTest::qWait(100);
  auto* list = panels().widget(vr::kBoard)->findChild<ResponseList*>()->list();
  QVERIFY(list->isVisible() && !curve()->isVisible() && list->count() > 2);
  const int other = list->currentRow() == 0 ? 1 : 0;
  list->scrollToItem(list->item(other));
  const QPointF place = list->visualItemRect(list->item(other)).center();
  for (const bool pressed : {false, true, false}) at(vr::kBoard, *list->viewport(), place, pressed);
  QTRY_VERIFY(curve()->isVisible());
  QVERIFY(curves.address().text() != kViscosity.text());
  panels().showPage(QStringLiteral("Outliner"));
  QTest::qWait(100);
  QVERIFY(panels().widget(vr::kBoard)->findChild<Outliner*>()->isVisible());
  // What is refused is said where its wearer looks, too.
  const QString said = QStringLiteral("Nothing was drawn. There is no room.");
  m_window->tools().refuse(QStringLiteral("Nothing was drawn."), QStringLiteral("There is no room."));
  QVERIFY(noted(said));
  m_window->tools().refuse(QStringLiteral("Nothing was drawn."), {});
  QVERIFY(!noted(said));
  // It goes of itself as well.
  m_window->tools().refuse(QStringLiteral("Nothing was drawn."), QStringLiteral("There is no room."));
  QVERIFY(noted(said));
  QTRY_VERIFY_WITH_TIMEOUT(!noted(said), kLong);
}

/// On panels of their own: two at most, and put away they are the board's again.
void VrPagesTest::pagesAreSetBeside() {
  enterWithout();
  setBeside(QStringLiteral("Graphs"));
  QVERIFY(!panels().widget(vr::kBoard) && panels().widget(kOnRight) && !panels().widget(kOnLeft));
  setBeside(QStringLiteral("Transport"));
  QVERIFY(!panels().widget(vr::kBoard) && panels().widget(kOnLeft));
  const auto* graphs = panels().widget(kOnRight)->findChild<GraphsPanel*>();
  const auto* bar = panels().widget(kOnLeft)->findChild<Transport*>();
  QVERIFY(graphs && graphs->isVisible() && bar && bar->isVisible());
  setBeside(QStringLiteral("Scene"));
  QVERIFY(panels().widget(vr::kBoard) && noted(QStringLiteral("The page stays here. ")));
  panels().showPage(QStringLiteral("Scene"));
  QVERIFY(!noted(QStringLiteral("The page stays here. ")));
  // A page that has a panel comes there, also from out of sight.
  vr::HandsSeen seen;
  seen.boardAhead[1] = false;
  vr::HeadsetView before, after;
  panels().act(seen);
  panels().describe(before);
  panels().showPage(QStringLiteral("Graphs"));
  panels().describe(after);
  QVERIFY(panels().widget(vr::kBoard)->findChild<ParameterPanel*>() && graphs->window() == panels().widget(kOnRight));
  QCOMPARE(after.brought[0], before.brought[0]);
  QCOMPARE(after.brought[1], before.brought[1] + 1);
  QToolButton* away = button(kOnRight, "Put this panel away");
  QVERIFY(away);
  click(kOnRight, *away);
  QVERIFY(!panels().widget(kOnRight) && panels().widget(kOnLeft));
  QVERIFY(panels().widget(vr::kBoard) && !graphs->isVisible());  // it goes on with what it shows
  panels().showPage(QStringLiteral("Graphs"));
  QVERIFY(graphs->isVisible() && graphs->window() == panels().widget(vr::kBoard));
}

void VrPagesTest::panelsAreWorkedOnAtOnce() {
  for (int frame = 0; frame < 3; ++frame) hands::stepKept(session());
  QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), uint64_t{3}, kLong);
  const std::string body = document().project().bodies.front().id;
  m_window->selection().selectBody(body);
  enterWithout();
  setBeside(QStringLiteral("Graphs"));
  setBeside(QStringLiteral("Transport"));
  panels().showPage(QStringLiteral("Body"));
  painted();
  auto* graph = panels().widget(kOnRight)->findChild<GraphView*>();
  auto* bar = panels().widget(kOnLeft)->findChild<Transport*>();
  ParameterRow* row = rowOf(QStringLiteral("body/%1/temperature").arg(QString::fromStdString(body)));
  QVERIFY(graph && bar && row);
  const auto range = [&] { return graph->range().second - graph->range().first; };
  const double whole = range();
  at(kOnRight, *graph, graph->plotRect().center(), false, 1);
  QTRY_VERIFY(range() < 0.95 * whole);
  const int steps = document().undoStack().index();
  const QRectF track = row->sliderRect();
  for (const double share : {0.2, 0.4, 0.6})
    at(vr::kBoard, *row, {track.left() + share * track.width(), track.center().y()}, true);
  at(vr::kBoard, *row, {track.left() + 0.6 * track.width(), track.center().y()}, false);
  QCOMPARE(document().undoStack().index(), steps + 1);
  document().undoStack().undo();
  bar->setDuration(kDuration);
  for (const bool pressed : {false, true, false}) at(kOnLeft, *bar, bar->placeOf(1.0 / 60), pressed);
  QTRY_VERIFY_WITH_TIMEOUT(session().recorded().isActive(), kLong);
  session().recorded().showNewest();
}

/// It is let go, and not clicked.
void VrPagesTest::whatIsPressedOfAPageThatGoesBeside() {
  enterWithout();
  panels().showPage(QStringLiteral("Transport"));
  painted();
  const QToolButton* beside = button(vr::kBoard, "Set this page beside");
  QVERIFY(transport() && beside);
  const QAbstractButton& loop = *transport()->loopButton();
  const QPointF held = middleOf(vr::kBoard, loop), on = middleOf(vr::kBoard, *beside);
  for (const bool pressed : {false, true, false}) {
    vr::HandsSeen seen;
    seen.seconds = m_seconds += 1;
    seen.hands[vr::kLeft].panel = vr::PanelPoint{vr::kBoard, held.x(), held.y(), 1, false, true};
    seen.hands[vr::kRight].panel = vr::PanelPoint{vr::kBoard, on.x(), on.y(), 1, false, pressed};
    panels().act(seen);
    if (pressed) QVERIFY(loop.isDown());
  }
  QVERIFY(panels().widget(kOnRight) && !loop.isDown() && !session().recorded().loops());
}

/// Likewise where another page comes in its place, of which the hand presses nothing; nor does its beam stick to what
/// is not seen any more.
void VrPagesTest::whatIsPressedOfAPageThatGoes() {
  enterWithout();
  panels().showPage(QStringLiteral("Transport"));
  painted();
  QVERIFY(transport());
  const QAbstractButton& loop = *transport()->loopButton();
  const auto points = [&](bool pressed) { at(vr::kBoard, loop, QRectF(loop.rect()).center(), pressed); };
  const int steps = document().undoStack().index();
  for (const bool pressed : {false, true}) points(pressed);
  QVERIFY(loop.isDown());
  panels().showPage(QStringLiteral("Body"));
  QVERIFY(!loop.isDown());
  for (const bool pressed : {true, true, false}) points(pressed);
  QVERIFY(!session().recorded().loops());
  QCOMPARE(document().undoStack().index(), steps);
  for (const char* page : {"Brush", "Body", "Material", "Scene", "Outliner", "Graphs", "Responses", "Curve"}) {
    panels().showPage(QStringLiteral("Transport"));
    points(false);
    QVERIFY(loop.underMouse());
    panels().showPage(QString::fromLatin1(page));
    points(false);
    QVERIFY2(!loop.underMouse(), page);
  }
}

/// By the hand that the headset has: its grip takes a panel by the header, and it is pressed where that was put.
void VrPagesTest::aPanelIsCarriedAndPutAway() {
  ScriptedRun run(vrScript({}, kHandsAway));
  enter();
  setBeside(QStringLiteral("Scene"));
  QVERIFY(panels().widget(kOnRight));
  const vr::HeadsetView view = painted();
  vr::Panels geometry;
  geometry.follow(frameOf({}, {}), view);
  QVERIFY(geometry.place(kOnRight));
  const Vector3 from(0.3, 1.15, 0.1), header = geometry.place(kOnRight)->at(0.3, 0.04);
  const vr::HandPose takes = pointing(from, header), puts = pointing(from, header + Vector3(0.2, 0.3, 0.1));
  for (const auto& [pose, held] :
       {std::pair(takes, 0.0), std::pair(takes, 1.0), std::pair(puts, 1.0), std::pair(puts, 0.0)}) {
    vr::HeadsetFrame frame = frameOf({}, pose);
    frame.hands[vr::kRight].hold = held;
    geometry.follow(frame, view);
  }
  const QToolButton* away = button(kOnRight, "Put this panel away");
  QVERIFY(away);
  const QPointF middle = middleOf(kOnRight, *away);
  const vr::HandPose presses = pointing(from, geometry.place(kOnRight)->at(middle.x(), middle.y()));
  run.goOn(vrScript(QStringLiteral(R"(, "pictures": [15, 64])"),
                    key(0, "right", takes) + key(20, "right", takes) + key(25, "right", takes, kHolds) +
                        key(55, "right", puts, kHolds) + key(65, "right", puts, kHolds) +
                        key(70, "right", puts, kHoldsNothing) + key(90, "right", presses, trigger(0)) +
                        key(110, "right", presses, trigger(0)) + key(115, "right", presses, trigger(1)) +
                        key(125, "right", presses, trigger(0))));
  QTRY_VERIFY_WITH_TIMEOUT(!panels().widget(kOnRight), kLong);
  QTRY_COMPARE_WITH_TIMEOUT(run.lines("picture").size(), size_t{4}, kLong);
  leave();
  QVERIFY(run.lines("violation").empty());
  QCOMPARE(document().undoStack().index(), 0);  // nothing was drawn, nor led
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  const auto names = run.texts("picture");
  for (size_t eye = 0; !folder.isEmpty() && eye < names.size(); ++eye)
    QImage(QString::fromStdString(names[eye])).save(folder + QStringLiteral("/vr-beside-%1.png").arg(eye));
}

/// What rows of the board cannot do by themselves: the board and the window say what is refused, a way out is followed,
/// and keys come as a curve.
void VrPagesTest::rowsReachTheWearer() {
  const Address floor{Owner::Wall, "floor", "temperature"};
  const Project before = document().project();
  for (const double time : {5.0, 10.0}) QCOMPARE(document().putKey(floor, time, 300 + time), QString());
  Project project = document().project();
  project.tracks[0].keys[0].value = 2e4;  // the wall takes 10000 K: such a key cannot be moved
  document().open(project, kSample, false, false);
  enterWithout();
  QSignalSpy refused(&vr(), &VrMode::refused);
  const std::string body = document().project().bodies.front().id;
  m_window->selection().selectBody(body);
  panels().showPage(QStringLiteral("Body"));
  QTest::qWait(100);
  ParameterRow* row = rowOf(QStringLiteral("body/%1/temperature").arg(QString::fromStdString(body)));
  QVERIFY(row);
  row->toggleKey();  // it acts at the start
  QVERIFY(noted(QStringLiteral("No key was set. ")));
  QCOMPARE(refused.count(), 1);
  auto* panel = panels().widget(vr::kBoard)->findChild<ParameterPanel*>();
  Q_EMIT panel->linkActivated({}, wayout::action("simulation.play"));
  QTRY_VERIFY(session().playing());
  session().pause();

  panels().showPage(QStringLiteral("Transport"));
  QTest::qWait(100);
  const KeyRows& keys = *panels().widget(vr::kBoard)->findChild<KeyRows*>();
  const QPointF key = keys.placeOf(floor, 0), name(30, key.y());
  at(vr::kBoard, keys, key, false);
  at(vr::kBoard, keys, key, true);
  for (const bool pressed : {true, false}) at(vr::kBoard, keys, key + QPointF(10, 0), pressed);
  QVERIFY(noted(QStringLiteral("The keys stay as they are. ")));
  QCOMPARE(refused.count(), 2);
  for (const bool pressed : {false, true, false, true, false}) at(vr::kBoard, keys, name, pressed);
  auto* curve = panels().widget(vr::kBoard)->findChild<CurvePanel*>();
  QVERIFY(curve && curve->isVisible());
  QCOMPARE(m_window->curves().track(), std::optional(floor));
  document().open(before, kSample, false, false);
}

QTEST_MAIN(VrPagesTest)
#include "tst_vrpages.moc"
