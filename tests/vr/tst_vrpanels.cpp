// SPDX-License-Identifier: Apache-2.0
// The interface in the headset: palette and board, pointed at by beam and by tip, painted and seen.
#include "tests/ui/curvewindow.h"
#include "tests/ui/hands.h"
#include "tests/vr/panelhands.h"
#include "ui/document/presets.h"
#include "ui/graphs/graphspanel.h"
#include "ui/graphs/graphview.h"
#include "ui/panels/materialspanel.h"
#include "ui/panels/outliner.h"
#include "ui/panels/outlinerdelegate.h"
#include "ui/rows/groupheading.h"
#include "ui/rows/parameterrow.h"
#include "ui/session/preferences.h"
#include "ui/theme/theme.h"
#include "ui/vr/handlabels.h"
#include "ui/vr/panels.h"
#include "ui/window/vrlabels.h"
#include "ui/window/vrpanels.h"
#include "ui/window/vrwithout.h"

#include <QtCore/QTimer>
#include <QtGui/QFontInfo>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QAbstractItemView>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QScrollBar>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QTreeView>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

using namespace ps;

class VrPanelsTest : public PanelsTest {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() { backToTheStart(); }
  void cleanup() {
    leaveAtLast();
    preferences::setOneHanded(false);
  }
  void cleanupTestCase() { m_window.reset(); }

  void thePaletteShowsWithThePalm();
  void thePaletteOfALeftHandedWearer();
  void aLoneHandPinsThePalette();
  void aMenuPinsThePalette();
  void theBoardStandsBeforeTheWearer();
  void theBoardComesFromOutOfSight();
  void panelsStandSideBySide();
  void aGripCarriesABoardByItsHeader();
  void aTipCarriesABoardByItsHeader();
  void aBeamAtAnEdgeKeepsWhatItLeft();
  void aBeamThatTremblesKeepsItsRow();
  void beamsPressAndKeepWhatTheyPress();
  void tipsPressWhatTheyGoThrough();
  void aBeamIsSeenToWhatItPointsAt();
  void aTriggerPulledElsewhereDraws();
  void theNearerPanelIsMeant();
  void letteringAndTargetsAreLargeEnough();
  void whatVanishesUnderAPressIsNotClicked();
  void aBeamPlaysTheRun();
  void aSimpleControllerTurnsByThePalette();
  void aSliderOfTheBoardIsDragged();
  void pagesAreTheWindowsOwn();
  void namesLeadToTheirPages();
  void menusComeAlong();
  void menusGoWithTheirBoard();
  void aStickOpensMenus();
  void aLoneHandWithItsGripScrolls();
  void gravityIsTakenAndGivenBack();
  void labelsSayWhatControllersDo_data();
  void labelsSayWhatControllersDo();
  void labelsFollowTheMainHand();
  void labelsHangBesideTheHand();
  void labelsGoAndComeBack();
  void scalesAreTold_data();
  void scalesAreTold();
  void aSceneThatIsCarriedTellsItsScale();
  void aMousePressesThePalette();
  void aKeyPinsThePalette();

 private:
  /// What hangs beside the hands, as the headset is told of it.
  auto labelsNow() {
    panels().paint();
    vr::HeadsetView view;
    panels().describe(view);
    return view.labels;
  }
};

namespace {

/// Panels as large as they may be, so that nobody paints.
vr::HeadsetView emptyView() {
  vr::HeadsetView view;
  view.panels[vr::kPalette] = {std::make_shared<PanelImage>(), 0.30, 0.27, 0, 0, 0};
  view.panels[vr::kBoard] = {std::make_shared<PanelImage>(), 0.50, 0.40, 0, 0, 0};
  return view;
}

}  // namespace

void VrPanelsTest::thePaletteShowsWithThePalm() {
  vr::Panels panels;
  const vr::HeadsetView view = emptyView();
  panels.follow(frameOf(palm(), {}), view);
  const auto& place = panels.place(vr::kPalette);
  QVERIFY(place);
  // Its lower edge is 0.12 m over the hand, and it leans back by 35 degrees, towards the eyes.
  QVERIFY(std::abs((place->at(0, 1).y() + place->at(1, 1).y()) / 2 - palm().position.y() - 0.12) < 1e-6);
  const Vector3 front = place->pose.orientation * Vector3::UnitZ();
  QVERIFY(std::abs(std::asin(front.y()) / kDegree - 35) < 1e-6);
  QVERIFY(front.dot((scriptHead().position - place->pose.position).normalized()) > 0.8);
  vr::HandPose away = palm();
  away.orientation = away.orientation * Quaternion(Eigen::AngleAxisd(std::numbers::pi, Vector3::UnitY()));
  panels.follow(frameOf(away, {}), view);
  QVERIFY(!panels.place(vr::kPalette));
  panels.follow(frameOf({}, palm()), view);  // the left hand is asleep
  QVERIFY(!panels.place(vr::kPalette));
}

namespace {

/// A right hand where the left one is, or the other way round, whose palm faces the same way.
vr::HandPose mirrored(vr::HandPose hand) {
  hand.orientation = hand.orientation * Quaternion(Eigen::AngleAxisd(std::numbers::pi, Vector3::UnitY()));
  return hand;
}

}  // namespace

void VrPanelsTest::thePaletteOfALeftHandedWearer() {
  vr::Panels panels;
  vr::HeadsetView view = emptyView();
  view.panels[vr::kBoard].image = nullptr;
  view.roles.main = vr::kLeft;
  panels.follow(frameOf(palm(), {}), view);
  QVERIFY(!panels.place(vr::kPalette));  // the main hand's palm
  panels.follow(frameOf({}, palm()), view);
  QVERIFY(!panels.place(vr::kPalette));  // the back of the hand
  panels.follow(frameOf({}, mirrored(palm())), view);
  const auto place = panels.place(vr::kPalette);
  QVERIFY(place && place->pose.position.y() > palm().position.y() + 0.12);
  // The main hand points at it, its own does not.
  const Vector3 front = place->pose.orientation * Vector3::UnitZ();
  panels.follow(frameOf(pointing(place->pose.position + 0.3 * front, place->pose.position), mirrored(palm())), view);
  QVERIFY(panels.pointed(vr::kLeft) && panels.pointed(vr::kLeft)->panel == vr::kPalette);
  QVERIFY(!panels.pointed(vr::kRight));
}

/// It turns its palm to the wearer, and away again to point at what came there; the next time it puts it away.
void VrPanelsTest::aLoneHandPinsThePalette() {
  vr::Panels panels;
  vr::HeadsetView view = emptyView();
  view.panels[vr::kBoard].image = nullptr;
  view.roles.alone = true;
  panels.follow(frameOf(palm(), {}), view);
  QVERIFY(!panels.place(vr::kPalette));  // the other hand is not used
  const vr::HandPose shows = mirrored(palm());
  panels.follow(frameOf({}, shows), view);
  const auto place = panels.place(vr::kPalette);
  QVERIFY(place && std::abs(place->pose.position.y() - shows.position.y()) < 0.1);
  QVERIFY(place->pose.position.z() < shows.position.z() - 0.1);  // beyond it
  // As large to the eye as one that hangs over a hand, half a metre away.
  const double away = (place->pose.position - scriptHead().position).norm();
  QVERIFY(away > 0.5 && place->width / away > 0.30 / 0.5 - 1e-9 && place->height / away > 0.27 / 0.5 - 1e-9);
  // From where the hand is it can be pointed at and pressed.
  for (const double pulled : {0.0, 1.0, 0.0}) {
    panels.follow(frameOf({}, pointing(shows.position, place->at(0.6, 0.6)), pulled), view);
    const auto point = panels.pointed(vr::kRight);
    QVERIFY(point && point->panel == vr::kPalette && point->pressed == (pulled > 0));
    QVERIFY(std::abs(point->x - 0.6) < 1e-6 && std::abs(point->y - 0.6) < 1e-6);
    QCOMPARE(panels.place(vr::kPalette)->pose.position, place->pose.position);
  }
  panels.follow(frameOf({}, shows), view);
  QVERIFY(!panels.place(vr::kPalette));
  panels.follow(frameOf({}, shows), view);
  QVERIFY(!panels.place(vr::kPalette));  // still the same turn of the hand
  panels.follow(frameOf({}, palm()), view);
  panels.follow(frameOf({}, shows), view);
  QVERIFY(panels.place(vr::kPalette));
  view.roles.alone = false;  // both hands again
  panels.follow(frameOf({}, shows), view);
  QVERIFY(!panels.place(vr::kPalette));
}

