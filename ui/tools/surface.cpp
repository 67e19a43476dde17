// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/surface.h"

#include "core/scene/scenewall.h"
#include "core/sketch/drawingplane.h"
#include "ui/render/camera.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kNear = 2.5, kAround = 5;  // spacings, of the particles that make a surface
constexpr double kAlongAxis = 0.9;          // cosine from which a surface's normal counts as an axis
constexpr double kIsAxis = 0.9986;          // likewise: 3 degrees

/// Away from the matter that is shown around a point of its surface; along an axis where it nearly is. `weight` of a
/// particle by the square of its distance, as a share of the reach.
template <class Weight>
Vector3 normalAt(const Pointer& pointer, const Vector3& point, double spacings, double alongAxis, Weight weight) {
  const Snapshot& scene = *pointer.scene;
  const double reach = spacings * scene.spacing;
  Vector3 sum{0, 0, 0};
  for (const api::Float4& p : scene.position) {
    if (pointer.section && !pointer.section->shows(vectorOf(p))) continue;
    const Vector3 off = point - vectorOf(p);
    if (off.norm() < reach) sum += weight(off.squaredNorm() / (reach * reach)) * off;
  }
  if (!(sum.norm() > 0)) return {0, 1, 0};
  sum.normalize();
  for (int a = 0; a < 3; ++a) {
    if (std::abs(sum[a]) < alongAxis) continue;
    Vector3 axis;
    axis[a] = sum[a] > 0 ? 1 : -1;
    return axis;
  }
  return sum;
}

}  // namespace

/// Those far away say less: it would leap where one of them comes within reach.
Vector3 facingAt(const Pointer& pointer, const Vector3& point) {
  return normalAt(pointer, point, kAround, kIsAxis, [](double share) { return (1 - share) * (1 - share); });
}

double floorHeight(const Environment& environment) {
  double height = environment.boundsMinimum[1];
  for (const SceneWall& wall : environment.walls) {
    if (!faceOf(wall).isCurved() && wall.normal.y() > 0.9 * wall.normal.norm())
      height = std::max(height, wall.point.y());
  }
  return height;
}

double shownSpacing(const Pointer& pointer, double fallback) {
  return pointer.scene && pointer.scene->spacing > 0 ? pointer.scene->spacing : fallback;
}

std::optional<Vector3> matterOn(const Pointer& pointer) {
  const Ray& ray = pointer.ray;
  const auto hit = pointer.scene ? pickParticle(*pointer.scene, ray, pointer.section) : std::nullopt;
  if (!hit) return std::nullopt;
  const api::Float4& p = pointer.scene->position[*hit];
  const double along = (vectorOf(p) - ray.origin).dot(ray.direction) - static_cast<double>(p.w);
  return ray.origin + along * ray.direction;
}

double heightBelow(const Pointer& pointer, const Vector3& point, const Environment& environment) {
  Pointer down = pointer;
  down.ray = {point, {0, -1, 0}};
  const double floor = floorHeight(environment);
  const auto hit = matterOn(down);
  return hit ? std::max(floor, hit->y()) : floor;
}

std::optional<Surface> surfaceUnder(const Pointer& pointer, const Environment& environment) {
  const Ray& ray = pointer.ray;
  const auto all = [](double) { return 1.0; };
  if (const auto point = matterOn(pointer)) return Surface{*point, normalAt(pointer, *point, kNear, kAlongAxis, all)};
  const auto floor = meet(ray, {{0, floorHeight(environment), 0}, {0, 1, 0}});
  const auto within = [&](int axis) {
    return (*floor)[axis] >= environment.boundsMinimum[axis] && (*floor)[axis] <= environment.boundsMaximum[axis];
  };
  if (floor && within(0) && within(2)) return Surface{*floor, Vector3(0, 1, 0)};
  const auto air = meet(ray, {pointer.target, pointer.forward});
  return air ? std::optional(Surface{*air, Vector3::Zero()}) : std::nullopt;
}

}  // namespace ps
