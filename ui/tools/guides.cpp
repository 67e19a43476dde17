// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/guides.h"

#include "core/scene/pose.h"
#include "core/sketch/stroke.h"
#include "core/sketch/symmetry.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ps {
namespace {

constexpr double kGridLines = 24;   // along the longest side of the scene, about
constexpr double kMostLines = 200;  // likewise, however near they are wanted
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

void addGrid(const Pane& pane, double step, std::vector<GuideLine>& lines) {
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
    case DrawOn::Plane:
      break;
  }
  return -1;
}

/// The part of a line within the scene's bounds (Liang and Barsky 1984); nothing where it misses them.
std::optional<GuideLine> clipped(GuideLine line, const Environment& environment) {
  const Vector3 way = line.to - line.from;
  double first = 0, last = 1;
  for (int a = 0; a < 3; ++a) {
    const double low = environment.boundsMinimum[a] - line.from[a], high = environment.boundsMaximum[a] - line.from[a];
    if (way[a] == 0) {
      if (low > 0 || high < 0) return std::nullopt;
      continue;
    }
    first = std::max(first, std::min(low / way[a], high / way[a]));
    last = std::min(last, std::max(low / way[a], high / way[a]));
  }
  if (!(first < last)) return std::nullopt;
  const Vector3 from = line.from;
  line.from = from + first * way;
  line.to = from + last * way;
  return line;
}

/// Of a plane at any pose, from its middle as far as the scene goes.
void addGrid(const FreePlane& plane, double step, const Environment& environment, std::vector<GuideLine>& lines) {
  const Matrix3 axes = strokeAxes(plane.normal());
  const double reach = (environment.boundsMaximum - environment.boundsMinimum).norm();
  const double count = std::min(std::ceil(reach / step), 2 * kMostLines);  // its middle may lie at the scene's edge
  for (const auto& [along, across] : {std::pair(0, 2), std::pair(2, 0)}) {
    const Vector3 way = reach * Vector3(axes.col(along));
    for (double k = -count; k <= count; ++k) {
      const Vector3 middle = plane.point + k * step * Vector3(axes.col(across));
      const GuideLine line{middle - way, middle + way, std::remainder(k, 5) == 0 ? 2 * kFaint : kFaint};
      if (const auto part = clipped(line, environment)) lines.push_back(*part);
    }
  }
}

/// A place of the way that leads from `a` to `b` (m) which is nearest to a ray, and how far it is from that.
std::pair<Vector3, double> nearestOn(const Vector3& a, const Vector3& b, const Ray& ray) {
  const Vector3 way = b - a, off = ray.origin - a;
  const double along = ray.direction.dot(way), length2 = way.squaredNorm();
  const double flat = length2 - along * along;  // 0: they are parallel
  const double wanted = way.dot(off) - along * ray.direction.dot(off);
  const double share = flat > 1e-12 * length2 ? std::clamp(wanted / flat, 0.0, 1.0) : 0;
  const Vector3 place = a + share * way;
  const double ahead = std::max(0.0, ray.direction.dot(place - ray.origin));
  return {place, (ray.origin + ahead * ray.direction - place).norm()};
}

/// Keeps what is nearest within a reach.
class Nearest {
 public:
  explicit Nearest(double reach) : m_away(reach) {}
  void see(const std::pair<Vector3, double>& place, bool end) {
    if (place.second > m_away) return;
    m_away = place.second;
    m_snap = StrokeSnap{place.first, end};
  }
  const std::optional<StrokeSnap>& snap() const { return m_snap; }

 private:
  double m_away;  ///< m
  std::optional<StrokeSnap> m_snap;
};

}  // namespace

double gridStep(const BrushSettings& brush, const Environment& environment) {
  Vector3 size = environment.boundsMaximum - environment.boundsMinimum;
  if (const int across = acrossOf(brush.drawOn); across >= 0) size[across] = 0;
  const double least = size.maxCoeff() / kMostLines;
  return brush.grid > 0 ? std::max(brush.grid, least) : roundStep(size.maxCoeff() / kGridLines);
}

Vector3 onGrid(const BrushSettings& brush, const Environment& environment, const DrawingPlane& plane,
               const Vector3& place) {
  const double step = gridStep(brush, environment);
  if (!(step > 0)) return place;
  const Vector3 middle = brush.drawOn == DrawOn::Plane ? brush.plane.point : Vector3(0, 0, 0);
  const Matrix3 axes = strokeAxes(plane.normal);
  Vector3 snapped = place;
  for (const int a : {0, 2}) {
    const Vector3 axis = axes.col(a);
    const double at = (place - middle).dot(axis);
    snapped += (step * std::round(at / step) - at) * axis;
  }
  return snapped;
}

std::optional<StrokeSnap> strokeSnap(const BrushSettings& brush, const Project& project, const Ray& ray) {
  Nearest ends(brush.snapWithin), anywhere(brush.snapWithin);
  for (const Body& body : project.bodies) {
    const auto* sketch = std::get_if<VoxelShape>(&body.shape);
    if (!sketch || !body.visible) continue;
    const RigidMove pose = poseOf(*sketch);
    for (const VoxelShape::Stroke& stroke : sketch->strokes) {
      if (stroke.erase || stroke.hidden || stroke.samples.empty()) continue;
      for (const SketchImage& image : imagesOf(stroke.symmetry.value_or(VoxelShape::Symmetry{}))) {
        const auto place = [&](const auto& sample) { return pose.of(image.of({sample[0], sample[1], sample[2]})); };
        Vector3 from = place(stroke.samples.front());
        const Vector3 last = place(stroke.samples.back());
        for (const Vector3& end : {from, last}) ends.see(nearestOn(end, end, ray), true);
        for (size_t k = 1; k < stroke.samples.size() && brush.snapTo == SnapTo::Strokes; ++k) {
          const Vector3 to = place(stroke.samples[k]);
          anywhere.see(nearestOn(from, to, ray), false);
          from = to;
        }
      }
    }
  }
  return ends.snap() ? ends.snap() : anywhere.snap();
}

std::optional<DrawingPlane> planeFor(const BrushSettings& brush, const Pointer& pointer) {
  if (brush.drawOn == DrawOn::Surface) return std::nullopt;
  if (brush.drawOn == DrawOn::View) return DrawingPlane{pointer.target, -pointer.forward};
  if (brush.drawOn == DrawOn::Plane) {
    const Vector3 normal = brush.plane.normal();
    return DrawingPlane{brush.plane.point, pointer.ray.direction.dot(normal) > 0 ? Vector3(-normal) : normal};
  }
  const int axis = acrossOf(brush.drawOn);
  DrawingPlane plane{{0, 0, 0}, {0, 0, 0}};
  plane.point[axis] = brush.planeAt;
  plane.normal[axis] = pointer.ray.direction[axis] > 0 ? -1 : 1;
  return plane;
}

std::vector<GuideLine> guideLines(const BrushSettings& brush, const Environment& environment) {
  std::vector<GuideLine> lines;
  const double step = gridStep(brush, environment);
  if (const int axis = acrossOf(brush.drawOn); axis >= 0 && step > 0)
    addGrid(paneOf(axis, brush.planeAt, environment), step, lines);
  if (brush.drawOn == DrawOn::Plane && step > 0) addGrid(brush.plane, step, environment, lines);
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