/// Of either hand, and either may point at it then.
void VrPanelsTest::aMenuPinsThePalette() {
  const vr::HeadsetView view = emptyView();
  const vr::HandPose level{{-0.1, 1.2, -0.3}, Quaternion::Identity()};
  for (const size_t hand : {vr::kLeft, vr::kRight}) {
    vr::Panels panels;
    vr::HeadsetFrame frame = frameOf(level, level);
    panels.follow(frame, view);
    QVERIFY(!panels.place(vr::kPalette));
    frame.hands[hand].menu = true;
    panels.follow(frame, view);
    panels.follow(frame, view);  // still pressed
    const auto place = panels.place(vr::kPalette);
    QVERIFY(place);
    frame.hands[hand].menu = false;
    frame.hands[vr::kLeft].aim = frame.hands[vr::kRight].aim = pointing(level.position, place->at(0.5, 0.5));
    panels.follow(frame, view);
    for (const size_t points : {vr::kLeft, vr::kRight})
      QVERIFY(panels.pointed(points) && panels.pointed(points)->panel == vr::kPalette);
    frame.hands[hand].menu = true;
    panels.follow(frame, view);
    QVERIFY(!panels.place(vr::kPalette));
  }
}

void VrPanelsTest::theBoardStandsBeforeTheWearer() {
  vr::Panels panels;
  vr::HeadsetView view = emptyView();
  panels.follow(frameOf({}, {}), view);
  const Vector3 stands = panels.place(vr::kBoard)->pose.position, way = stands - scriptHead().position;
  QVERIFY(std::abs(way.norm() - 0.75) < 1e-9);
  QVERIFY(std::abs(std::asin(-way.y() / way.norm()) / kDegree - 15) < 1e-6);
  QVERIFY(std::abs(way.x()) < 1e-9 && way.z() < 0);
  // It is not fixed to the head; it comes when it is brought.
  vr::HeadsetFrame turned = frameOf({}, {});
  turned.head.orientation = Quaternion(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3::UnitY()));
  panels.follow(turned, view);
  QCOMPARE(panels.place(vr::kBoard)->pose.position, stands);
  QVERIFY(panels.isBoardAhead(scriptHead()) && !panels.isBoardAhead(turned.head));
  ++view.brought[0];
  panels.follow(turned, view);
  QVERIFY(panels.place(vr::kBoard)->pose.position.x() < scriptHead().position.x() - 0.7);
  QVERIFY(panels.isBoardAhead(turned.head));
}

/// By its button or another page; where it is before the wearer the button puts it away, and another page leaves it.
void VrPanelsTest::theBoardComesFromOutOfSight() {
  enterWithout();
  panels().showPage(QStringLiteral("Brush"));
  const auto brought = [&](bool ahead, const std::function<void()>& asks) {
    vr::HandsSeen seen;
    seen.boardAhead[0] = ahead;
    vr::HeadsetView before, after;
    panels().describe(before);
    panels().act(seen);
    asks();
    panels().describe(after);
    return after.brought[0] - before.brought[0];
  };
  QCOMPARE(brought(false, [&] { panels().toggleBoard(); }), uint64_t{1});
  QVERIFY(panels().widget(vr::kBoard));
  QCOMPARE(brought(false, [&] { panels().showPage(QStringLiteral("Scene")); }), uint64_t{1});
  QCOMPARE(brought(true, [&] { panels().showPage(QStringLiteral("Brush")); }), uint64_t{0});
  QCOMPARE(brought(true, [&] { panels().toggleBoard(); }), uint64_t{0});
  QVERIFY(!panels().widget(vr::kBoard));
}

/// As far from the eyes, turned to them, and none before another.
void VrPanelsTest::panelsStandSideBySide() {
  vr::Panels panels;
  vr::HeadsetView view = emptyView();
  for (size_t board = 1; board < vr::kBoards; ++board) view.panels[vr::kBoard + board] = view.panels[vr::kBoard];
  panels.follow(frameOf({}, {}), view);
  const vr::Panels::Place board = *panels.place(vr::kBoard), right = *panels.place(vr::kBoard + 1),
                          left = *panels.place(vr::kBoard + 2);
  const Vector3 eyes = scriptHead().position;
  for (const vr::Panels::Place& one : {board, right, left}) {
    const Vector3 way = eyes - one.pose.position;
    QVERIFY(std::abs(way.norm() - 0.75) < 1e-9);
    QVERIFY((one.pose.orientation * Vector3::UnitZ()).dot(way.normalized()) > 1 - 1e-9);
  }
  const auto heading = [&](const Vector3& place) {
    const Vector3 way = place - eyes;
    return std::atan2(way.x(), -way.z());
  };
  for (const double y : {0.0, 1.0}) {
    QVERIFY(heading(left.at(1, y)) < heading(board.at(0, y)));
    QVERIFY(heading(board.at(1, y)) < heading(right.at(0, y)));
  }
  view.panels[vr::kBoard].image = nullptr;
  panels.follow(frameOf({}, {}), view);
  QVERIFY(!panels.place(vr::kBoard) && panels.place(vr::kBoard + 1) && panels.place(vr::kBoard + 2));
}

/// At the end of the beam, turned to the wearer, until the grip is let go; no other part of it is taken.
void VrPanelsTest::aGripCarriesABoardByItsHeader() {
  vr::Panels panels;
  vr::HeadsetView view = emptyView();
  view.panels[vr::kBoard].header = 0.09;
  panels.follow(frameOf({}, {}), view);
  const vr::Panels::Place board = *panels.place(vr::kBoard);
  const Vector3 hand(0.3, 1.1, 0), eyes = scriptHead().position;
  const vr::HandPose middle = pointing(hand, board.at(0.5, 0.5)), header = pointing(hand, board.at(0.3, 0.04)),
                     away = pointing({0.2, 1.3, 0.1}, {-0.6, 1.2, -0.3});
  const auto hold = [&](const vr::HandPose& pose, double held, bool busy = false) {
    vr::HeadsetFrame frame = frameOf({}, pose);
    frame.hands[vr::kRight].hold = held;
    panels.follow(frame, view, busy);
    return *panels.place(vr::kBoard);
  };
  for (const double held : {0.0, 1.0}) hold(middle, held);
  QCOMPARE(hold(away, 1).pose.position, board.pose.position);
  hold(header, 1);  // it was pressed elsewhere
  QVERIFY(!panels.carries(vr::kRight));
  hold(header, 0);
  hold(header, 1, true);  // it carries the scene
  QVERIFY(!panels.carries(vr::kRight));
  for (const double held : {0.0, 1.0}) hold(header, held);
  QVERIFY(panels.carries(vr::kRight));
  const vr::Panels::Place carried = hold(away, 1);
  const Vector3 end = away.position + (board.at(0.3, 0.04) - hand).norm() * (away.orientation * Vector3(0, 0, -1));
  QVERIFY((carried.at(0.3, 0.04) - end).norm() < 1e-6);
  QVERIFY((carried.pose.orientation * Vector3::UnitZ()).dot((eyes - end).normalized()) > 1 - 1e-9);
  const auto& point = panels.pointed(vr::kRight);
  QVERIFY(point && point->panel == vr::kBoard && !point->pressed && std::abs(point->y - 0.04) < 1e-6);
  hold(away, 0);
  QVERIFY(!panels.carries(vr::kRight));
  QCOMPARE(hold(middle, 0).pose.position, carried.pose.position);
  ++view.brought[0];
  QCOMPARE(hold(middle, 0).pose.position, board.pose.position);
  // What it carries when both grips begin to carry the scene is put down there, and not drawn after it later.
  for (const double held : {0.0, 1.0}) hold(header, held);
  QVERIFY(panels.carries(vr::kRight));
  const Vector3 put = hold(header, 1).pose.position;
  hold(header, 1, true);
  QVERIFY(!panels.carries(vr::kRight));
  QCOMPARE(hold(away, 1).pose.position, put);
  QVERIFY(!panels.carries(vr::kRight));
  // One that is put away and brought again stays where it was brought, and the grip takes nothing else.
  hold(middle, 0);
  ++view.brought[0];
  for (const double held : {0.0, 1.0}) hold(header, held);
  QVERIFY(panels.carries(vr::kRight));
  const auto image = std::exchange(view.panels[vr::kBoard].image, nullptr);
  vr::HeadsetFrame still = frameOf({}, header);
  still.hands[vr::kRight].hold = 1;
  panels.follow(still, view);
  view.panels[vr::kBoard].image = image;
  ++view.brought[0];
  QCOMPARE(hold(away, 1).pose.position, board.pose.position);
  QVERIFY(panels.carries(vr::kRight));
}

