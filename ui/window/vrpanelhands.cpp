// SPDX-License-Identifier: Apache-2.0
// What hands do at the panels of the headset: each is a mouse to the widgets that it points at.
#include "ui/window/vrlabels.h"
#include "ui/window/vrpanels.h"

#include <QtGui/QContextMenuEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QPointingDevice>
#include <QtGui/QWheelEvent>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QAbstractScrollArea>
#include <QtWidgets/QApplication>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ps {
namespace {

constexpr double kTwice = 0.4;                   // s within which a second press makes it a double click
constexpr double kTwiceReach = 8, kSticks = 15;  // px; the latter are 1.5 degrees
constexpr double kTrembles = 4;                  // px, 0.4 degrees: a row is 26 high
constexpr double kPushed = 0.7, kScroll = 0.1;   // of a stick's way; s between notches
constexpr int kNotch = 120;

/// Whose events widgets get: a hand is no more precise than a finger.
const QPointingDevice& handDevice() {
  static const QPointingDevice device(QStringLiteral("Hand in a headset"), 0, QInputDevice::DeviceType::TouchScreen,
                                      QPointingDevice::PointerType::Finger,
                                      QInputDevice::Capability::Position | QInputDevice::Capability::Hover, 1, 1);
  return device;
}

bool takesPresses(const QWidget& widget) {
  return widget.isEnabled() && (widget.focusPolicy() != Qt::NoFocus || widget.inherits("QAbstractButton"));
}

/// px beyond the edge of what a hand was on within which it is meant still, where the hand comes upon something else:
/// as it presses a button, beside anything that takes presses, and on the next row of several.
double sticksBeside(const QWidget& last, const QWidget& other, bool pressed) {
  const bool isButton = qobject_cast<const QAbstractButton*>(&last) != nullptr;
  if (pressed) return isButton && &other != &last ? kSticks : 0;
  if (!isButton && !takesPresses(last)) return 0;
  const bool isBetween = !takesPresses(other) && !qobject_cast<const QAbstractScrollArea*>(other.parentWidget());
  if (isBetween && (isButton || other.isAncestorOf(&last))) return kSticks;
  const bool isNext = last.parentWidget() == other.parentWidget() && last.metaObject() == other.metaObject();
  return isNext && !isButton ? kTrembles : 0;
}

}  // namespace

void VrPanels::act(const vr::HandsSeen& seen) {
  const uint64_t act = ++m_acts;
  m_ahead = seen.boardAhead;
  for (size_t hand = 0; hand < m_pointers.size(); ++hand) {
    const std::optional<vr::PanelPoint>& point = seen.hands[hand].panel;
    m_labels[hand]->setProfile(seen.hands[hand].input.profile, hand, seen.roles);
    m_labels[hand]->setScale(seen.carries && hand == seen.roles.main ? seen.scale : 0);
    follow(m_pointers[hand], point, seen.seconds);
    if (act != m_acts) return;  // a menu was open meanwhile: these hands are old
    const vr::HandInput& input = seen.hands[hand].input;
    const bool asked = std::exchange(m_pointers[hand].asks, input.steerPressed);
    if (point && input.steerPressed && !asked && std::hypot(input.steerX, input.steerY) < kPushed)
      openMenu(m_pointers[hand]);
    if (act != m_acts) return;
    if (point && std::abs(seen.hands[hand].input.steerY) > kPushed)
      scroll(m_pointers[hand], seen.hands[hand].input.steerY, seen.seconds);
  }
}

void VrPanels::letGo() {
  for (Pointer& pointer : m_pointers) leave(pointer);
  for (const std::unique_ptr<VrLabels>& labels : m_labels) labels->setScale(0);
}

/// What it presses is let go, and not clicked.
void VrPanels::leave(Pointer& pointer) {
  if (pointer.pressed) {
    const auto* button = qobject_cast<QAbstractButton*>(pointer.grabs.data());
    if (button && pointer.on && pointer.on->isAncestorOf(button))
      pointer.at = button->mapTo(pointer.on, QPoint(-1, -1));
    release(pointer);
  }
  if (pointer.on) enter(pointer, nullptr);
  pointer.on = nullptr;
}

/// Of a page that goes. What another hand presses there is let go, and it presses nothing else before it lets go; whose
/// event it is that leads to another page does so itself.
void VrPanels::letGoOf(const QWidget& page) {
  for (Pointer& pointer : m_pointers) {
    const bool isOf = pointer.grabs && (pointer.grabs == &page || page.isAncestorOf(pointer.grabs));
    if (!isOf || &pointer == m_sends) continue;
    const QPointer<QWidget> on = pointer.on;
    leave(pointer);
    pointer.on = on;
    pointer.pressed = true;
  }
}

/// What is there, or what the hand has just left, at its edge, where that has not gone with its page.
QWidget* VrPanels::aimedAt(Pointer& pointer) {
  QWidget* child = pointer.on->childAt(pointer.at.toPoint());
  if (!child) child = pointer.on;
  QWidget* last = pointer.grabs ? pointer.grabs.data() : pointer.under.data();
  const double sticks = last && last->isVisible() ? sticksBeside(*last, *child, pointer.grabs) : 0;
  if (sticks > 0 && last != child && pointer.on->isAncestorOf(last)) {
    const QRectF own(last->mapTo(pointer.on, QPoint(0, 0)), last->size());
    if (own.adjusted(-sticks, -sticks, sticks, sticks).contains(pointer.at)) {
      pointer.at = {std::clamp(pointer.at.x(), own.left(), own.right() - 1),
                    std::clamp(pointer.at.y(), own.top(), own.bottom() - 1)};
      return last;
    }
  }
  return pointer.grabs ? pointer.grabs.data() : child;
}

