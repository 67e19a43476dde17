// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/placedrain.h"

#include "core/sketch/drawingplane.h"
#include "ui/session/selection.h"
#include "ui/tools/tooltable.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {
constexpr double kHalfDrain = 5;  // spacings
}

Sink PlaceDrain::at(const Surface& surface, const Pointer* pressed, const Pointer& pointer) const {
  double half = kHalfDrain * shownSpacing(pointer, box().spacing());
  if (pressed) {
    const DrawingPlane plane = drawingPlaneFor(surface.point, pressed->forward);
    const auto from = meet(pressed->ray, plane), to = meet(pointer.ray, plane);
    if (from && to) half = std::max(half, (*to - *from).cwiseAbs().maxCoeff());
  }
  Sink drain;
  const Vector3 centre = surface.point + half * surface.normal;
  drain.minimum = centre - Vector3::Constant(half);
  drain.maximum = centre + Vector3::Constant(half);
  return drain;
}

void PlaceDrain::put(Sink drain) {
  const Port port = box().document().addSink(std::move(drain));
  box().activate(kSelectTool);
  box().selection().select(port);
}

ToolPicture PlaceDrain::picture() const {
  ToolPicture picture;
  picture.pointer = PointerShape::Cross;
  if (preview()) picture.sinks.push_back(*preview());
  return picture;
}

std::vector<Gesture> PlaceDrain::gestures() const {
  return {{QStringLiteral("Click"), QStringLiteral("A drain that stands on the surface"),
           QStringLiteral("drain on the surface")},
          {QStringLiteral("Drag"), QStringLiteral("A wider drain"), QStringLiteral("wider")}};
}

}  // namespace ps
