// SPDX-License-Identifier: Apache-2.0
// Mouse of the viewport: orbit, pan, zoom, dolly, select, draw.
#include "core/simulation/engine.h"
#include "ui/document/document.h"
#include "ui/viewport/viewport.h"

#include <QtGui/QMouseEvent>
#include <QtGui/QWheelEvent>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {
constexpr double kClick = 4;  // pixels that a click may wander
constexpr double kNotch = 120;
constexpr double kEnd = 9;  // pixels around an end of the legend that take hold of it
}  // namespace

Viewport::Drag Viewport::dragFor(const QMouseEvent& event) const {
  const bool shift = event.modifiers() & Qt::ShiftModifier, alt = event.modifiers() & Qt::AltModifier;
  const bool drawing = draws(m_tool) || places(m_tool);
  if (event.button() == Qt::RightButton) return Drag::Dolly;
  if (event.button() == Qt::MiddleButton) return drawing && !shift ? Drag::Orbit : Drag::Pan;
  if (event.button() != Qt::LeftButton) return Drag::None;
  if (drawing) return alt ? Drag::Orbit : places(m_tool) ? Drag::Place : Drag::Stroke;
  return shift ? Drag::Pan : Drag::Click;
}

void Viewport::mousePressEvent(QMouseEvent* event) {
  setFocus(Qt::MouseFocusReason);
  if (m_drag != Drag::None) return;  // a second button changes nothing
  m_pressed = m_last = event->position();
  m_before = m_navigator.camera();
  m_legendBefore = m_legendRange;
  if (event->button() == Qt::LeftButton && clickOverlay(event->position())) return;
  if (event->button() == Qt::LeftButton && m_tool == ViewTool::Select && takePort(event->position())) return;
  m_drag = dragFor(*event);
  if (m_drag == Drag::Stroke) beginStroke(*event);
  if (m_drag == Drag::Place) updatePlacing(event->position());
}

void Viewport::mouseMoveEvent(QMouseEvent* event) {
  const QPointF position = event->position(), step = position - m_last;
  m_last = position;
  if (m_drag == Drag::Click) {
    const QPointF way = position - m_pressed;
    if (std::max(std::abs(way.x()), std::abs(way.y())) < kClick) return;
    m_drag = Drag::Orbit;
    m_navigator.orbitBy(way);
  } else if (m_drag == Drag::Orbit) {
    m_navigator.orbitBy(step);
  } else if (m_drag == Drag::Pan) {
    m_navigator.panBy(step);
  } else if (m_drag == Drag::Dolly) {
    m_navigator.dollyBy(step.y());
  } else if (m_drag == Drag::LegendHigh || m_drag == Drag::LegendLow) {
    m_legendRange = m_legendBefore;
    m_legendRange.moveEnd(m_drag == Drag::LegendHigh, (m_pressed.y() - position.y()) / m_hits.legendBar.height());
  } else if (m_drag == Drag::Place) {
    updatePlacing(position);
  } else if (m_drag == Drag::Port) {
    dragPort(position, event->modifiers());
  } else if (m_drag == Drag::Stroke) {
    const auto point = strokePoint(position);
    if (!point) return;
    if (m_cursor) m_cursor->centre = *point;
    const QString problem = m_stroke.move(*point, static_cast<double>(m_strokeClock.elapsed()) / 1000);
    if (!problem.isEmpty()) {
      m_drag = Drag::None;
      m_stroke.finish();  // as far as it came
      Q_EMIT strokeRefused(problem);
    }
  } else {
    const std::optional<Port> hovered = m_hoveredPort;
    updatePointer(position);
    if (m_tool == ViewTool::Select && hovered == m_hoveredPort) return;
    if (draws(m_tool)) updateCursor(position, event->modifiers());
    if (places(m_tool)) updatePlacing(position);
  }
  requestPaint();
}

