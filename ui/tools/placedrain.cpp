// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/placedrain.h"

#include "core/sketch/drawingplane.h"
#include "ui/document/document.h"
#include "ui/session/selection.h"
#include "ui/tools/aim.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {
constexpr double kHalfDrain = 5;  // spacings
}

void PlaceDrain::hover(const Pointer& pointer) {
  m_surface = surfaceUnder(pointer, box().document().project().environment);
  update(pointer);
}

bool PlaceDrain::press(const Pointer& pointer) {
  hover(pointer);
  m_pressed = pointer;
  m_pressed->scene = nullptr;  // lives no longer than this call
  return true;
}

void PlaceDrain::drag(const Pointer& pointer) { update(pointer); }

void PlaceDrain::update(const Pointer& pointer) {
  m_drain.reset();
  if (!m_surface) return;
  double half = kHalfDrain * shownSpacing(pointer, box().spacing());
  if (m_pressed) {
    const DrawingPlane plane = drawingPlaneFor(m_surface->point, m_pressed->forward);
    const auto from = meet(m_pressed->ray, plane), to = meet(pointer.ray, plane);
    if (from && to) half = std::max(half, (*to - *from).cwiseAbs().maxCoeff());
  }
  Sink drain;
  drain.id = kPreviewId;
  const Vector3 centre = m_surface->point + half * m_surface->normal;
  drain.minimum = centre - Vector3::Constant(half);
  drain.maximum = centre + Vector3::Constant(half);
  m_drain = drain;
}

void PlaceDrain::release(const Pointer& pointer) {
  update(pointer);
  m_pressed.reset();
  if (!m_drain) return;
  Sink drain = *std::exchange(m_drain, {});
  drain.id.clear();
  const Port port = box().document().addSink(std::move(drain));
  box().activate(kSelectTool);
  box().selection().select(port);
}

bool PlaceDrain::cancel() {
  m_drain.reset();
  return std::exchange(m_pressed, {}).has_value();
}

ToolPicture PlaceDrain::picture() const {
  ToolPicture picture;
  picture.pointer = PointerShape::Cross;
  if (m_drain) picture.sinks.push_back(*m_drain);
  return picture;
}

std::vector<Gesture> PlaceDrain::gestures() const {
  return {{QStringLiteral("Click"), QStringLiteral("A drain that stands on the surface"),
           QStringLiteral("drain on the surface")},
          {QStringLiteral("Drag"), QStringLiteral("A wider drain"), QStringLiteral("wider")}};
}

}  // namespace ps
