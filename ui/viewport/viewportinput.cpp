// SPDX-License-Identifier: Apache-2.0
// Mouse and pen of the viewport: what they mean for the view, and what goes to the tool in hand.
#include "ui/document/document.h"
#include "ui/session/selection.h"
#include "ui/tools/toolbox.h"
#include "ui/viewport/viewport.h"

#include <QtGui/QMouseEvent>
#include <QtGui/QTabletEvent>
#include <QtGui/QWheelEvent>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

constexpr double kClick = 4;  // pixels that a click may wander
constexpr double kNotch = 120;
constexpr double kEnd = 9;    // pixels around an end of the legend that take hold of it
constexpr qint64 kPen = 200;  // ms after its last word from which it is the mouse that points
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kFlat = 85 * kDegree;  // farthest that a pen leans
constexpr double kOctave = 120;         // pixels for a brush of twice the size

bool isClick(const QPointF& way) { return std::max(std::abs(way.x()), std::abs(way.y())) < kClick; }

Qt::CursorShape cursorFor(PointerShape shape) {
  switch (shape) {
    case PointerShape::Cross:
      return Qt::CrossCursor;
    case PointerShape::Hidden:
      return Qt::BlankCursor;
    case PointerShape::Move:
      return Qt::SizeAllCursor;
    case PointerShape::Take:
      return Qt::PointingHandCursor;
    case PointerShape::Arrow:
      break;
  }
  return Qt::ArrowCursor;
}

}  // namespace

Pointer Viewport::pointerNow() const {
  const QPoint mouse = mapFromGlobal(QCursor::pos());
  return pointerAt(rect().contains(mouse) ? mouse : rect().center(), {});
}

Pointer Viewport::pointerAt(const QPointF& position, Qt::KeyboardModifiers modifiers) const {
  const Camera& camera = m_navigator.camera();
  Pointer pointer;
  pointer.ray = rayThrough(camera, width(), height(), position.x(), position.y());
  pointer.forward = frameOf(camera).forward;
  pointer.target = camera.target;
  pointer.fineness = pixelSize(camera, height(), 1);
  if (m_pen.since.isValid() && m_pen.since.elapsed() < kPen) {
    pointer.pressure = m_pen.pressure;
    pointer.eraser = m_pen.eraser;
    pointer.twist = m_pen.twist;
    pointer.lean = leanIn(frameOf(camera));
  }
  pointer.seconds = static_cast<double>(m_clock.elapsed()) / 1000;
  pointer.shift = modifiers & Qt::ShiftModifier;
  pointer.control = modifiers & Qt::ControlModifier;
  pointer.alt = modifiers & Qt::AltModifier;
  pointer.scene = m_now;
  pointer.section = section();
  return pointer;
}

std::optional<PortHandle> Viewport::portHandleAt(const QPointF& position) const {
  const Project& project = m_document.project();
  const Pointer pointer = pointerAt(position, {});
  return handleAt({&project.emitters, &project.sinks, m_selection.port(), pointer.section}, pointer);
}

/// What a drag does to the view, whatever tool is in hand.
std::optional<MouseBinding> Viewport::bindingOf(Qt::MouseButton button, Qt::KeyboardModifiers held) const {
  return bindingFor(m_tools.mouse(), !m_tools.tool().turnsView(), button, held);
}

void Viewport::mousePressEvent(QMouseEvent* event) {
  setFocus(Qt::MouseFocusReason);
  if (m_drag != Drag::None) return;  // a second button changes nothing
  m_pressed = event->position();
  m_legendBefore = m_legendRange;
  const bool left = event->button() == Qt::LeftButton;
  if (left && clickOverlay(m_pressed)) return;
  if (beginSize(*event)) return;
  const auto binding = bindingOf(event->button(), event->modifiers());
  const bool plainLeft = left && (!binding || !binding->keys);  // may become a click
  // A handle is taken hold of with Shift too, which then moves it up and down. Alt and the left button are the view's.
  const bool viewFirst = binding && (binding->keys & Qt::AltModifier);
  if (left && !viewFirst && m_tools.tool().press(pointerAt(m_pressed, event->modifiers()))) {
    m_drag = Drag::Tool;
  } else if (plainLeft) {
    m_drag = Drag::Click;
  } else if (binding) {
    m_drag = Drag::View;
    m_navigation.press(binding->motion, m_pressed);
  } else if (event->button() == Qt::RightButton) {
    m_drag = Drag::Menu;
  }
  update();
}

