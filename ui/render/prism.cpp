// SPDX-License-Identifier: Apache-2.0
#include "ui/render/furniture.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps::render {
namespace {

MeshVertex vertex(const Vector3& p, const Vector3& n, const std::array<float, 4>& material) {
  MeshVertex v{{}, {}, material};
  for (size_t k = 0; k < 3; ++k) {
    v.position[k] = static_cast<float>(p[k]);
    v.normal[k] = static_cast<float>(n[k]);
  }
  return v;
}

struct Ring {
  std::vector<Vector3> points, normals;
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

void addCap(std::vector<MeshVertex>& out, const std::vector<Vector3>& points, const Vector3& normal, bool flip,
            const std::array<float, 4>& material) {
  for (size_t i = 1; i + 1 < points.size(); ++i) {
    out.push_back(vertex(points[0], normal, material));
    out.push_back(vertex(points[flip ? i + 1 : i], normal, material));
    out.push_back(vertex(points[flip ? i : i + 1], normal, material));
  }
}

// Corners replaced by arcs; each point with its direction outwards in the plane.
Ring roundOutline(const std::vector<Vector3>& outline, const Vector3& normal, double radius) {
  constexpr int kSteps = 6;
  const std::vector<Vector3> centres = offsetOutline(outline, normal, -radius);
  Ring ring;
  const size_t n = outline.size();
  for (size_t i = 0; i < n; ++i) {
    const Vector3 before = (outline[i] - outline[(i + n - 1) % n]).normalized().cross(normal).normalized();
    const Vector3 after = (outline[(i + 1) % n] - outline[i]).normalized().cross(normal).normalized();
    for (int k = 0; k <= kSteps; ++k) {
      const double t = static_cast<double>(k) / kSteps;
      const Vector3 out = ((1 - t) * before + t * after).normalized();
      ring.points.push_back(centres[i] + radius * out);
      ring.normals.push_back(out);
    }
  }
  return ring;
}

}  // namespace

std::vector<Vector3> offsetOutline(const std::vector<Vector3>& outline, const Vector3& normal, double distance) {
  const size_t n = outline.size();
  std::vector<Vector3> moved(n);
  for (size_t i = 0; i < n; ++i) {
    const Vector3 before = (outline[i] - outline[(i + n - 1) % n]).normalized().cross(normal).normalized();
    const Vector3 after = (outline[(i + 1) % n] - outline[i]).normalized().cross(normal).normalized();
    const Vector3 middle = (before + after).normalized();
    moved[i] = outline[i] + distance / std::max(0.2, middle.dot(after)) * middle;
  }
  return moved;
}

void addSlab(std::vector<MeshVertex>& out, const std::vector<Vector3>& outline, const Vector3& normal,
             const SlabShape& shape, const std::array<float, 4>& top, const std::array<float, 4>& side) {
  constexpr int kSteps = 5;
  const Ring outer = roundOutline(offsetOutline(outline, normal, shape.margin), normal, shape.corner);
  const auto ringAt = [&](double inset, double depth, double tilt) {
    Ring ring;
    for (size_t i = 0; i < outer.points.size(); ++i) {
      ring.points.push_back(outer.points[i] - inset * outer.normals[i] - depth * normal);
      ring.normals.push_back(std::cos(tilt) * outer.normals[i] + std::sin(tilt) * normal);
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
  addCap(out, last.points, -normal, true, side);
}

void addRim(std::vector<MeshVertex>& out, const Face& floor, const Vector3& normal, double width, double height,
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
    const Vector3 along = (floor.corners[j] - floor.corners[i]).normalized(),
                  outward = along.cross(normal).normalized();
    for (size_t k = 0; k + 1 < profile.size(); ++k) {
      const std::vector<Vector3> a = offsetOutline(floor.corners, normal, profile[k][0]);
      const std::vector<Vector3> b = offsetOutline(floor.corners, normal, profile[k + 1][0]);
      const Vector3 p0 = a[i] + profile[k][1] * normal, p1 = a[j] + profile[k][1] * normal;
      const Vector3 q0 = b[i] + profile[k + 1][1] * normal, q1 = b[j] + profile[k + 1][1] * normal;
      const auto [along0, up0] = profile[k];
      const auto [along1, up1] = profile[k + 1];
      const Vector3 facing = ((up0 - up1) * outward + (along1 - along0) * normal).normalized();
      for (const Vector3& p : {p0, q0, q1, p0, q1, p1}) out.push_back(vertex(p, facing, material));
    }
    for (const bool end : {false, true}) {
      if (floor.walled[end ? j : (i + n - 1) % n]) continue;
      std::vector<Vector3> cap;
      cap.reserve(profile.size());
      for (const auto& [offset, up] : profile)
        cap.push_back(offsetOutline(floor.corners, normal, offset)[end ? j : i] + up * normal);
      addCap(out, cap, (end ? 1 : -1) * along, end, material);
    }
  }
}

}  // namespace ps::render