/// Where its tip is, which presses nothing on the way.
void VrPanelsTest::aTipCarriesABoardByItsHeader() {
  vr::Panels panels;
  vr::HeadsetView view = emptyView();
  view.panels[vr::kBoard].header = 0.09;
  panels.follow(frameOf({}, {}), view);
  const vr::Panels::Place board = *panels.place(vr::kBoard);
  const Vector3 front = board.pose.orientation * Vector3::UnitZ(), to = board.at(0.7, 0.05);
  vr::HandPose hand = pointing(to + (0.02 + vr::kTip) * front, to);
  const Vector3 before = hand.position + hand.orientation * Vector3(0, 0, -vr::kTip);
  const auto hold = [&](double held) {
    vr::HeadsetFrame frame = frameOf({}, hand);
    frame.hands[vr::kRight].hold = held;
    panels.follow(frame, view);
  };
  for (const double held : {0.0, 1.0}) hold(held);
  QVERIFY(panels.carries(vr::kRight) && panels.pointed(vr::kRight)->tip);
  hand.position += Vector3(0.1, 0.2, 0.05);
  hold(1);
  const Vector3 after = hand.position + hand.orientation * Vector3(0, 0, -vr::kTip);
  QVERIFY((panels.place(vr::kBoard)->own(after) - board.own(before)).norm() < 1e-6);
  QVERIFY(panels.pointed(vr::kRight) && !panels.pointed(vr::kRight)->pressed);
}

/// A gap is no target: what a hand has just been on stays meant within 1.5 degrees of its edge.
void VrPanelsTest::aBeamAtAnEdgeKeepsWhatItLeft() {
  enterWithout();
  painted();
  QToolButton *undo = button(vr::kPalette, "Undo"), *play = button(vr::kPalette, "Play or pause");
  QVERIFY(undo && play);
  const QSignalSpy clicks(play, &QToolButton::clicked);
  const auto isUnder = [](const QWidget* one) { return one->testAttribute(Qt::WA_UnderMouse); };
  const QPointF middle = QRectF(play->rect()).center(), above(middle.x(), -4);
  at(vr::kPalette, *play, above, false);
  QVERIFY(!isUnder(play));  // it did not come from there
  at(vr::kPalette, *play, middle, false);
  QVERIFY(isUnder(play));
  for (const bool pressed : {false, true, false}) at(vr::kPalette, *play, above, pressed);
  QVERIFY(isUnder(play));
  QCOMPARE(clicks.count(), 1);
  click(vr::kPalette, *play);
  at(vr::kPalette, *undo, QRectF(undo->rect()).center(), false);
  QVERIFY(!isUnder(play) && isUnder(undo));
}

/// By 0.4 degrees, either way.
void VrPanelsTest::aBeamThatTremblesKeepsItsRow() {
  enterWithout();
  panels().showPage(QStringLiteral("Brush"));
  painted();
  const auto isWhole = [](const QWidget* one) { return one->visibleRegion().boundingRect() == one->rect(); };
  ParameterRow *upper = nullptr, *lower = nullptr;
  const auto rows = panels().widget(vr::kBoard)->findChildren<ParameterRow*>();
  for (ParameterRow* one : rows)
    for (ParameterRow* next : rows) {
      const bool isNext = one->parentWidget() == next->parentWidget() && next->y() == one->y() + one->height();
      const bool areFree = one->focusPolicy() != Qt::NoFocus && next->focusPolicy() != Qt::NoFocus;
      if (!upper && isNext && areFree && isWhole(one) && isWhole(next)) upper = one, lower = next;
    }
  QVERIFY(upper && lower);
  const auto under = [&](const QWidget* one) { return one->testAttribute(Qt::WA_UnderMouse); };
  const double edge = upper->height();
  const auto points = [&](double y) { at(vr::kBoard, *upper, {30, y}, false); };
  points(edge / 2);
  QVERIFY(under(upper) && !under(lower));
  points(edge + 2);
  QVERIFY(under(upper) && !under(lower));
  points(edge + 8);
  QVERIFY(!under(upper) && under(lower));
  points(edge - 2);
  QVERIFY(!under(upper) && under(lower));
  points(edge - 8);
  QVERIFY(under(upper) && !under(lower));
}

void VrPanelsTest::beamsPressAndKeepWhatTheyPress() {
  vr::Panels panels;
  const vr::HeadsetView view = emptyView();
  panels.follow(frameOf({}, {}), view);
  const vr::Panels::Place board = *panels.place(vr::kBoard);
  const Vector3 hand(0.3, 1.1, 0);
  const auto pointAt = [&](double x, double y, double pulled) {
    panels.follow(frameOf({}, pointing(hand, board.at(x, y)), pulled), view);
    return panels.pointed(vr::kRight);
  };
  auto point = pointAt(0.25, 0.75, 0);
  QVERIFY(point && point->panel == vr::kBoard && !point->tip && !point->pressed);
  QVERIFY(std::abs(point->x - 0.25) < 1e-6 && std::abs(point->y - 0.75) < 1e-6);
  QVERIFY((*panels.hit(vr::kRight) - board.at(0.25, 0.75)).norm() < 1e-9);
  QVERIFY(pointAt(0.25, 0.75, 1)->pressed);
  point = pointAt(1.3, 0.75, 1);  // a drag may leave it
  QVERIFY(point && point->pressed && std::abs(point->x - 1.3) < 1e-6);
  point = pointAt(1.3, 0.75, 0);
  QVERIFY(point && !point->pressed);
  QVERIFY(!pointAt(1.3, 0.75, 0) && !panels.takes(vr::kRight));
  // By a little it may miss the edge once it is there, but not come from there.
  const double miss = 1 + 0.5 * 1.5 * kDegree * 0.8 / board.width;
  QVERIFY(!pointAt(miss, 0.5, 0));
  QVERIFY(pointAt(0.99, 0.5, 0) && pointAt(miss, 0.5, 0));
  // From behind there is nothing to point at.
  panels.follow(frameOf({}, pointing({0.1, 1.3, -2}, board.at(0.5, 0.5))), view);
  QVERIFY(!panels.pointed(vr::kRight));
}

void VrPanelsTest::tipsPressWhatTheyGoThrough() {
  vr::Panels panels;
  const vr::HeadsetView view = emptyView();
  panels.follow(frameOf({}, {}), view);
  const vr::Panels::Place board = *panels.place(vr::kBoard);
  const Vector3 front = board.pose.orientation * Vector3::UnitZ(), to = board.at(0.5, 0.5);
  const auto tipAt = [&](double before) {
    panels.follow(frameOf({}, pointing(to + (before + vr::kTip) * front, to)), view);
    return panels.pointed(vr::kRight);
  };
  QVERIFY(!tipAt(0.1)->tip);  // as far away it is a beam
  QVERIFY(tipAt(0.02)->tip && !tipAt(0.02)->pressed && !panels.hit(vr::kRight));
  QVERIFY(tipAt(-0.005)->pressed);
  QVERIFY(tipAt(0.005)->pressed);
  QVERIFY(!tipAt(0.015)->pressed);
}