/// The brush stays where it is, and its outline shows how large it becomes.
bool Viewport::beginSize(const QMouseEvent& event) {
  const SizeDrag drag = sizeDrag(m_tools.mouse());
  if (!m_tools.tool().usesBrush() || event.button() != drag.button || event.modifiers() != drag.keys) return false;
  m_drag = Drag::Size;
  m_sizeBefore = m_tools.brushSize();
  hover(m_pressed, {});
  return true;
}

void Viewport::dragSize(double way) {
  m_tools.setBrushSize(m_sizeBefore * std::exp2(way / kOctave));
  hover(m_pressed, {});
}

/// Where the left button alone does not move the view, it frames what is to be selected by a tool that selects.
void Viewport::dragBegins(const QMouseEvent& event) {
  if (const auto binding = bindingFor(m_tools.mouse(), false, Qt::LeftButton, {})) {
    m_drag = Drag::View;
    m_navigation.press(binding->motion, m_pressed);
    m_navigation.drag(event.position());
  } else if (m_tools.tool().turnsView() &&
             m_tools.tool().press(pointerAt(m_pressed, event.modifiers() | Qt::ControlModifier))) {
    m_drag = Drag::Tool;
    m_tools.tool().drag(pointerAt(event.position(), event.modifiers() | Qt::ControlModifier));
  } else {
    m_drag = Drag::None;
  }
}

void Viewport::mouseMoveEvent(QMouseEvent* event) {
  const QPointF position = event->position();
  if (m_drag == Drag::Click) {
    if (isClick(position - m_pressed)) return;
    dragBegins(*event);
  } else if (m_drag == Drag::View) {
    m_navigation.drag(position);
  } else if (m_drag == Drag::LegendHigh || m_drag == Drag::LegendLow) {
    m_legendRange = m_legendBefore;
    m_legendRange.moveEnd(m_drag == Drag::LegendHigh, (m_pressed.y() - position.y()) / m_hits.legendBar.height());
  } else if (m_drag == Drag::Section) {
    dragSection(position);
  } else if (m_drag == Drag::Size) {
    dragSize(position.x() - m_pressed.x());
  } else if (m_drag == Drag::Tool) {
    m_tools.tool().drag(pointerAt(position, event->modifiers()));
  } else {
    hover(position, event->modifiers());
  }
  requestPaint();
}

void Viewport::hover(const QPointF& position, Qt::KeyboardModifiers modifiers) {
  if (m_hits.legend.contains(position) || m_hits.section.strip.contains(position)) {
    m_tools.tool().leave();
  } else {
    m_tools.tool().hover(pointerAt(position, modifiers));
  }
  updatePointer(position);
}

/// What the pointer stands on is another place then.
void Viewport::storeView() {
  ViewState view = m_navigator.view();
  view.section = m_section;
  m_document.setView(view);
  const QPoint at = mapFromGlobal(QCursor::pos());
  if (m_drag == Drag::None && rect().contains(at)) hover(at, {});
}

void Viewport::mouseReleaseEvent(QMouseEvent* event) {
  const Drag drag = m_drag;
  if (drag == Drag::None) return;
  m_drag = Drag::None;
  const bool still = isClick(event->position() - m_pressed);
  const Pointer pointer = pointerAt(event->position(), event->modifiers());
  if (drag == Drag::Click) {
    m_tools.tool().click(pointer);
  } else if (drag == Drag::Tool) {
    m_tools.tool().release(pointer);
  } else if (drag == Drag::Menu) {
    if (still) Q_EMIT viewMenuRequested(event->globalPosition().toPoint());
  } else if (drag == Drag::View) {
    m_navigation.release();
    if (still && event->button() == Qt::RightButton) {
      Q_EMIT viewMenuRequested(event->globalPosition().toPoint());
    } else if (still && event->button() == Qt::LeftButton) {
      m_tools.tool().click(pointer);  // with Shift, which would have moved the view
    } else {
      storeView();
    }
  }
  announce();
  update();
}

void Viewport::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !m_hits.legend.contains(event->position())) {
    mousePressEvent(event);
    return;
  }
  m_legendRange.reset();
  update();
}

/// How hard the pen presses, how it is held, and with which end; where it is comes as the mouse's events, which Qt
/// makes of what is ignored here. What a pen cannot tell is as with a mouse.
void Viewport::tabletEvent(QTabletEvent* event) {
  using Capability = QInputDevice::Capability;
  const auto tells = [&](Capability what) { return event->device()->hasCapability(what); };
  const bool presses = event->type() != QEvent::TabletRelease && tells(Capability::Pressure);
  m_pen.pressure = presses ? event->pressure() : 1;
  m_pen.eraser = event->pointerType() == QPointingDevice::PointerType::Eraser;
  m_pen.tiltX = tells(Capability::XTilt) ? event->xTilt() * kDegree : 0;
  m_pen.tiltY = tells(Capability::YTilt) ? event->yTilt() * kDegree : 0;
  m_pen.twist = tells(Capability::Rotation) ? -event->rotation() * kDegree : 0;
  m_pen.since.start();
  event->ignore();
}

