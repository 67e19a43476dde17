// SPDX-License-Identifier: Apache-2.0
#include "core/sketch/drawingplane.h"

#include <cmath>

namespace ps {
namespace {

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vec3& v) { return std::sqrt(dot(v, v)); }

}  // namespace

std::optional<Vec3> meet(const Ray& ray, const DrawingPlane& plane, double reach) {
  const double directionLength = length(ray.direction);
  const double approach = dot(ray.direction, plane.normal);
  constexpr double kGrazing = 1e-3;  // sine of the smallest angle between ray and plane
  if (!(std::abs(approach) > kGrazing * directionLength * length(plane.normal))) return std::nullopt;
  const Vec3 toPlane{plane.point[0] - ray.origin[0], plane.point[1] - ray.origin[1], plane.point[2] - ray.origin[2]};
  const double t = dot(toPlane, plane.normal) / approach;
  if (!(t >= 0) || t * directionLength > reach) return std::nullopt;
  return Vec3{ray.origin[0] + t * ray.direction[0], ray.origin[1] + t * ray.direction[1],
              ray.origin[2] + t * ray.direction[2]};
}

DrawingPlane drawingPlaneFor(const Vec3& point, const Vec3& viewDirection) {
  constexpr double kSine15Degrees = 0.25881904510252074;
  size_t axis = std::abs(viewDirection[0]) > std::abs(viewDirection[2]) ? 0 : 2;
  if (std::abs(viewDirection[1]) > kSine15Degrees * length(viewDirection)) axis = 1;
  DrawingPlane plane{point, {0, 0, 0}};
  plane.normal[axis] = viewDirection[axis] > 0 ? -1 : 1;
  return plane;
}

}  // namespace ps