/// From before the wand to a dot on the panel, in the accent's colour, by both eyes.
void VrPanelsTest::aBeamIsSeenToWhatItPointsAt() {
  constexpr int kWide = 512;
  const QString size = QStringLiteral(R"("width": %1, "height": %1)");
  QString text = QString::fromStdString(vrScript({}, kHandsAway));
  QVERIFY(text.contains(size.arg(kSide)));
  ScriptedRun run(text.replace(size.arg(kSide), size.arg(kWide)).toStdString());
  enter();
  panels().showLabels(false);
  panels().showPage(QStringLiteral("Scene"));
  const Vector3 hit = boardPlace().at(0.4, 0.5);
  const vr::HandPose hand = pointing({0.3, 1.2, -0.1}, hit);
  run.goOn(vrScript(QStringLiteral(R"(, "pictures": [20, 50])"), kHandsAway + key(30, "right", hand)));
  QTRY_COMPARE_WITH_TIMEOUT(run.lines("picture").size(), size_t{4}, 2 * kLong);
  leave();
  QVERIFY(run.lines("violation").empty());
  const Vector3 way = (hit - hand.position).normalized();
  const int accent = Theme::current()[Token::Accent].hsvHue();
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  for (const bool right : {false, true}) {
    std::vector<QImage> seen;
    for (const std::string& name : run.texts("picture"))
      if (name.ends_with(right ? "-right.png" : "-left.png")) seen.emplace_back(QString::fromStdString(name));
    QCOMPARE(seen.size(), size_t{2});
    if (!folder.isEmpty()) seen[1].save(folder + (right ? "/vr-beam-right.png" : "/vr-beam-left.png"));
    // A pixel near there is of its colour, and was another one before.
    const auto shines = [&](const Vector3& room) {
      const auto colourAt = [&](const QImage& picture, int k) {
        const Vector3 at = project(scriptEye(right), picture.width(), picture.height(), room).value_or(Vector3::Zero());
        return picture.pixelColor(int(at.x()) + k % 5 - 2, int(at.y()) + k / 5 - 2);
      };
      for (int k = 0; k < 25; ++k) {
        const QColor a = colourAt(seen[0], k), b = colourAt(seen[1], k);
        const int apart = std::abs(a.red() - b.red()) + std::abs(a.green() - b.green()) + std::abs(a.blue() - b.blue());
        if (apart > 30 && std::abs(b.hsvHue() - accent) < 25 && b.hsvSaturation() > 60) return true;
      }
      return false;
    };
    for (const double before : {0.05, 0.1}) QVERIFY(shines(hand.position + (vr::kTip + before) * way));
    QVERIFY(shines(hit));
    QVERIFY(!shines(hand.position + (vr::kTip + 0.05) * way + Vector3(0, 0.05, 0)));
  }
}

void VrPanelsTest::aTriggerPulledElsewhereDraws() {
  vr::Panels panels;
  const vr::HeadsetView view = emptyView();
  panels.follow(frameOf({}, {}), view);
  const vr::Panels::Place board = *panels.place(vr::kBoard);
  const Vector3 hand(0.3, 1.1, 0);
  panels.follow(frameOf({}, pointing(hand, {2, 1, -1}), 1), view);
  panels.follow(frameOf({}, pointing(hand, board.at(0.5, 0.5)), 1), view);
  QVERIFY(!panels.takes(vr::kRight));  // the stroke goes on over it
  panels.follow(frameOf({}, pointing(hand, board.at(0.5, 0.5)), 0), view);
  QVERIFY(panels.takes(vr::kRight));
}

/// The palette is held before the board, and a popup lies over the panel that it came from, also at its edge.
void VrPanelsTest::theNearerPanelIsMeant() {
  vr::Panels panels;
  vr::HeadsetView view = emptyView();
  view.panels[vr::kPopup] = {std::make_shared<PanelImage>(), 0.1, 0.1, vr::kBoard, 0.2, 0.1};
  panels.follow(frameOf(palm(), {}), view);
  const auto palette = panels.place(vr::kPalette), board = panels.place(vr::kBoard), popup = panels.place(vr::kPopup);
  QVERIFY(palette && board && popup);
  // From before the palette through its middle, on to wherever that leads.
  const Vector3 front = palette->pose.orientation * Vector3::UnitZ();
  panels.follow(frameOf(palm(), pointing(palette->pose.position + 0.3 * front, palette->pose.position)), view);
  QVERIFY(panels.pointed(vr::kRight) && panels.pointed(vr::kRight)->panel == vr::kPalette);
  panels.follow(frameOf(palm(), pointing({0.3, 1.1, 0}, popup->at(0.5, 0.5))), view);
  QVERIFY(panels.pointed(vr::kRight) && panels.pointed(vr::kRight)->panel == vr::kPopup);
  Props props;
  panels.addTo(props, {}, view);
  const auto order = [&](size_t panel) {
    return std::find_if(props.panels.begin(), props.panels.end(),
                        [&](const Panel& one) { return one.image == view.panels[panel].image; });
  };
  QVERIFY(order(vr::kPopup) > order(vr::kBoard));
}

namespace {

/// What is too small to be read or met, of what is seen of a panel from so far away, m, where a logical pixel has so
/// many metres: letters of 0.85 degrees and targets of 2.5 are meant. Rows, fields and buttons are; what lies within
/// them, such as a field's own icons, is besides.
QStringList tooSmall(const QWidget& panel, double pixel, double away) {
  const auto degrees = [&](double pixels) { return std::atan(pixels * pixel / away) / kDegree; };
  QStringList found;
  const auto check = [&](const QWidget& one, const char* what, double pixels, double least) {
    if (degrees(pixels) <= least)
      found << QStringLiteral("%1 “%2”: %3 %4 px")
                   .arg(QString::fromLatin1(one.metaObject()->className()), one.accessibleName(),
                        QString::fromLatin1(what), QString::number(pixels));
  };
  for (const TextRole role : {TextRole::Normal, TextRole::Small, TextRole::Medium, TextRole::Time, TextRole::Heading,
                              TextRole::Title, TextRole::Symbol})
    check(panel, "painted letters of", Theme::font(role).pixelSize(), 0.85);
  for (const auto* one : panel.findChildren<QWidget*>()) {
    if (!one->isVisible() || qobject_cast<const QLineEdit*>(one->parentWidget())) continue;
    check(*one, "letters of", QFontInfo(one->font()).pixelSize(), 0.85);
    const auto* button = qobject_cast<const QAbstractButton*>(one);
    const bool isRow = qobject_cast<const ParameterRow*>(one) || qobject_cast<const GroupHeading*>(one);
    if (button) check(*one, "width", one->width(), 2.5);
    if (button || isRow || qobject_cast<const QLineEdit*>(one) || qobject_cast<const QComboBox*>(one))
      check(*one, "height", one->height(), 2.5);
    const auto* list = qobject_cast<const QAbstractItemView*>(one);
    if (list && list->model() && list->model()->rowCount() > 0)
      check(*one, "rows of", list->visualRect(list->model()->index(0, 0)).height(), 2.5);
  }
  return found;
}

}  // namespace

