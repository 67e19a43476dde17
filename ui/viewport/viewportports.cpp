// SPDX-License-Identifier: Apache-2.0
// Emitters and sinks in the view: placed, picked, dragged.
#include "core/sketch/drawingplane.h"
#include "ui/document/document.h"
#include "ui/viewport/viewport.h"

#include <QtGui/QPainter>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kClick = 4;        // pixels that a click may wander
constexpr double kMouth = 4;        // spacings, diameter of a new mouth
constexpr double kHalfDrain = 5;    // spacings
constexpr double kNear = 2.5;       // spacings, of the particles that make a surface
constexpr double kAlongAxis = 0.9;  // cosine from which a surface's normal counts as an axis
constexpr const char* kPreview = "?";

/// Upright, facing the camera.
DrawingPlane uprightThrough(const Vector3& point, const Vector3& forward) {
  const double length = std::hypot(forward[0], forward[2]);
  return {point, length > 1e-6 ? Vector3{-forward.x(), 0, -forward.z()} : Vector3{0, 0, 1}};
}

}  // namespace

Ray Viewport::rayAt(const QPointF& position) const {
  return rayThrough(m_navigator.camera(), width(), height(), position.x(), position.y());
}

double Viewport::spacing() const {
  if (m_now && m_now->spacing > 0) return m_now->spacing;
  return numberOf(m_document->project().solver.parameters, solverParameters(), "particle_spacing");
}

/// Away from the matter around a point of its surface; along an axis where it nearly is.
Vector3 Viewport::normalAt(const Vector3& point) const {
  const double reach = kNear * m_now->spacing;
  Vector3 sum;
  for (const api::Float4& p : m_now->position) {
    const Vector3 off = point - Vector3{p.x, p.y, p.z};
    if (off.norm() < reach) sum += off;
  }
  if (!(sum.norm() > 0)) return Vector3::UnitY();
  sum.normalize();
  for (size_t a = 0; a < 3; ++a) {
    if (std::abs(sum[a]) < kAlongAxis) continue;
    Vector3 axis{0, 0, 0};
    axis[a] = sum[a] > 0 ? 1 : -1;
    return axis;
  }
  return sum;
}

PortView Viewport::portView() const {
  PortView view;
  if (m_document) view.emitters = &m_document->project().emitters, view.sinks = &m_document->project().sinks;
  view.camera = m_navigator.camera();
  view.size = size();
  view.selected = m_selectedPort;
  view.hovered = m_hoveredPort;
  return view;
}

void Viewport::paintPortsOver(QPainter& painter) const {
  painter.setRenderHint(QPainter::Antialiasing);
  PortView view = portView();
  paintPorts(painter, view);
  std::vector<Emitter> emitters;
  std::vector<Sink> sinks;
  if (const auto* tap = std::get_if<Emitter>(&m_placing)) emitters.push_back(*tap);
  if (const auto* drain = std::get_if<Sink>(&m_placing)) sinks.push_back(*drain);
  if (emitters.empty() && sinks.empty()) return;
  view.emitters = &emitters, view.sinks = &sinks;
  view.selected.reset();
  view.hovered = Port{emitters.empty(), kPreview};
  paintPorts(painter, view);
}

std::optional<PortHandle> Viewport::portHandleAt(const QPointF& position) const {
  return handleAt(portView(), position);
}

void Viewport::setSelectedPort(const std::optional<Port>& port) {
  m_selectedPort = port;
  update();
  announce();
}

std::optional<std::pair<Vector3, Vector3>> Viewport::boxAround(const Port& port) const {
  if (!m_document) return std::nullopt;
  if (const Sink* sink = port.sink ? m_document->sink(port.id) : nullptr)
    return std::pair(sink->minimum, sink->maximum);
  const Emitter* emitter = port.sink ? nullptr : m_document->emitter(port.id);
  if (!emitter) return std::nullopt;
  const double reach = 3 * numberOf(emitter->parameters, emitterParameters(), "diameter");
  return std::pair<Vector3, Vector3>(emitter->point.array() - reach, emitter->point.array() + reach);
}

void Viewport::updatePlacing(const QPointF& position) {
  if (!m_document) return;
  if (m_drag != Drag::Place) m_pressed = position;
  if (m_drag != Drag::Place || !m_placeSurface || position == m_pressed) m_placeSurface = surfaceAt(position);
  m_placing = {};
  if (!m_placeSurface) return;
  if (m_tool == ViewTool::Tap) {
    m_placing = tapAt(position);
  } else {
    m_placing = drainAt(position);
  }
}

