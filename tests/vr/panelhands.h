// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/vr/vrwindow.h"
#include "ui/rows/parameterrow.h"
#include "ui/vr/panels.h"
#include "ui/window/vrpanels.h"

#include <QtWidgets/QToolButton>

#include <numbers>

// What tests of panels in the headset share: hands that point, keys of scripts, and a board that is pressed.
namespace ps {

inline constexpr double kDegree = std::numbers::pi / 180;

/// A left hand before the wearer, whose palm faces them.
inline vr::HandPose palm() {
  const Vector3 toEyes = (scriptHead().position - Vector3(-0.05, 1.2, -0.2)).normalized();
  return {{-0.05, 1.2, -0.2}, Quaternion::FromTwoVectors(Vector3::UnitX(), toEyes)};
}

/// A right hand at a place that points at another.
inline vr::HandPose pointing(const Vector3& from, const Vector3& to) {
  return {from, Quaternion::FromTwoVectors(-Vector3::UnitZ(), to - from)};
}

inline vr::HeadsetFrame frameOf(const std::optional<vr::HandPose>& left, const std::optional<vr::HandPose>& right,
                                double pulled = 0) {
  vr::HeadsetFrame frame;
  frame.head = scriptHead();
  frame.hands[vr::kLeft].grip = frame.hands[vr::kLeft].aim = left;
  frame.hands[vr::kRight].grip = frame.hands[vr::kRight].aim = right;
  frame.hands[vr::kRight].draw = pulled;
  return frame;
}

inline QString poseText(const vr::HandPose& pose) {
  const auto& q = pose.orientation;
  QStringList numbers;
  for (const double number : {pose.position.x(), pose.position.y(), pose.position.z(), q.x(), q.y(), q.z(), q.w()})
    numbers << QString::number(number, 'g', 9);
  return QLatin1Char('[') + numbers.join(QStringLiteral(", ")) + QLatin1Char(']');
}

inline QString key(int frame, const char* hand, const vr::HandPose& pose, const QString& inputs = {}) {
  return QStringLiteral(R"(, {"frame": %1, "%2": {"active": true, "grip": %3, "aim": %3%4}})")
      .arg(QString::number(frame), QString::fromLatin1(hand), poseText(pose), inputs);
}

inline QString trigger(int value) { return QStringLiteral(R"(, "/input/trigger/value": %1)").arg(value); }

class PanelsTest : public VrWindowTest {
 protected:
  VrPanels& panels() { return *vr().panels(); }
  vr::HeadsetView painted() {
    vr::HeadsetView view;
    [&] { QTRY_VERIFY_WITH_TIMEOUT(panels().paint() || (panels().describe(view), view.panels[0].image), kLong); }();
    QTest::qWait(150);
    panels().paint();
    panels().describe(view);
    return view;
  }
  void enterWithout() {
    m_window->action(QStringLiteral("simulation.tryVr"))->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > 2, kLong);
  }
  /// Where a place of a widget is on its panel: 0..1 right and down from the upper left corner.
  QPointF shareOf(size_t panel, const QWidget& widget, const QPointF& place) {
    const QWidget* on = panels().widget(panel);
    const QPointF there = place + widget.mapTo(on, QPoint(0, 0));
    return {there.x() / on->width(), there.y() / on->height()};
  }
  QPointF middleOf(size_t panel, const QWidget& widget) {
    return shareOf(panel, widget, QRectF(widget.rect()).center());
  }
  /// The beam of a right hand points at a place of a widget of a panel.
  void at(size_t panel, const QWidget& widget, const QPointF& place, bool pressed, double steer = 0) {
    const QPointF there = shareOf(panel, widget, place);
    vr::HandsSeen seen;
    seen.seconds = m_seconds += 0.15;  // two presses in a row are a double one, a click after a click is not
    seen.hands[vr::kRight].panel = vr::PanelPoint{panel, there.x(), there.y(), 1, false, pressed};
    seen.hands[vr::kRight].input.steerY = steer;
    panels().act(seen);
  }
  QToolButton* button(size_t panel, const char* name) {
    for (auto* one : panels().widget(panel)->findChildren<QToolButton*>())
      if (one->accessibleName() == QString::fromUtf8(name)) return one;
    return nullptr;
  }
  void click(size_t panel, QWidget& widget) {
    const QPointF middle = QRectF(widget.rect()).center();
    for (const bool pressed : {false, true, false}) at(panel, widget, middle, pressed);
  }
  ParameterRow* rowOf(const QString& name) {
    for (auto* row : panels().widget(vr::kBoard)->findChildren<ParameterRow*>())
      if (row->isVisible() && row->model().key == name) return row;
    return nullptr;
  }

  /// Where the palette stands that the left palm holds up.
  const vr::Panels::Place& palettePlace() {
    if (m_palette) return *m_palette;
    vr::Panels geometry;
    geometry.follow(frameOf(palm(), {}), painted());
    m_palette = geometry.place(vr::kPalette).value_or(vr::Panels::Place());
    return *m_palette;
  }
  /// A right hand whose beam meets the middle of a button of the palette, where that stands there.
  vr::HandPose handAt(const QWidget& button, const vr::Panels::Place& palette) {
    const QPointF middle = middleOf(vr::kPalette, button);
    return pointing({0.25, 1.25, 0.1}, palette.at(middle.x(), middle.y()));
  }
  vr::HandPose handAt(const QWidget& button) { return handAt(button, palettePlace()); }

  /// Where the board stands that was brought before the script's head.
  const vr::Panels::Place& boardPlace() {
    if (m_board) return *m_board;
    vr::Panels geometry;
    geometry.follow(frameOf({}, {}), painted());
    m_board = geometry.place(vr::kBoard).value_or(vr::Panels::Place());
    return *m_board;
  }
  /// A key of the script: the right hand at a place of a widget on the board, by its beam or by its tip, and whether it
  /// presses there.
  QString boardKey(int frame, const QWidget& widget, const QPointF& at, bool byTip, bool presses,
                   const QString& inputs = {}) {
    constexpr double kBefore = 0.025, kThrough = -0.004;  // m, of a tip from the board
    const QPointF there = shareOf(vr::kBoard, widget, at);
    const vr::Panels::Place& place = boardPlace();
    const Vector3 to = place.at(there.x(), there.y());
    const Vector3 front = place.pose.orientation * Vector3::UnitZ();
    if (!byTip) return key(frame, "right", pointing({0.3, 1.15, 0.1}, to), trigger(presses) + inputs);
    return key(frame, "right", pointing(to + ((presses ? kThrough : kBefore) + vr::kTip) * front, to), inputs);
  }

  double m_seconds = 0;

 private:
  std::optional<vr::Panels::Place> m_palette, m_board;  ///< the same in all stays
};

}  // namespace ps