void Viewport::mouseReleaseEvent(QMouseEvent* event) {
  const Drag drag = m_drag;
  if (drag == Drag::None) return;
  m_drag = Drag::None;
  const QPointF way = event->position() - m_pressed;
  const bool still = std::max(std::abs(way.x()), std::abs(way.y())) < kClick;
  if (drag == Drag::Click) {
    pick(event->position());
  } else if (drag == Drag::Stroke) {
    m_stroke.finish();
  } else if (drag == Drag::Place) {
    finishPlacing();
  } else if (drag == Drag::Port) {
    endPortDrag(true);
  } else if (drag == Drag::Dolly && still) {
    Q_EMIT viewMenuRequested(event->globalPosition().toPoint());
  } else if (drag == Drag::Orbit || drag == Drag::Pan || drag == Drag::Dolly) {
    storeView();
  }
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

Viewport::Drag Viewport::legendEndAt(const QPointF& position) const {
  const QRectF& legend = m_hits.legend;
  const QRectF& bar = m_hits.legendBar;
  if (bar.isEmpty() || position.x() < legend.left() || position.x() > legend.right()) return Drag::None;
  if (std::abs(position.y() - bar.top()) < kEnd) return Drag::LegendHigh;
  return std::abs(position.y() - bar.bottom()) < kEnd ? Drag::LegendLow : Drag::None;
}

/// The shape of the pointer; while drawing, the brush itself is the pointer.
void Viewport::updatePointer(const QPointF& position) {
  m_hoveredPort.reset();
  const auto handle = m_tool == ViewTool::Select && !m_hits.legend.contains(position) ? portHandleAt(position)
                                                                                      : std::optional<PortHandle>();
  if (handle) m_hoveredPort = handle->port;
  if (legendEndAt(position) != Drag::None) {
    setCursor(Qt::SizeVerCursor);
  } else if (handle) {
    setCursor(handle->part == PortHandle::Part::Whole ? Qt::SizeAllCursor : Qt::PointingHandCursor);
  } else if (places(m_tool)) {
    setCursor(Qt::CrossCursor);
  } else if (m_tool == ViewTool::Select || m_hits.legend.contains(position)) {
    setCursor(Qt::ArrowCursor);
  } else {
    setCursor(Qt::BlankCursor);
  }
}

void Viewport::wheelEvent(QWheelEvent* event) {
  m_navigator.zoomAt(event->position(), event->angleDelta().y() / kNotch);
  storeView();
  if (draws(m_tool)) updateCursor(event->position(), event->modifiers());
  if (places(m_tool)) updatePlacing(event->position());
  requestPaint();
  event->accept();
}

void Viewport::leaveEvent(QEvent* event) {
  QOpenGLWidget::leaveEvent(event);
  if (m_drag == Drag::None) {
    m_cursor.reset();
    m_placing = {};
    m_hoveredPort.reset();
  }
  update();
}

bool Viewport::cancelGesture() {
  const bool busy = m_drag != Drag::None || m_stroke.active();
  if (m_drag == Drag::Orbit || m_drag == Drag::Pan || m_drag == Drag::Dolly) m_navigator.restore(m_before);
  if (m_drag == Drag::LegendHigh || m_drag == Drag::LegendLow) m_legendRange = m_legendBefore;
  if (m_drag == Drag::Place) m_placing = {};
  if (m_drag == Drag::Port) endPortDrag(false);
  m_stroke.cancel();
  m_drag = Drag::None;
  update();
  return busy;
}

bool Viewport::clickOverlay(const QPointF& position) {
  if (m_hint && m_hits.hintClose.contains(position)) {
    setHintShown(false);
    return true;
  }
  if (m_hits.legend.contains(position)) {
    m_drag = legendEndAt(position);
    return true;
  }
  for (const OverlayHits::Axis& axis : m_hits.axes) {
    if (!axis.rect.contains(position)) continue;
    m_navigator.look(axis.azimuth, axis.elevation);
    storeView();
    update();
    return true;
  }
  return false;
}

void Viewport::pick(const QPointF& position) {
  std::string id;
  m_tagged.reset();
  if (m_now) {
    const auto hit = pickParticle(*m_now, m_navigator.camera(), width(), height(), position.x(), position.y());
    if (hit) {
      const uint32_t body = m_now->body[*hit];
      if (m_now->bodyIds && body < m_now->bodyIds->size()) id = (*m_now->bodyIds)[body];
      m_tagged = {m_now->revision, m_now->id[*hit]};
    }
  }
  if (m_document && m_document->emitter(id)) {
    announce();
    Q_EMIT portPicked({false, id});
    return;
  }
  m_selectedBody = id;
  m_selectedPort.reset();
  announce();
  Q_EMIT bodyPicked(id);
}

double Viewport::floorHeight() const {
  double height = m_scene.environment.boundsMinimum[1];
  for (const SceneWall& wall : m_scene.environment.walls) {
    if (wall.normal.y() > 0.9 * wall.normal.norm()) height = std::max(height, wall.point[1]);
  }
  return height;
}

std::optional<Viewport::Surface> Viewport::surfaceAt(const QPointF& position) const {
  const Camera& camera = m_navigator.camera();
  const Ray ray = rayAt(position);
  if (m_now) {
    if (const auto hit = pickParticle(*m_now, camera, width(), height(), position.x(), position.y())) {
      const api::Float4& p = m_now->position[*hit];
      const double along = (vectorOf(p) - ray.origin).dot(ray.direction) - static_cast<double>(p.w);
      const Vector3 point = ray.origin + along * ray.direction;
      return Surface{point, normalAt(point)};
    }
  }
  const Environment& e = m_scene.environment;
  auto floor = meetPlane(ray, {0, floorHeight(), 0}, {0, 1, 0});
  const auto within = [&](size_t axis) {
    return (*floor)[axis] >= e.boundsMinimum[axis] && (*floor)[axis] <= e.boundsMaximum[axis];
  };
  if (floor && within(0) && within(2)) return Surface{*floor, {0, 1, 0}};
  const auto air = meetPlane(ray, camera.target, frameOf(camera).forward);  // at the depth one looks at
  return air ? std::optional(Surface{*air, {0, 0, 0}}) : std::nullopt;
}

Vector3 Viewport::brushExtent() const { return m_stroke.extent(m_brush); }

void Viewport::updateCursor(const QPointF& position, Qt::KeyboardModifiers modifiers) {
  const auto surface = surfaceAt(position);
  if (!surface) {
    m_cursor.reset();
    return;
  }
  BrushCursor cursor;
  cursor.extent = brushExtent();
  cursor.box = m_brush.shape == "cube";
  cursor.erase = (m_tool == ViewTool::Erase) != bool(modifiers & Qt::ControlModifier);
  cursor.floor = floorHeight();
  const CameraFrame frame = frameOf(m_navigator.camera());
  m_strokePlane = drawingPlaneFor(surface->point, frame.forward);
  cursor.centre = surface->point;
  if (!cursor.erase) {
    // A brush stands on the surface instead of half inside it.
    cursor.centre += m_strokePlane.normal.cwiseProduct(cursor.extent);
    m_strokePlane.point = cursor.centre;
  }
  m_cursor = cursor;
}

void Viewport::beginStroke(const QMouseEvent& event) {
  updateCursor(event.position(), event.modifiers());
  if (!m_cursor) {
    m_drag = Drag::None;
    return;
  }
  m_strokeClock.start();
  static const Snapshot kNothing;
  const QString problem = m_stroke.begin(m_brush, m_cursor->erase, m_now ? *m_now : kNothing, m_cursor->centre);
  if (!problem.isEmpty()) {
    m_stroke.cancel();
    m_drag = Drag::None;
    Q_EMIT strokeRefused(problem);
  }
}

/// While a stroke is drawn it stays on the plane on which it began; along a ray that misses it, nothing is drawn.
std::optional<Vector3> Viewport::strokePoint(const QPointF& position) {
  const Ray ray = rayAt(position);
  auto point = meet(ray, m_strokePlane, 100);
  if (!point) return point;
  const Environment& e = m_scene.environment;
  for (size_t i = 0; i < 3; ++i) {
    if ((*point)[i] < e.boundsMinimum[i] - m_brush.radius || (*point)[i] > e.boundsMaximum[i] + m_brush.radius)
      return std::nullopt;
  }
  return point;
}

}  // namespace ps
