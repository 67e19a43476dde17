// SPDX-License-Identifier: Apache-2.0
#include "ui/render/furniture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps::render {
namespace {

Vec3 plus(const Vec3& a, const Vec3& b, double s) { return {a[0] + b[0] * s, a[1] + b[1] * s, a[2] + b[2] * s}; }
Vec3 minus(const Vec3& a, const Vec3& b) { return plus(a, b, -1); }
double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec3 unit(const Vec3& a) { return plus({0, 0, 0}, a, 1 / std::max(1e-300, std::sqrt(dot(a, a)))); }

MeshVertex vertex(const Vec3& p, const Vec3& n, const std::array<float, 4>& material) {
  MeshVertex v{{}, {}, material};
  for (size_t k = 0; k < 3; ++k) {
    v.position[k] = static_cast<float>(p[k]);
    v.normal[k] = static_cast<float>(n[k]);
  }
  return v;
}

struct Ring {
  std::vector<Vec3> points, normals;
};

void addBand(std::vector<MeshVertex>& out, const Ring& low, const Ring& high, const std::array<float, 4>& material) {
  const size_t n = low.points.size();
  for (size_t i = 0; i < n; ++i) {
    const size_t j = (i + 1) % n;
    const MeshVertex a = vertex(low.points[i], low.normals[i], material);
    const MeshVertex b = vertex(low.points[j], low.normals[j], material);
    const MeshVertex c = vertex(high.points[j], high.normals[j], material);
    const MeshVertex d = vertex(high.points[i], high.normals[i], material);
    out.insert(out.end(), {a, b, c, a, c, d});
  }
}

void addCap(std::vector<MeshVertex>& out, const std::vector<Vec3>& points, const Vec3& normal, bool flip,
            const std::array<float, 4>& material) {
  for (size_t i = 1; i + 1 < points.size(); ++i) {
    out.push_back(vertex(points[0], normal, material));
    out.push_back(vertex(points[flip ? i + 1 : i], normal, material));
    out.push_back(vertex(points[flip ? i : i + 1], normal, material));
  }
}

// Corners replaced by arcs; each point with its direction outwards in the plane.
Ring roundOutline(const std::vector<Vec3>& outline, const Vec3& normal, double radius) {
  constexpr int kSteps = 6;
  const std::vector<Vec3> centres = offsetOutline(outline, normal, -radius);
  Ring ring;
  const size_t n = outline.size();
  for (size_t i = 0; i < n; ++i) {
    const Vec3 before = unit(cross(unit(minus(outline[i], outline[(i + n - 1) % n])), normal));
    const Vec3 after = unit(cross(unit(minus(outline[(i + 1) % n], outline[i])), normal));
    for (int k = 0; k <= kSteps; ++k) {
      const double t = static_cast<double>(k) / kSteps;
      const Vec3 out = unit(plus(plus({0, 0, 0}, before, 1 - t), after, t));
      ring.points.push_back(plus(centres[i], out, radius));
      ring.normals.push_back(out);
    }
  }
  return ring;
}

}  // namespace

std::vector<Vec3> offsetOutline(const std::vector<Vec3>& outline, const Vec3& normal, double distance) {
  const size_t n = outline.size();
  std::vector<Vec3> moved(n);
  for (size_t i = 0; i < n; ++i) {
    const Vec3 before = unit(cross(unit(minus(outline[i], outline[(i + n - 1) % n])), normal));
    const Vec3 after = unit(cross(unit(minus(outline[(i + 1) % n], outline[i])), normal));
    const Vec3 middle = unit(plus(before, after, 1));
    moved[i] = plus(outline[i], middle, distance / std::max(0.2, dot(middle, after)));
  }
  return moved;
}

void addSlab(std::vector<MeshVertex>& out, const std::vector<Vec3>& outline, const Vec3& normal, const SlabShape& shape,
             const std::array<float, 4>& top, const std::array<float, 4>& side) {
  constexpr int kSteps = 5;
  const Ring outer = roundOutline(offsetOutline(outline, normal, shape.margin), normal, shape.corner);
  const auto ringAt = [&](double inset, double depth, double tilt) {
    Ring ring;
    for (size_t i = 0; i < outer.points.size(); ++i) {
      ring.points.push_back(plus(plus(outer.points[i], outer.normals[i], -inset), normal, -depth));
      ring.normals.push_back(plus(plus({0, 0, 0}, outer.normals[i], std::cos(tilt)), normal, std::sin(tilt)));
    }
    return ring;
  };
  Ring last;
  for (int half = 0; half < 2; ++half)  // the upper edge from the top outwards, then the lower one inwards
    for (int k = 0; k <= kSteps; ++k) {
      const double angle = (half ? -k : kSteps - k) * std::numbers::pi / 2 / kSteps;
      const double inset = shape.bevel * (1 - std::cos(angle));
      const double depth =
          half ? shape.thickness - shape.bevel * (1 + std::sin(angle)) : shape.bevel * (1 - std::sin(angle));
      const Ring ring = ringAt(inset, depth, angle);
      if (last.points.empty())
        addCap(out, ring.points, normal, false, top);
      else
        addBand(out, ring, last, side);
      last = ring;
    }
  addCap(out, last.points, plus({0, 0, 0}, normal, -1), true, side);
}

void addRim(std::vector<MeshVertex>& out, const Face& floor, const Vec3& normal, double width, double height,
            const std::array<float, 4>& material) {
  const double chamfer = std::min(width, height) * 0.3;
  const std::array<std::array<double, 2>, 6> profile{{{0, 0},
                                                      {0, height - chamfer},
                                                      {chamfer, height},
                                                      {width - chamfer, height},
                                                      {width, height - chamfer},
                                                      {width, 0}}};
  const size_t n = floor.corners.size();
  for (size_t i = 0; i < n; ++i) {
    if (!floor.walled[i]) continue;
    const size_t j = (i + 1) % n;
    const Vec3 along = unit(minus(floor.corners[j], floor.corners[i])), outward = unit(cross(along, normal));
    for (size_t k = 0; k + 1 < profile.size(); ++k) {
      const std::vector<Vec3> a = offsetOutline(floor.corners, normal, profile[k][0]);
      const std::vector<Vec3> b = offsetOutline(floor.corners, normal, profile[k + 1][0]);
      const Vec3 p0 = plus(a[i], normal, profile[k][1]), p1 = plus(a[j], normal, profile[k][1]);
      const Vec3 q0 = plus(b[i], normal, profile[k + 1][1]), q1 = plus(b[j], normal, profile[k + 1][1]);
      const Vec3 facing = unit(
          plus(plus({0, 0, 0}, outward, profile[k][1] - profile[k + 1][1]), normal, profile[k + 1][0] - profile[k][0]));
      for (const Vec3& p : {p0, q0, q1, p0, q1, p1}) out.push_back(vertex(p, facing, material));
    }
    for (const bool end : {false, true}) {
      if (floor.walled[end ? j : (i + n - 1) % n]) continue;
      std::vector<Vec3> cap;
      cap.reserve(profile.size());
      for (const auto& [offset, up] : profile)
        cap.push_back(plus(offsetOutline(floor.corners, normal, offset)[end ? j : i], normal, up));
      addCap(out, cap, plus({0, 0, 0}, along, end ? 1 : -1), end, material);
    }
  }
}

}  // namespace ps::render