/// On the surface, pouring away from it; dragged up, or in the air, it pours down.
Emitter Viewport::tapAt(const QPointF& position) const {
  Emitter tap;
  tap.id = kPreview;
  tap.parameters.values["diameter"] = std::clamp(kMouth * spacing(), 1e-4, 10.0);
  tap.parameters.values["temperature"] = m_brush.temperature;
  // Half a spacing off the surface, where the first particle has room.
  tap.point = m_placeSurface->point + 0.5 * spacing() * m_placeSurface->normal;
  if (m_placeSurface->normal != Vector3{0, 0, 0}) tap.direction = m_placeSurface->normal;
  if (m_pressed.y() - position.y() < kClick) return tap;
  const DrawingPlane plane = uprightThrough(m_placeSurface->point, frameOf(m_navigator.camera()).forward);
  const auto from = meet(rayAt(m_pressed), plane), to = meet(rayAt(position), plane);
  if (!from || !to || !((*to)[1] > (*from)[1])) return tap;
  tap.point = m_placeSurface->point + (to->y() - from->y()) * Vector3::UnitY();
  tap.direction = {0, -1, 0};
  return tap;
}

/// Standing on the surface; a drag makes it wider.
Sink Viewport::drainAt(const QPointF& position) const {
  double half = kHalfDrain * spacing();
  const DrawingPlane plane = drawingPlaneFor(m_placeSurface->point, frameOf(m_navigator.camera()).forward);
  const auto from = meet(rayAt(m_pressed), plane), to = meet(rayAt(position), plane);
  if (m_drag == Drag::Place && from && to) {
    half = std::max(half, (*to - *from).cwiseAbs().maxCoeff());
  }
  Sink drain;
  drain.id = kPreview;
  const Vector3 centre = m_placeSurface->point + half * m_placeSurface->normal;
  drain.minimum = centre.array() - half;
  drain.maximum = centre.array() + half;
  return drain;
}

void Viewport::finishPlacing() {
  const auto placing = std::exchange(m_placing, {});
  if (!m_document) return;
  std::optional<Port> port;
  if (const auto* drain = std::get_if<Sink>(&placing)) {
    Sink sink = *drain;
    sink.id.clear();
    port = m_document->addSink(std::move(sink));
  } else if (const auto* tap = std::get_if<Emitter>(&placing)) {
    const std::vector<SceneMaterial>& materials = m_document->project().materials;
    if (materials.empty()) {
      Q_EMIT placingRefused(
          QStringLiteral("The scene has no material that a tap could pour. Add one under Materials."));
      return;
    }
    const bool known = std::any_of(materials.begin(), materials.end(),
                                   [&](const SceneMaterial& m) { return m.id == m_brush.material; });
    Emitter emitter = *tap;
    emitter.id.clear();
    emitter.material = known ? m_brush.material : materials.front().id;
    port = m_document->addEmitter(std::move(emitter));
  }
  if (!port) return;
  setTool(ViewTool::Select);
  Q_EMIT portPicked(*port);
}

bool Viewport::takePort(const QPointF& position) {
  const auto handle = portHandleAt(position);
  if (!handle || !m_document) return false;
  m_grip = Grip{*handle, Emitter{}, false};
  if (handle->port.sink) {
    m_grip->before = *m_document->sink(handle->port.id);
  } else {
    m_grip->before = *m_document->emitter(handle->port.id);
  }
  m_drag = Drag::Port;
  m_document->beginGesture();
  if (m_selectedPort != handle->port) Q_EMIT portPicked(handle->port);
  return true;
}

/// A whole one moves on the plane that one would draw on, with Shift up and down; tips and corners move across the
/// view.
void Viewport::dragPort(const QPointF& position, Qt::KeyboardModifiers modifiers) {
  const QPointF way = position - m_pressed;
  if (!m_grip || (!m_grip->moved && std::max(std::abs(way.x()), std::abs(way.y())) < kClick)) return;
  m_grip->moved = true;
  const PortHandle& handle = m_grip->handle;
  const Vector3 forward = frameOf(m_navigator.camera()).forward;
  const bool whole = handle.part == PortHandle::Part::Whole, upright = whole && (modifiers & Qt::ShiftModifier);
  const DrawingPlane plane = upright ? uprightThrough(handle.place, forward)
                             : whole ? drawingPlaneFor(handle.place, forward)
                                     : DrawingPlane{handle.place, forward};
  const auto from = meet(rayAt(m_pressed), plane), to = meet(rayAt(position), plane);
  if (!from || !to) return;
  Vector3 target = handle.place + (*to - *from);
  if (upright) target = {handle.place[0], target[1], handle.place[2]};
  const QString title = (whole                                     ? QStringLiteral("moving %1")
                         : handle.part == PortHandle::Part::Corner ? QStringLiteral("size of %1")
                                                                   : QStringLiteral("direction of %1"))
                            .arg(m_document->portName(handle.port));
  if (const auto* emitter = std::get_if<Emitter>(&m_grip->before)) {
    m_document->editEmitter(dragged(*emitter, handle, target), title);
  } else {
    m_document->editSink(dragged(std::get<Sink>(m_grip->before), handle, target, spacing()), title);
  }
}

void Viewport::endPortDrag(bool keep) {
  if (!m_grip) return;
  const Grip grip = *std::exchange(m_grip, {});
  if (!keep && grip.moved) {
    if (const auto* emitter = std::get_if<Emitter>(&grip.before)) {
      m_document->editEmitter(*emitter, {});
    } else {
      m_document->editSink(std::get<Sink>(grip.before), {});
    }
  }
  m_document->endGesture();
}

}  // namespace ps
