// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/meshnearest.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <span>

namespace ps {
namespace {

constexpr uint32_t kLeaf = 4;  ///< triangles
constexpr size_t kMostDepth = 64;

double squaredDistance(const Vector3& p, const Vector3& low, const Vector3& high) {
  return (p - p.cwiseMax(low).cwiseMin(high)).squaredNorm();
}

/// Ericson 2005, 5.1.5: by the region of the triangle's plane in which the place lies.
Vector3 nearestOn(const MeshNearest::Triangle& t, const Vector3& p) {
  const Vector3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return t[0];
  const Vector3 bp = p - t[1];
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return t[1];
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return t[0] + d1 / (d1 - d3) * ab;
  const Vector3 cp = p - t[2];
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return t[2];
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return t[0] + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return t[1] + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t[2] - t[1]);
  const double sum = va + vb + vc;
  return t[0] + vb / sum * ab + vc / sum * ac;
}

}  // namespace

MeshNearest::MeshNearest(std::vector<Triangle> triangles) : m_triangles(std::move(triangles)) {
  m_nodes.reserve(m_triangles.size());
  build(0, static_cast<uint32_t>(m_triangles.size()));
}

/// Halves at the median along the longest side: the tree is as deep as the logarithm of what it holds.
uint32_t MeshNearest::build(uint32_t first, uint32_t last) {
  const auto index = static_cast<uint32_t>(m_nodes.size());
  Node node{m_triangles[first][0], m_triangles[first][0], first, last, 0};
  for (const Triangle& t : std::span(m_triangles).subspan(first, last - first)) {
    for (const Vector3& corner : t) node.low = node.low.cwiseMin(corner), node.high = node.high.cwiseMax(corner);
  }
  m_nodes.push_back(node);
  if (last - first <= kLeaf) return index;
  Eigen::Index axis = 0;
  (node.high - node.low).maxCoeff(&axis);
  const uint32_t middle = first + (last - first) / 2;
  const auto at = [&](uint32_t k) { return m_triangles.begin() + static_cast<ptrdiff_t>(k); };
  std::nth_element(at(first), at(middle), at(last), [axis](const Triangle& a, const Triangle& b) {
    return a[0][axis] + a[1][axis] + a[2][axis] < b[0][axis] + b[1][axis] + b[2][axis];
  });
  build(first, middle);
  m_nodes[index].right = build(middle, last);
  return index;
}

MeshNearest::Hit MeshNearest::at(const Vector3& place) const {
  Hit best{{}, {}, HUGE_VAL};
  uint32_t found = 0;
  std::array<uint32_t, kMostDepth> waiting;
  size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const uint32_t index = waiting[--count];
    const Node& node = m_nodes[index];
    if (squaredDistance(place, node.low, node.high) >= best.squared) continue;
    if (node.right == 0) {
      for (uint32_t k = node.first; k < node.last; ++k) {
        const Vector3 on = nearestOn(m_triangles[k], place);
        const double squared = (place - on).squaredNorm();
        if (squared < best.squared) best = {on, {}, squared}, found = k;
      }
      continue;
    }
    const uint32_t left = index + 1;
    const bool leftFirst = squaredDistance(place, m_nodes[left].low, m_nodes[left].high) <=
                           squaredDistance(place, m_nodes[node.right].low, m_nodes[node.right].high);
    waiting[count++] = leftFirst ? node.right : left;
    waiting[count++] = leftFirst ? left : node.right;
  }
  const Triangle& t = m_triangles[found];
  best.normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  return best;
}

}  // namespace ps