/// On the palette, and on all pages of the board.
void VrPanelsTest::letteringAndTargetsAreLargeEnough() {
  document().addMaterial("iron");  // there is something to compare with
  m_window->selection().setMaterial("water");
  m_window->selection().selectBody(document().project().bodies.front().id);
  m_window->curves().choose(kViscosity);
  enterWithout();
  QStringList small;
  for (const char* page :
       {"Brush", "Body", "Material", "Materials", "Scene", "Outliner", "Graphs", "Responses", "Curve", "Transport"}) {
    panels().showPage(QString::fromLatin1(page));
    const vr::HeadsetView view = painted();
    const QWidget* board = panels().widget(vr::kBoard);
    QVERIFY(board);
    for (const QString& one : tooSmall(*board, view.panels[vr::kBoard].width / board->width(), 0.75))
      small << QString::fromLatin1(page) + QStringLiteral(": ") + one;
  }
  const vr::HeadsetView view = painted();
  const QWidget* palette = panels().widget(vr::kPalette);
  small << tooSmall(*palette, view.panels[vr::kPalette].width / palette->width(), 0.5);
  QVERIFY2(small.isEmpty(), qPrintable(small.join(QStringLiteral("; "))));
  // Menus come at the board's scale.
  QWidget* board = panels().widget(vr::kBoard);
  QMenu menu(board);
  QAction* entry = menu.addAction(QStringLiteral("One"));
  menu.ensurePolished();
  const double pixel = view.panels[vr::kBoard].width / board->width();
  QVERIFY(std::atan(menu.actionGeometry(entry).height() * pixel / 0.75) / kDegree > 2.5);
  // Marks of the outliner's rows are met as far as the rows are high, though they look smaller.
  panels().showPage(QStringLiteral("Outliner"));
  QTest::qWait(100);
  const std::string body = document().project().bodies.front().id;
  auto* tree = board->findChild<Outliner*>()->findChild<QTreeView*>();
  const QModelIndexList rows = tree->model()->match(
      tree->model()->index(0, 0), outline::kId, QString::fromStdString(body), 1, Qt::MatchExactly | Qt::MatchRecursive);
  QVERIFY(!rows.isEmpty());
  tree->scrollTo(rows.front());
  const QRect row = tree->visualRect(rows.front());
  const QPointF corner(OutlinerDelegate::eyeRect(row).left() - 2, row.top() + 1);
  QVERIFY(document().body(body)->visible);
  for (const bool pressed : {false, true, false}) at(vr::kBoard, *tree->viewport(), corner, pressed);
  QTRY_VERIFY_WITH_TIMEOUT(!document().body(body)->visible, kLong);
}

/// The palette goes while its button is pressed, and the beam meets what stood behind it.
void VrPanelsTest::whatVanishesUnderAPressIsNotClicked() {
  enterWithout();
  panels().showPage(QStringLiteral("Brush"));
  QTest::qWait(100);
  QToolButton* play = button(vr::kPalette, "Play or pause");
  const bool playing = session().playing();
  at(vr::kPalette, *play, QRectF(play->rect()).center(), true);
  QVERIFY(play->isDown());
  at(vr::kBoard, *panels().widget(vr::kBoard), {10, 10}, false);
  QVERIFY(!play->isDown());
  QCOMPARE(session().playing(), playing);
  at(vr::kPalette, *play, QRectF(play->rect()).center(), true);
  panels().letGo();
  QVERIFY(!play->isDown());
  QCOMPARE(session().playing(), playing);
}

/// By the scripted headset, end to end: the palette is seen, a beam goes to its first button, and the run plays.
void VrPanelsTest::aBeamPlaysTheRun() {
  enterWithout();
  const QWidget* play = button(vr::kPalette, "Play or pause");
  QVERIFY(play);
  const vr::HandPose hand = handAt(*play);
  leaveAtLast();
  const ScriptedRun run(vrScript(QStringLiteral(R"(, "pictures": [50])"),
                                 key(5, "left", palm()) + key(5, "right", hand) + key(200, "right", hand, trigger(1)) +
                                     key(215, "right", hand, trigger(0))));
  QVERIFY(!session().playing());
  action()->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(session().playing(), kLong);
  QVERIFY(vr().frames() >= 200);
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > 230, kLong);
  QVERIFY(session().playing());
  QVERIFY(document().undoStack().index() == 0);  // nothing was drawn
  leave();
  session().pause();
  QVERIFY(run.lines("violation").empty());
  QVERIFY(!run.lines("haptic").empty());  // the button was felt
  const QImage seen = run.picture(50, 0);
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  if (!folder.isEmpty()) seen.save(folder + "/vr-palette-left.png");
  if (!folder.isEmpty()) run.picture(50, 1).save(folder + "/vr-palette-right.png");
  const auto edge = project(scriptEye(false), kSide, kSide, palettePlace().at(0.5, 0.985));
  QVERIFY(edge);
  const QColor there = seen.pixelColor(int(edge->x()), int(edge->y())), wanted = Theme::current()[Token::Panel];
  QVERIFY2(std::abs(there.red() - wanted.red()) < 40 && std::abs(there.blue() - wanted.blue()) < 40,
           qPrintable(there.name() + wanted.name()));
}

/// With the simple controller, which has a menu and a trigger: the left hand's menu brings the palette, the right one
/// presses there what turns its wearer. Both eyes see the scene turned about them.
void VrPanelsTest::aSimpleControllerTurnsByThePalette() {
  enterWithout();
  const vr::HeadsetView view = painted();
  const QWidget* turn = button(vr::kPalette, "Turn right by 30°");
  QVERIFY(turn);
  const vr::HandPose brings{{-0.05, 1.2, -0.2}, Quaternion::Identity()};
  vr::HeadsetFrame frame = frameOf(brings, {});
  frame.hands[vr::kLeft].menu = true;
  vr::Panels geometry;
  geometry.follow(frame, view);
  const auto palette = geometry.place(vr::kPalette);
  QVERIFY(palette);
  const vr::HandPose hand = handAt(*turn, *palette);
  leaveAtLast();
  const auto script = [](const QString& more, const QString& keys) {
    return withProfile(vrScript(more, keys), QStringLiteral("/interaction_profiles/khr/simple_controller"));
  };
  ScriptedRun run(script({}, key(5, "left", brings) + key(5, "right", hand)));
  enter();
  QTest::qWait(1000);  // the palette is painted
  run.goOn(script(QStringLiteral(R"(, "pictures": [60])"),
                  key(0, "left", brings) + key(0, "right", hand) + key(5, "left", brings, clicked("menu")) +
                      key(10, "left", brings, clicked("menu", false)) + key(80, "right", hand, clicked("select")) +
                      key(95, "right", hand, clicked("select", false))));
  vr::HeadsetView told;
  QTRY_VERIFY_WITH_TIMEOUT((panels().describe(told), told.turns == 1), 2 * kLong);
  QVERIFY(!session().playing());
  QCOMPARE(document().undoStack().index(), 0);
  const vr::Stand turned = vr::turned(stand(), scriptHead().position, std::numbers::pi / 6);
  const size_t pictures = run.lines("picture").size();
  run.goOn(
      script(QStringLiteral(R"(, "pictures": [40])"),
             key(0, "left", brings, clicked("menu")) + key(5, "left", brings, clicked("menu", false)) + awayFrom(10)));
  QTRY_VERIFY_WITH_TIMEOUT(run.lines("picture").size() == pictures + 2, kLong);
  leave();
  QVERIFY(run.lines("violation").empty());
  const auto names = run.texts("picture");
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  for (size_t k = 0; k < names.size(); ++k) {
    const QImage eye(QString::fromStdString(names[k]));
    const bool right = QString::fromStdString(names[k]).endsWith(QStringLiteral("-right.png"));
    if (!folder.isEmpty())
      eye.save(folder + QStringLiteral("/vr-simple-%1-%2.png").arg(k).arg(right ? "right" : "left"));
    if (k >= pictures) seesWhatTheViewDraws(eye, right, turned);
  }
}

/// The board by its button, then a slider of the brush's page from its middle to its end.
void VrPanelsTest::aSliderOfTheBoardIsDragged() {
  enterWithout();
  panels().showPage(QStringLiteral("Brush"));
  const vr::HeadsetView view = painted();
  ParameterRow* radius = rowOf(QStringLiteral("radius"));
  QVERIFY(radius);
  QWidget* board = panels().widget(vr::kBoard);
  const QRectF track = QRectF(radius->sliderRect()).translated(radius->mapTo(board, QPoint(0, 0)));
  const QSizeF size = board->size();
  leaveAtLast();
  vr::Panels geometry;
  geometry.follow(frameOf({}, {}), view);
  const auto place = geometry.place(vr::kBoard);
  const auto to = [&](double share) {
    return place->at((track.left() + share * track.width()) / size.width(), track.center().y() / size.height());
  };
  const Vector3 hand(0.3, 1.15, 0.1);
  const double before = m_window->tools().brush().radius;
  const ScriptedRun run(vrScript(QStringLiteral(R"(, "pictures": [280])"),
                                 key(5, "right", pointing(hand, to(0.3))) +
                                     key(10, "right", pointing(hand, to(0.3)), clicked("b")) +
                                     key(15, "right", pointing(hand, to(0.3)), clicked("b", false)) +
                                     key(200, "right", pointing(hand, to(0.3)), trigger(1)) +
                                     key(260, "right", pointing(hand, to(0.95)), trigger(1)) +
                                     key(300, "right", pointing(hand, to(0.95)), trigger(0))));
  action()->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > 305, 2 * kLong);
  const double now = m_window->tools().brush().radius;
  leave();
  QVERIFY(run.lines("violation").empty());
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  if (!folder.isEmpty()) run.picture(280, 0).save(folder + "/vr-board-left.png");
  if (!folder.isEmpty()) run.picture(280, 1).save(folder + "/vr-board-right.png");
  QVERIFY2(now > 2 * before, qPrintable(QString::number(now)));
  BrushSettings brush = m_window->tools().brush();
  brush.radius = before;
  m_window->tools().setBrush(brush);
}