void VrPanels::follow(Pointer& pointer, const std::optional<vr::PanelPoint>& point, double seconds) {
  QWidget* on = point ? widget(point->panel) : nullptr;
  if (on != pointer.on) leave(pointer);
  if (!on) return;
  const QPointF at(point->x * on->width(), point->y * on->height());
  const bool moved = on != pointer.on || (at - pointer.at).manhattanLength() > 0.01;
  pointer.on = on;
  pointer.at = at;
  enter(pointer, aimedAt(pointer));
  if (moved && pointer.under) send(pointer, *pointer.under, QEvent::MouseMove, Qt::NoButton);
  if (!pointer.on || point->pressed == pointer.pressed) return;
  point->pressed ? press(pointer, seconds) : release(pointer);
}

/// What can be used is felt as one comes upon it.
void VrPanels::enter(Pointer& pointer, QWidget* under) {
  if (pointer.under == under) return;
  m_touched = true;
  if (pointer.under) {
    pointer.under->setAttribute(Qt::WA_UnderMouse, false);
    QEvent leave(QEvent::Leave);
    deliver(*pointer.under, leave);
  }
  pointer.under = under;
  if (!under) return;
  under->setAttribute(Qt::WA_UnderMouse, true);
  const QPointF local = under->mapFrom(pointer.on, pointer.at.toPoint());
  QEnterEvent event(local, pointer.at, pointer.on->mapToGlobal(pointer.at));
  deliver(*under, event);
  if (takesPresses(*under)) {
    ++pointer.ticks;
    m_ticked = true;
  }
}

/// By the headset's clock: on a busy machine the window hears of two presses later, and later apart.
void VrPanels::press(Pointer& pointer, double seconds) {
  const bool twice = pointer.pressedSince && std::abs(seconds - *pointer.pressedSince) < kTwice &&
                     (pointer.at - pointer.pressedAt).manhattanLength() < kTwiceReach;
  pointer.pressed = m_touched = true;
  if (m_popup && m_popup->isVisible() && pointer.on != m_popup) {
    m_popup->close();  // as a press beside a menu does
    return;
  }
  pointer.grabs = pointer.under;
  pointer.pressedAt = pointer.at;
  pointer.pressedSince = twice ? std::nullopt : std::optional(seconds);
  if (pointer.grabs)
    send(pointer, *pointer.grabs, twice ? QEvent::MouseButtonDblClick : QEvent::MouseButtonPress, Qt::LeftButton);
}

void VrPanels::release(Pointer& pointer) {
  pointer.pressed = false;
  m_touched = true;
  const QPointer<QWidget> held = std::exchange(pointer.grabs, nullptr);
  if (held) send(pointer, *held, QEvent::MouseButtonRelease, Qt::LeftButton);
}

/// As the mouse's right button does: of what is there, or of what that lies on.
void VrPanels::openMenu(Pointer& pointer) {
  if (!pointer.under || pointer.pressed) return;
  m_touched = true;
  QContextMenuEvent event(QContextMenuEvent::Mouse, pointer.under->mapFrom(pointer.on, pointer.at.toPoint()),
                          pointer.on->mapToGlobal(pointer.at).toPoint());
  deliver(*pointer.under, event);
}

/// As a wheel: a notch forward where the stick is pushed forward.
void VrPanels::scroll(Pointer& pointer, double way, double seconds) {
  if (!pointer.under || (seconds < pointer.scrolled + kScroll && seconds >= pointer.scrolled)) return;
  pointer.scrolled = seconds;
  m_touched = true;
  // To whoever takes it: Qt hands on only what the system sends.
  const QPointer<QWidget> on = pointer.on;
  for (QPointer<QWidget> one = pointer.under; one && on; one = one == on ? nullptr : one->parentWidget()) {
    QWheelEvent wheel(one->mapFrom(on, pointer.at.toPoint()), on->mapToGlobal(pointer.at), {},
                      {0, way > 0 ? kNotch : -kNotch}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
    wheel.ignore();
    deliver(*one, wheel);
    if (wheel.isAccepted()) return;
  }
}

void VrPanels::send(const Pointer& pointer, QWidget& target, int type, Qt::MouseButton button) {
  if (!pointer.on || (&target != pointer.on && !pointer.on->isAncestorOf(&target))) return;
  const QPointF origin = target.mapTo(pointer.on, QPoint(0, 0));
  const Qt::MouseButtons held = pointer.grabs ? Qt::LeftButton : Qt::NoButton;
  QMouseEvent event(static_cast<QEvent::Type>(type), pointer.at - origin, pointer.at,
                    pointer.on->mapToGlobal(pointer.at), button, held, Qt::NoModifier, &handDevice());
  const Pointer* before = std::exchange(m_sends, &pointer);
  deliver(target, event);
  m_sends = before;
}

void VrPanels::deliver(QWidget& target, QEvent& event) {
  QWidget* before = QApplication::activePopupWidget();
  if (const size_t on = panelOf(target); !before && on != vr::kPanels) m_popupOn = on;
  ++m_delivering;
  QApplication::sendEvent(&target, &event);
  --m_delivering;
  if (QWidget* popup = QApplication::activePopupWidget(); popup && popup != before) m_popup = popup;
}

}  // namespace ps
