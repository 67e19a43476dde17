// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/guides.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

constexpr double kGridLines = 24;  // along the longer side of a plane, about
constexpr double kFaint = 0.18, kClear = 0.6;

/// A part of a plane across an axis, as far as the scene goes.
struct Pane {
  int across, u, v;
  double at;  ///< m
  Vector3 low, high;
  Vector3 point(double a, double b) const {
    Vector3 p;
    p[across] = at, p[u] = a, p[v] = b;
    return p;
  }
};

Pane paneOf(int across, double at, const Environment& environment) {
  return {across, (across + 1) % 3, (across + 2) % 3, at, environment.boundsMinimum, environment.boundsMaximum};
}

void addOutline(const Pane& pane, double opacity, std::vector<GuideLine>& lines) {
  const double ends[] = {0, 1};
  for (const double t : ends) {
    const double a = std::lerp(pane.low[pane.u], pane.high[pane.u], t);
    const double b = std::lerp(pane.low[pane.v], pane.high[pane.v], t);
    lines.push_back({pane.point(a, pane.low[pane.v]), pane.point(a, pane.high[pane.v]), opacity});
    lines.push_back({pane.point(pane.low[pane.u], b), pane.point(pane.high[pane.u], b), opacity});
  }
}

/// 1, 2 or 5 times a power of ten, so that people can count.
double roundStep(double wanted) {
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= wanted) return factor * power;
  return 10 * power;
}

void addGrid(const Pane& pane, std::vector<GuideLine>& lines) {
  const Vector3 size = pane.high - pane.low;
  const double step = roundStep(std::max(size[pane.u], size[pane.v]) / kGridLines);
  if (!(step > 0)) return;
  const auto each = [&](int axis, const auto& add) {
    for (double k = std::ceil(pane.low[axis] / step); k * step <= pane.high[axis]; ++k)
      add(k * step, std::remainder(k, 5) == 0 ? 2 * kFaint : kFaint);
  };
  each(pane.u, [&](double a, double opacity) {
    lines.push_back({pane.point(a, pane.low[pane.v]), pane.point(a, pane.high[pane.v]), opacity});
  });
  each(pane.v, [&](double b, double opacity) {
    lines.push_back({pane.point(pane.low[pane.u], b), pane.point(pane.high[pane.u], b), opacity});
  });
}

/// Axis across the plane; -1: none of the three.
int acrossOf(DrawOn on) {
  switch (on) {
    case DrawOn::Level:
      return 1;
    case DrawOn::AcrossX:
      return 0;
    case DrawOn::AcrossZ:
      return 2;
    case DrawOn::Surface:
    case DrawOn::View:
      break;
  }
  return -1;
}

}  // namespace

std::optional<DrawingPlane> planeFor(const BrushSettings& brush, const Pointer& pointer) {
  if (brush.drawOn == DrawOn::Surface) return std::nullopt;
  if (brush.drawOn == DrawOn::View) return DrawingPlane{pointer.target, -pointer.forward};
  const int axis = acrossOf(brush.drawOn);
  DrawingPlane plane{{0, 0, 0}, {0, 0, 0}};
  plane.point[axis] = brush.planeAt;
  plane.normal[axis] = pointer.ray.direction[axis] > 0 ? -1 : 1;
  return plane;
}

std::vector<GuideLine> guideLines(const BrushSettings& brush, const Environment& environment) {
  std::vector<GuideLine> lines;
  if (const int axis = acrossOf(brush.drawOn); axis >= 0) addGrid(paneOf(axis, brush.planeAt, environment), lines);
  const VoxelShape::Symmetry& symmetry = brush.symmetry;
  if (const size_t axis = std::string("xyz").find(symmetry.mirror); axis < 3) {
    const int across = static_cast<int>(axis);
    addOutline(paneOf(across, symmetry.centre[across], environment), kClear, lines);
  }
  if (symmetry.turns > 1) {
    Vector3 foot = symmetry.centre, top = symmetry.centre;
    foot.y() = environment.boundsMinimum.y(), top.y() = environment.boundsMaximum.y();
    lines.push_back({foot, top, kClear});
  }
  return lines;
}

Vector3 Straightener::place(const Vector3& pointer, const DrawingPlane& plane, double spacing) {
  if (!m_from) return pointer;
  const Vector3 way = pointer - *m_from;
  if (!m_along) {
    if (way.norm() < 2 * spacing) return *m_from;
    const Vector3 normal = plane.normal.normalized();
    const Vector3 helper = std::abs(normal.x()) < 0.9 ? Vector3(1, 0, 0) : Vector3(0, 1, 0);
    const Vector3 u = (helper - helper.dot(normal) * normal).normalized(), v = normal.cross(u);
    const double step = std::numbers::pi / 4;
    const double angle = step * std::round(std::atan2(way.dot(v), way.dot(u)) / step);
    m_along = std::cos(angle) * u + std::sin(angle) * v;
  }
  return *m_from + way.dot(*m_along) * *m_along;
}

Vector3 Trailing::follow(const Vector3& pointer, double length) {
  const Vector3 way = pointer - m_at;
  if (way.norm() > length) m_at = pointer - length / way.norm() * way;
  return m_at;
}

}  // namespace ps