/// A graph is zoomed, a body's value dragged as one step.
void VrPanelsTest::pagesAreTheWindowsOwn() {
  session().step();
  session().step();
  session().step();
  QTRY_COMPARE_WITH_TIMEOUT(session().newest()->stats.frame, uint64_t{3}, kLong);
  enterWithout();
  panels().showPage(QStringLiteral("Graphs"));
  QTest::qWait(100);
  auto* graph = panels().widget(vr::kBoard)->findChild<GraphView*>();
  QVERIFY(graph && graph->isVisible());
  const auto width = [&] { return graph->range().second - graph->range().first; };
  const double whole = width();
  at(vr::kBoard, *graph, graph->plotRect().center(), false, 1);
  QTRY_VERIFY(width() < 0.95 * whole);
  m_window->selection().selectBody(document().project().bodies.front().id);
  panels().showPage(QStringLiteral("Body"));
  QTest::qWait(100);
  ParameterRow* row = rowOf(QStringLiteral("body/") + QString::fromStdString(document().project().bodies.front().id) +
                            QStringLiteral("/temperature"));
  QVERIFY(row);
  const int steps = document().undoStack().index();
  const QRectF track = row->sliderRect();
  for (const double share : {0.2, 0.4, 0.6})
    at(vr::kBoard, *row, {track.left() + share * track.width(), track.center().y()}, true);
  at(vr::kBoard, *row, {track.left() + 0.6 * track.width(), track.center().y()}, false);
  QCOMPARE(document().undoStack().index(), steps + 1);
  document().undoStack().undo();
}

/// Those of the material and the brush; a material that the scene has not yet comes from its page, and shows what it
/// looks like beside its name.
void VrPanelsTest::namesLeadToTheirPages() {
  enterWithout();
  painted();
  for (const auto& [name, page] : {std::pair("Brush", "Brush"), std::pair("Material", "Materials")}) {
    QToolButton* value = button(vr::kPalette, name);
    QVERIFY(value);
    QCOMPARE(value->toolTip(), QStringLiteral("Brings the page %1").arg(QLatin1String(page)));
    click(vr::kPalette, *value);
    QWidget* board = panels().widget(vr::kBoard);
    QVERIFY(board);
    const auto labels = board->findChildren<QLabel*>();
    QVERIFY2(std::any_of(labels.begin(), labels.end(),
                         [page = page](const QLabel* one) { return one->text() == QLatin1String(page); }),
             page);
  }
  const auto swatch = [&] { return button(vr::kPalette, "Material")->icon().pixmap(QSize(20, 20)).toImage(); };
  const QImage before = swatch();
  QVERIFY(!before.isNull());
  const auto isThere = [&] { return installedIn(document().project(), "iron") != nullptr; };
  QVERIFY(!isThere());
  auto* materials = panels().widget(vr::kBoard)->findChild<MaterialsPanel*>();
  QVERIFY(materials);
  painted();
  const QRect tile = materials->tileOf("iron");
  QVERIFY(!tile.isEmpty() && !materials->visibleRegion().contains(tile.center()));
  // The stick scrolls what lies below.
  for (int k = 0; k < 8; ++k) at(vr::kBoard, *materials, materials->visibleRegion().boundingRect().center(), false, -1);
  QVERIFY(materials->visibleRegion().contains(tile.center()));
  for (const bool pressed : {false, true, false}) at(vr::kBoard, *materials, tile.center(), pressed);
  QTRY_VERIFY_WITH_TIMEOUT(isThere() && m_window->tools().brush().material == "iron", kLong);
  QTRY_COMPARE_WITH_TIMEOUT((painted(), button(vr::kPalette, "Material")->text()), QStringLiteral("Iron"), kLong);
  QVERIFY(swatch() != before);
  document().undoStack().undo();
}

/// What opens at a press there is seen and pressed like a panel; the press itself lasts until the menu closes.
void VrPanelsTest::menusComeAlong() {
  enterWithout();
  panels().showPage(QStringLiteral("Brush"));
  QTest::qWait(100);
  QWidget& board = *panels().widget(vr::kBoard);
  QMenu offered;
  for (const char* name : {"One", "Two"}) offered.addAction(QString::fromLatin1(name));
  QToolButton opens(&board);
  opens.setPopupMode(QToolButton::InstantPopup);
  opens.setMenu(&offered);
  opens.setGeometry(150, 120, 80, 30);
  opens.show();
  opens.raise();
  QSignalSpy chosen(offered.actions().back(), &QAction::triggered);
  bool seen = false;
  QTimer patience, watch;
  patience.setSingleShot(true);
  connect(&patience, &QTimer::timeout, &offered, &QMenu::close);
  connect(&watch, &QTimer::timeout, this, [&] {
    panels().paint();
    vr::HeadsetView view;
    panels().describe(view);
    if (seen || !view.panels[vr::kPopup].image) return;
    seen = true;
    const QPointF there = offered.actionGeometry(offered.actions().back()).center();
    for (const bool pressed : {false, true, false})
      if (panels().widget(vr::kPopup)) at(vr::kPopup, offered, there, pressed);
  });
  patience.start(kLong);
  watch.start(50);
  click(vr::kBoard, opens);
  QTRY_VERIFY_WITH_TIMEOUT(!offered.isVisible(), 2 * kLong);
  QVERIFY(seen);
  QCOMPARE(chosen.count(), 1);
}

/// And the next press is none beside a menu that nobody sees.
void VrPanelsTest::menusGoWithTheirBoard() {
  enterWithout();
  panels().showPage(QStringLiteral("Brush"));
  QTest::qWait(100);
  QMenu offered;
  offered.addAction(QStringLiteral("One"));
  QToolButton opens(panels().widget(vr::kBoard));
  opens.setPopupMode(QToolButton::InstantPopup);
  opens.setMenu(&offered);
  opens.setGeometry(150, 120, 80, 30);
  opens.show();
  opens.raise();
  bool isSeen = false;
  QTimer patience, watch;
  patience.setSingleShot(true);
  connect(&patience, &QTimer::timeout, &offered, &QMenu::close);
  connect(&watch, &QTimer::timeout, this, [&] {
    panels().paint();
    if (isSeen || !panels().widget(vr::kPopup)) return;
    isSeen = true;
    panels().toggleBoard();
    QVERIFY(!offered.isVisible());
  });
  patience.start(kLong);
  watch.start(50);
  for (const bool pressed : {false, true}) at(vr::kBoard, opens, QRectF(opens.rect()).center(), pressed);
  QVERIFY(isSeen && !panels().widget(vr::kBoard) && !panels().widget(vr::kPopup));
}

