// SPDX-License-Identifier: Apache-2.0
#include "ui/viewport/strokeplane.h"

#include "core/sketch/drawingplane.h"

#include <cmath>

namespace ps {

StrokePlane strokePlaneThrough(const Vec3& point, const Vec3& view) {
  const DrawingPlane plane = drawingPlaneFor(point, view);
  Vec3 n = plane.normal;
  const double length = std::hypot(n[0], n[1], n[2]);
  const double sign = n[0] * view[0] + n[1] * view[1] + n[2] * view[2] > 0 ? -1 : 1;
  for (double& c : n) c *= sign / length;
  return {plane.point, n};
}

std::optional<Vec3> meetStrokePlane(const StrokePlane& plane, const Vec3& origin, const Vec3& direction) {
  return meet({origin, direction}, {plane.point, plane.normal}, 100);
}

}  // namespace ps
