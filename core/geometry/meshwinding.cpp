// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/meshwinding.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace ps {
namespace {

constexpr uint32_t kLeaf = 8;  ///< triangles
/// A node is one dipole for places farther away than so many of its radii.
constexpr double kFar = 2;
constexpr int kMostDepth = 64;

Vector3 cornerOf(const SceneMesh& mesh, uint32_t triangle, size_t corner) {
  const auto& p = mesh.points[mesh.triangles[triangle][corner]];
  return {p[0], p[1], p[2]};
}

/// Solid angle of a triangle as seen from the origin, in steradians.
double solidAngle(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  const double below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return 2 * std::atan2(a.dot(b.cross(c)), below);
}

}  // namespace

MeshWinding::MeshWinding(const SceneMesh& mesh) {
  const auto count = static_cast<uint32_t>(mesh.triangles.size());
  std::vector<Vector3> centres(count);
  std::vector<uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  for (uint32_t t = 0; t < count; ++t)
    centres[t] = (cornerOf(mesh, t, 0) + cornerOf(mesh, t, 1) + cornerOf(mesh, t, 2)) / 3;
  m_corners.reserve(3 * size_t{count});
  m_nodes.reserve(count / 2 + 1);
  if (count > 0) build(order, centres, 0, count, mesh);
}

/// Halves at the median along the longest side, so that the tree is as deep as the logarithm of what it holds. Corners
/// are laid down leaf by leaf.
uint32_t MeshWinding::build(std::vector<uint32_t>& order, const std::vector<Vector3>& centres, uint32_t first,
                            uint32_t last, const SceneMesh& mesh) {
  const auto index = static_cast<uint32_t>(m_nodes.size());
  m_nodes.emplace_back();
  Node node;
  Vector3 low = centres[order[first]], high = low, weighted;
  double area = 0;
  for (uint32_t k = first; k < last; ++k) {
    const uint32_t t = order[k];
    const Vector3 a = cornerOf(mesh, t, 0);
    const Vector3 part = 0.5 * (cornerOf(mesh, t, 1) - a).cross(cornerOf(mesh, t, 2) - a);
    node.dipole += part;
    weighted += part.norm() * centres[t];
    area += part.norm();
    low = low.cwiseMin(centres[t]), high = high.cwiseMax(centres[t]);
  }
  node.centre = area > 0 ? Vector3(weighted / area) : low;
  for (uint32_t k = first; k < last; ++k) {
    for (size_t c = 0; c < 3; ++c)
      node.radius = std::max(node.radius, (cornerOf(mesh, order[k], c) - node.centre).norm());
  }
  node.first = first, node.last = last;
  if (last - first <= kLeaf) {
    for (uint32_t k = first; k < last; ++k) {
      for (size_t c = 0; c < 3; ++c) m_corners.push_back(cornerOf(mesh, order[k], c));
    }
  } else {
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    const uint32_t middle = first + (last - first) / 2;
    std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + last, [&](uint32_t a, uint32_t b) {
      return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis] : a < b;
    });
    node.left = build(order, centres, first, middle, mesh);
    node.right = build(order, centres, middle, last, mesh);
  }
  m_nodes[index] = node;
  return index;
}

double MeshWinding::at(const Vector3& place) const {
  if (m_nodes.empty()) return 0;
  double sum = 0;
  uint32_t waiting[kMostDepth] = {0};
  int count = 1;
  while (count > 0) {
    const Node& node = m_nodes[waiting[--count]];
    const Vector3 away = node.centre - place;
    const double distance2 = away.squaredNorm();
    if (distance2 > kFar * kFar * node.radius * node.radius) {
      sum += node.dipole.dot(away) / (distance2 * std::sqrt(distance2));
    } else if (node.left != 0) {
      waiting[count++] = node.right;
      waiting[count++] = node.left;
    } else {
      for (uint32_t t = node.first; t < node.last; ++t)
        sum += solidAngle(m_corners[3 * t] - place, m_corners[3 * t + 1] - place, m_corners[3 * t + 2] - place);
    }
  }
  return sum / (4 * std::numbers::pi);
}

}  // namespace ps