/// Pressed over a row, as the mouse's right button would; what it offers lies over the board.
void VrPanelsTest::aStickOpensMenus() {
  enterWithout();
  panels().showPage(QStringLiteral("Brush"));
  QTest::qWait(100);
  const ParameterRow* radius = rowOf(QStringLiteral("radius"));
  QVERIFY(radius);
  QStringList offered;
  bool isSeen = false;
  QTimer watch, patience;
  connect(&watch, &QTimer::timeout, this, [&] {
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    if (!menu) return;
    panels().paint();
    vr::HeadsetView view;
    panels().describe(view);
    if (!view.panels[vr::kPopup].image) return;
    isSeen = true;
    for (const QAction* action : menu->actions()) offered << action->text();
    menu->close();
  });
  connect(&patience, &QTimer::timeout, this, [] {
    if (QWidget* popup = QApplication::activePopupWidget()) popup->close();
  });
  watch.start(50);
  patience.start(kLong);
  const QPointF there = shareOf(vr::kBoard, *radius, radius->rect().center());
  vr::HandsSeen seen;
  seen.hands[vr::kRight].panel = vr::PanelPoint{vr::kBoard, there.x(), there.y(), 1, false, false};
  for (const bool pressed : {false, true}) {
    seen.seconds = m_seconds += 1;
    seen.hands[vr::kRight].input.steerPressed = pressed;
    panels().act(seen);
  }
  QTRY_VERIFY_WITH_TIMEOUT(isSeen, kLong);
  QVERIFY2(offered.contains(QStringLiteral("Reset")) && offered.contains(QStringLiteral("Explain")),
           qPrintable(offered.join(QStringLiteral(", "))));
  QCOMPARE(offered.count(QStringLiteral("Reset")), 1);
}

/// What its beam points at, as without the grip: by that stick it goes and scales elsewhere.
void VrPanelsTest::aLoneHandWithItsGripScrolls() {
  preferences::setOneHanded(true);
  ScriptedRun run(vrScript({}, kHandsAway));
  enter();
  panels().showPage(QStringLiteral("Materials"));
  QScrollArea* area = nullptr;
  const auto scrolls = [&] {
    for (auto* one : panels().widget(vr::kBoard)->findChildren<QScrollArea*>())
      if (one->isVisible() && one->verticalScrollBar()->maximum() > 0) area = one;
    return area != nullptr;
  };
  QTRY_VERIFY_WITH_TIMEOUT(scrolls(), kLong);
  QScrollBar& bar = *area->verticalScrollBar();
  bar.setValue(0);
  const auto stick = [&](int frame, int y) {
    return boardKey(frame, *area, QRectF(area->rect()).center(), false, false,
                    kHolds + QStringLiteral(R"(, "/input/thumbstick/y": %1)").arg(y));
  };
  run.goOn(vrScript({}, stick(0, 0) + stick(20, -1) + stick(26, 0)));
  QTRY_VERIFY_WITH_TIMEOUT(bar.value() > 0, kLong);
  const uint64_t over = vr().frames() + 10;
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > over, kLong);
  run.goOn(vrScript({}, stick(0, 0) + stick(20, 1) + stick(40, 0)));
  QTRY_COMPARE_WITH_TIMEOUT(bar.value(), 0, kLong);
  leave();
  QVERIFY(run.lines("violation").empty());
}

void VrPanelsTest::gravityIsTakenAndGivenBack() {
  enterWithout();
  const Address gravity{Owner::Scene, "", "gravity"};
  const Value before = document().value(gravity);
  QToolButton* one = button(vr::kPalette, "Zero gravity");
  QVERIFY(one && !one->isChecked());
  click(vr::kPalette, *one);
  QCOMPARE(document().value(gravity), Value(0.0));
  QVERIFY(one->isChecked());
  document().undoStack().undo();
  QCOMPARE(document().value(gravity), before);
  QVERIFY(!one->isChecked());
  click(vr::kPalette, *one);
  QVERIFY(one->isChecked());
  click(vr::kPalette, *one);
  QCOMPARE(document().value(gravity), before);
  QVERIFY(!one->isChecked());
}

void VrPanelsTest::labelsSayWhatControllersDo_data() {
  QTest::addColumn<QString>("profile");
  QTest::addColumn<QString>("left");
  QTest::addColumn<QString>("right");
  QTest::newRow("Touch") << kTouch << "Trigger, Grip, Grip, Trigger, Stick, X, Y"
                         << "Trigger, Grip, Grip, Trigger, Stick, Stick pressed, A, B";
  QTest::newRow("Vive") << "/interaction_profiles/htc/vive_controller"
                        << "Trigger, Grip, Grip, Trigger, Pad, Menu, Menu held"
                        << "Trigger, Grip, Grip, Trigger, Pad, , Menu, Menu held";
  QTest::newRow("simple") << "/interaction_profiles/khr/simple_controller"
                          << "Select, Menu"
                          << "Select, Menu";
  QTest::newRow("bare hands") << "/interaction_profiles/ext/hand_interaction_ext"
                              << "Pinch, Fist, Fist, Pinch, Index, then Pinch"
                              << "Pinch, Fist, Fist, Pinch";
  QTest::newRow("joints alone") << "joints"
                                << "Pinch, Fist, Fist, Pinch, Index, then Pinch"
                                << "Pinch, Fist, Fist, Pinch";
  QTest::newRow("a mouse") << "mouse"
                           << "Left button, Shift, Shift, left button, G, Wheel, X, C, Up, down, Left, right, N, F, "
                              "Space, R, U, P, M, Tab"
                           << "Left button, Shift, Shift, left button, G, Wheel, X, C, Up, down, Left, right, N, F, "
                              "Space, R, U, P, M, Tab";
  QTest::newRow("none") << ""
                        << ""
                        << "";
}

void VrPanelsTest::labelsSayWhatControllersDo() {
  QFETCH(QString, profile);
  QFETCH(QString, left);
  QFETCH(QString, right);
  const auto parts = [&](size_t hand) {
    QStringList names;
    for (const vr::HandLabel& label : vr::labelsOf(profile.toStdString(), hand)) {
      names << QString::fromStdString(label.part);
      if (label.does.empty()) return QStringLiteral("says nothing");
    }
    return names.join(QStringLiteral(", "));
  };
  QCOMPARE(parts(vr::kLeft), left);
  QCOMPARE(parts(vr::kRight), right);
}

/// And what they do changes with the main hand.
void VrPanelsTest::labelsFollowTheMainHand() {
  const auto does = [](const char* profile, size_t hand, const char* part, const vr::HandRoles& roles = {}) {
    for (const vr::HandLabel& label : vr::labelsOf(profile, hand, roles))
      if (label.part == part) return label.does;
    return std::string();
  };
  const vr::HandRoles leftHanded{vr::kLeft, false};
  QCOMPARE(does(kTouch, vr::kRight, "Trigger"), std::string("draw, press"));
  QCOMPARE(does(kTouch, vr::kLeft, "Trigger"), std::string("erase, press"));
  QCOMPARE(does(kTouch, vr::kLeft, "Grip, Trigger"), std::string("draw"));
  QCOMPARE(does(kTouch, vr::kLeft, "X"), std::string("play, pause"));
  QCOMPARE(does(kTouch, vr::kLeft, "Trigger", leftHanded), std::string("draw, press"));
  QCOMPARE(does(kTouch, vr::kRight, "Trigger", leftHanded), std::string("erase, press"));
  const vr::HandRoles alone{vr::kRight, true};
  QCOMPARE(does(kTouch, vr::kRight, "Grip", alone), std::string("hold"));
  QCOMPARE(does(kTouch, vr::kRight, "Grip, Stick", alone), std::string("forward: go there; aside: scale"));
  QCOMPARE(does(kTouch, vr::kLeft, "X", leftHanded), std::string("undo"));
  QCOMPARE(does(kTouch, vr::kRight, "Stick", leftHanded), std::string("forward: go there"));
  for (const size_t hand : {vr::kLeft, vr::kRight})
    QCOMPARE(does("/interaction_profiles/khr/simple_controller", hand, "Menu"), std::string("palette"));
}

