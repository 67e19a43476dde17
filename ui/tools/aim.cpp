// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/aim.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ps {
namespace {

constexpr double kClick = 4;  // units of fineness that a click may wander

/// Of the way from a to b, at which one is nearest to the aim.
double shareOf(const Aim& a, const Aim& b) {
  const double x = b.x - a.x, y = b.y - a.y, square = x * x + y * y;
  return square > 0 ? std::clamp(-(a.x * x + a.y * y) / square, 0.0, 1.0) : 0;
}

}  // namespace

bool wandered(const Pointer& pressed, const Pointer& now) {
  const double turned = pressed.ray.direction.cross(now.ray.direction).norm();
  // A hand may move and not turn: what that means depends on the distance of what it aims at.
  const double shifted = (now.ray.origin - pressed.ray.origin).norm();
  const double away = (pressed.target - pressed.ray.origin).norm();
  return turned + (away > 0 ? shifted / away : 0) >= kClick * pressed.fineness;
}

std::optional<Aim> aimTo(const Pointer& pointer, const Vector3& place) {
  const Vector3 way = place - pointer.ray.origin;
  const Vector3& d = pointer.ray.direction;
  const double depth = way.dot(d);
  if (!(depth > 0)) return std::nullopt;
  const Vector3 helper = std::abs(d.y()) < 0.99 ? Vector3(0, 1, 0) : Vector3(1, 0, 0);
  const Vector3 right = d.cross(helper).normalized(), up = right.cross(d);
  const double scale = 1 / (depth * pointer.fineness);
  return Aim{way.dot(right) * scale, way.dot(up) * scale};
}

std::optional<Aim> inPicture(const Pointer& pointer, const Vector3& place) {
  const Vector3 way = place - pointer.ray.origin;
  const Vector3& forward = pointer.forward;
  const double depth = way.dot(forward);
  if (!(depth > 0)) return std::nullopt;
  // No view is tilted to a side. Straight down what is left of the level part still says which way it is turned.
  const Vector3 level(-forward.z(), 0, forward.x());
  const Vector3 right = level.norm() > 0 ? Vector3(level / level.norm()) : Vector3(1, 0, 0);
  return Aim{way.dot(right) / depth, way.dot(right.cross(forward)) / depth};
}

double aimDistance(const Pointer& pointer, const Vector3& from, const Vector3& to) {
  const auto a = aimTo(pointer, from), b = aimTo(pointer, to);
  if (!a || !b) return std::numeric_limits<double>::infinity();
  const double t = shareOf(*a, *b);
  return std::hypot(a->x + t * (b->x - a->x), a->y + t * (b->y - a->y));
}

std::optional<Vector3> nearestPlace(const Pointer& pointer, const Vector3& from, const Vector3& to) {
  const auto a = aimTo(pointer, from), b = aimTo(pointer, to);
  if (!a || !b) return std::nullopt;
  // What is farther away is seen shorter: a share of what is seen is another one of the line.
  const auto depthOf = [&](const Vector3& place) { return (place - pointer.ray.origin).dot(pointer.ray.direction); };
  const double t = shareOf(*a, *b), here = (1 - t) / depthOf(from), there = t / depthOf(to);
  return Vector3(from + there / (here + there) * (to - from));
}

DrawingPlane uprightThrough(const Vector3& point, const Vector3& forward) {
  const double length = std::hypot(forward[0], forward[2]);
  return {point, length > 1e-6 ? Vector3(-forward[0], 0, -forward[2]) : Vector3(0, 0, 1)};
}

}  // namespace ps
