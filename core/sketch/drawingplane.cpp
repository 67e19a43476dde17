// SPDX-License-Identifier: Apache-2.0
#include "core/sketch/drawingplane.h"

#include <cmath>

namespace ps {

std::optional<Vector3> meet(const Ray& ray, const DrawingPlane& plane, double reach) {
  const double directionLength = ray.direction.norm();
  const double approach = ray.direction.dot(plane.normal);
  constexpr double kGrazing = 1e-3;  // sine of the smallest angle between ray and plane
  if (!(std::abs(approach) > kGrazing * directionLength * plane.normal.norm())) return std::nullopt;
  const double t = (plane.point - ray.origin).dot(plane.normal) / approach;
  if (!(t >= 0) || t * directionLength > reach) return std::nullopt;
  Vector3 place = ray.origin + t * ray.direction;
  // On a plane across an axis exactly: it may lie on faces of cells, and one of both sides is meant.
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (std::abs(plane.normal[axis]) == plane.normal.norm()) place[axis] = plane.point[axis];
  }
  return place;
}

DrawingPlane drawingPlaneFor(const Vector3& point, const Vector3& viewDirection) {
  constexpr double kSine15Degrees = 0.25881904510252074;
  size_t axis = std::abs(viewDirection[0]) > std::abs(viewDirection[2]) ? 0 : 2;
  if (std::abs(viewDirection[1]) > kSine15Degrees * viewDirection.norm()) axis = 1;
  DrawingPlane plane{point, {0, 0, 0}};
  plane.normal[axis] = viewDirection[axis] > 0 ? -1 : 1;
  return plane;
}

}  // namespace ps