/// Before the eyes, on its outer side, and nobody points at it.
void VrPanelsTest::labelsHangBesideTheHand() {
  vr::Panels panels;
  vr::HeadsetView view;
  view.labels[vr::kRight] = {std::make_shared<PanelImage>(), 0.16, 0.10, 0, 0, 0};
  const vr::HandPose hand{{0.2, 1.2, -0.3}, Quaternion::Identity()};
  panels.follow(frameOf({}, hand), view);
  const auto& place = panels.labels(vr::kRight);
  QVERIFY(place && !panels.labels(vr::kLeft));
  const Vector3 toEyes = (scriptHead().position - hand.position).normalized();
  QVERIFY((place->pose.orientation * Vector3::UnitZ()).dot(toEyes) > 1 - 1e-9);
  QVERIFY(place->pose.position.x() - 0.08 > hand.position.x());
  QVERIFY(std::abs(place->pose.position.y() - hand.position.y()) < 1e-9);
  panels.follow(frameOf({}, pointing({0, 1.5, 0.1}, place->pose.position)), view);
  QVERIFY(!panels.pointed(vr::kRight));
  panels.follow(frameOf(hand, {}), view);
  QVERIFY(!panels.labels(vr::kRight));
}

/// Of themselves at first, and then by the palette's button; in letters that can be read where a hand is held.
void VrPanelsTest::labelsGoAndComeBack() {
  const ScriptedRun run(vrScript());
  enter();
  QTRY_VERIFY_WITH_TIMEOUT(labelsNow()[vr::kLeft].image && labelsNow()[vr::kRight].image, kLong);
  const auto labels = labelsNow()[vr::kRight];
  const double pixel = labels.height * 2.5 / labels.image->height;  // m, painted at 2.5 to the logical one
  QVERIFY(std::atan(Theme::font(TextRole::Normal).pixelSize() * pixel / 0.5) / kDegree > 0.85);
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  if (!folder.isEmpty())
    QImage(labels.image->pixels.data(), labels.image->width, labels.image->height, QImage::Format_RGBA8888)
        .save(folder + "/vr-labels.png");
  QToolButton* button = this->button(vr::kPalette, "Labels");
  QVERIFY(button && button->isChecked());
  click(vr::kPalette, *button);
  QVERIFY(!button->isChecked() && !panels().showsLabels());
  QTRY_VERIFY_WITH_TIMEOUT(!labelsNow()[vr::kRight].image, kLong);
  click(vr::kPalette, *button);
  QVERIFY(button->isChecked());
  QTRY_VERIFY_WITH_TIMEOUT(labelsNow()[vr::kRight].image, kLong);
  leave();
}

void VrPanelsTest::scalesAreTold_data() {
  QTest::addColumn<double>("scale");
  QTest::addColumn<QString>("text");
  QTest::newRow("true") << 1.0 << QStringLiteral("1 : 1");
  QTest::newRow("nearly") << 0.97 << QStringLiteral("1 : 1");
  QTest::newRow("smaller") << 0.25 << QStringLiteral("1 : 4.0");
  QTest::newRow("least") << 0.05 << QStringLiteral("1 : 20");
  QTest::newRow("larger") << 2.5 << QStringLiteral("2.5 : 1");
  QTest::newRow("most") << 20.0 << QStringLiteral("20 : 1");
}

void VrPanelsTest::scalesAreTold() {
  QFETCH(double, scale);
  QFETCH(QString, text);
  QCOMPARE(scaleText(scale), text);
}

/// Beside the main hand, for as long as both grips have it, also where labels were put away.
void VrPanelsTest::aSceneThatIsCarriedTellsItsScale() {
  const auto both = [](const QString& inputs) {
    const vr::HandPose left{{-0.2, 1.1, -0.3}, Quaternion::Identity()}, right{{0.2, 1.1, -0.3}, left.orientation};
    return key(0, "left", left, inputs) + key(0, "right", right, inputs);
  };
  ScriptedRun run(vrScript({}, both(kHoldsNothing)));
  enter();
  QTRY_VERIFY_WITH_TIMEOUT(labelsNow()[vr::kRight].image, kLong);
  panels().showLabels(false);
  QTRY_VERIFY_WITH_TIMEOUT(!labelsNow()[vr::kRight].image, kLong);
  run.goOn(vrScript({}, both(kHolds)));
  QTRY_VERIFY_WITH_TIMEOUT(labelsNow()[vr::kRight].image, kLong);
  QVERIFY(!labelsNow()[vr::kLeft].image);
  run.goOn(vrScript({}, both(kHoldsNothing)));
  QTRY_VERIFY_WITH_TIMEOUT(!labelsNow()[vr::kRight].image, kLong);
  leave();
  QVERIFY(run.lines("violation").empty());
}

/// Without a headset: what the mouse points at on the palette is pressed, though the hand reaches farther. The hand
/// that it leads then has labels, of that window's keys.
void VrPanelsTest::aMousePressesThePalette() {
  enterWithout();
  const vr::HeadsetView view = painted();
  QVERIFY(!view.labels[vr::kRight].image);
  VrWithout& window = *vr().window();
  const double aspect = double(window.width()) / window.height();
  QToolButton* labels = button(vr::kPalette, "Labels");
  QVERIFY(labels && !labels->isChecked());
  const QPointF middle = middleOf(vr::kPalette, *labels);
  vr::Panels geometry;
  geometry.follow(window.room().frame(1, aspect), view);
  QVERIFY(geometry.place(vr::kPalette));
  const Vector3 there = geometry.place(vr::kPalette)->at(middle.x(), middle.y());
  const auto seen = project(window.room().eye(aspect), window.width(), window.height(), there);
  QVERIFY(seen);
  const QPoint at(int(seen->x()), int(seen->y()));
  const auto frames = [&](uint64_t more) {
    const uint64_t from = vr().frames();
    QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > from + more, kLong);
  };
  hands::move(window, at);
  frames(3);
  QTest::mousePress(&window, Qt::LeftButton, {}, at);
  frames(3);
  QTest::mouseRelease(&window, Qt::LeftButton, {}, at);
  QTRY_VERIFY_WITH_TIMEOUT(panels().showsLabels() && labels->isChecked(), kLong);
  QCOMPARE(document().undoStack().index(), 0);  // nothing was drawn
  QTRY_VERIFY_WITH_TIMEOUT(labelsNow()[vr::kRight].image && !labelsNow()[vr::kLeft].image, kLong);
}

/// Likewise: M pins it by the hand that the mouse leads, where its buttons are pressed then.
void VrPanelsTest::aKeyPinsThePalette() {
  enterWithout();
  const vr::HeadsetView view = painted();
  VrWithout& window = *vr().window();
  const double aspect = double(window.width()) / window.height();
  const auto frames = [&](uint64_t more) {
    const uint64_t from = vr().frames();
    QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > from + more, kLong);
  };
  hands::move(window, QPoint(window.width() / 2, window.height() * 3 / 5));
  frames(3);
  vr::Panels geometry;
  vr::HeadsetFrame frame = window.room().frame(1, aspect);
  geometry.follow(frame, view);
  QVERIFY(geometry.place(vr::kPalette));
  const Vector3 held = geometry.place(vr::kPalette)->pose.position;
  frame.hands[vr::kRight].menu = true;
  geometry.follow(frame, view);
  const auto& pinned = geometry.place(vr::kPalette);
  QVERIFY(pinned && (pinned->pose.position - held).norm() > 0.1);
  QTest::keyPress(&window, Qt::Key_M);
  frames(3);
  QTest::keyRelease(&window, Qt::Key_M);
  frames(3);
  QToolButton* labels = button(vr::kPalette, "Labels");
  QVERIFY(labels && !labels->isChecked());
  const QPointF middle = middleOf(vr::kPalette, *labels);
  const Vector3 there = pinned->at(middle.x(), middle.y());
  const auto seen = project(window.room().eye(aspect), window.width(), window.height(), there);
  QVERIFY(seen);
  const QPoint at(int(seen->x()), int(seen->y()));
  QVERIFY(window.rect().contains(at));
  hands::move(window, at);
  frames(3);
  QTest::mousePress(&window, Qt::LeftButton, {}, at);
  frames(3);
  QTest::mouseRelease(&window, Qt::LeftButton, {}, at);
  QTRY_VERIFY_WITH_TIMEOUT(panels().showsLabels() && labels->isChecked(), kLong);
  QCOMPARE(document().undoStack().index(), 0);  // nothing was drawn
}

QTEST_MAIN(VrPanelsTest)
#include "tst_vrpanels.moc"