/// The tablet lies as the view: its pen stands upright along the way from the view to whoever looks.
Vector3 Viewport::leanIn(const CameraFrame& frame) const {
  const Vector3 upright = -frame.forward;
  const double x = std::tan(std::clamp(m_pen.tiltX, -kFlat, kFlat)),
               y = std::tan(std::clamp(m_pen.tiltY, -kFlat, kFlat));
  const Vector3 pen = (upright + x * frame.right - y * frame.up).normalized();
  const Vector3 axis = upright.cross(pen);
  const double sine = axis.norm();
  return sine > 0 ? Vector3(std::atan2(sine, upright.dot(pen)) / sine * axis) : Vector3(Vector3::Zero());
}

Viewport::Drag Viewport::legendEndAt(const QPointF& position) const {
  const QRectF& legend = m_hits.legend;
  const QRectF& bar = m_hits.legendBar;
  if (bar.isEmpty() || position.x() < legend.left() || position.x() > legend.right()) return Drag::None;
  if (std::abs(position.y() - bar.top()) < kEnd) return Drag::LegendHigh;
  return std::abs(position.y() - bar.bottom()) < kEnd ? Drag::LegendLow : Drag::None;
}

void Viewport::updatePointer(const QPointF& position) {
  if (legendEndAt(position) != Drag::None) {
    setCursor(Qt::SizeVerCursor);
  } else if (m_hits.section.slider.contains(position)) {
    setCursor(Qt::SizeHorCursor);
  } else if (m_hits.legend.contains(position) || m_hits.section.strip.contains(position)) {
    setCursor(Qt::ArrowCursor);
  } else {
    setCursor(cursorFor(m_tools.tool().picture().pointer));
  }
}

void Viewport::wheelEvent(QWheelEvent* event) {
  m_navigator.zoomAt(event->position(), event->angleDelta().y() / kNotch);
  storeView();
  if (m_drag == Drag::None) hover(event->position(), event->modifiers());
  requestPaint();
  event->accept();
}

/// While something is dragged, digits and the like say how far; other keys stay what they are.
bool Viewport::typeToTool(const QKeyEvent& event, bool asks) {
  if (m_drag != Drag::Tool) return false;
  const bool erase = event.key() == Qt::Key_Backspace;
  const bool enter = event.key() == Qt::Key_Return || event.key() == Qt::Key_Enter;
  const QString text = erase ? QLatin1String(kErase) : enter ? QLatin1String(kEnter) : event.text();
  const bool printed = !text.isEmpty() && text[0].isPrint();
  if (!(printed || erase || enter) || !m_tools.tool().takesText(text)) return false;
  if (asks) return true;
  const bool taken = m_tools.tool().type(text);
  if (enter && !m_tools.tool().takesText(text)) m_drag = Drag::None;  // a number that is none stays
  update();
  announce();
  return taken;
}

void Viewport::keyPressEvent(QKeyEvent* event) {
  if (!typeToTool(*event, false)) QOpenGLWidget::keyPressEvent(event);
}

void Viewport::leaveEvent(QEvent* event) {
  QOpenGLWidget::leaveEvent(event);
  if (m_drag == Drag::None) m_tools.tool().leave();
  update();
}

bool Viewport::cancelGesture() {
  const bool busy = m_drag != Drag::None;
  m_navigation.cancel();
  if (m_drag == Drag::LegendHigh || m_drag == Drag::LegendLow) m_legendRange = m_legendBefore;
  if (m_drag == Drag::Section) setSection(m_sectionBefore);
  if (m_drag == Drag::Size) dragSize(0);
  const bool gave = m_tools.tool().cancel();
  m_drag = Drag::None;
  update();
  return busy || gave;
}

bool Viewport::clickOverlay(const QPointF& position) {
  if (m_overlays.hints && m_hits.hintClose.contains(position)) {
    OverlayChoice less = m_overlays;
    less.hints = false;
    setOverlays(less);
    return true;
  }
  if (m_hits.legend.contains(position)) {
    m_drag = legendEndAt(position);
    return true;
  }
  if (clickSection(position)) return true;
  for (const OverlayHits::Axis& axis : m_hits.axes) {
    if (!axis.rect.contains(position)) continue;
    m_navigator.look(axis.azimuth, axis.elevation);
    storeView();
    update();
    return true;
  }
  return false;
}

}  // namespace ps
