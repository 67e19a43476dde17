// SPDX-License-Identifier: Apache-2.0
#include "core/math/meshnearest.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <span>

namespace ps {
namespace {

constexpr uint32_t kLeaf = 4;  ///< triangles
constexpr size_t kMostDepth = 64;
constexpr double kSame = 1e-12;                       ///< of two squared distances: what meets there
constexpr size_t kMostPlanes = 4;                     ///< that a search minds
constexpr size_t kMostCorners = 3 + kMostPlanes + 1;  ///< each plane adds one to a polygon

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

/// A place, what is known so far of what is nearest to it, and what that must lie over.
struct MeshNearest::Search {
  const Vector3& place;
  std::span<const Plane> over;
  Hit best;
  double facing = -1;  ///< how much the triangle of `best` faces the place: a cosine
  bool found = false;

  bool mayBeIn(const Node& node) const {
    return squaredDistance(place, node.low, node.high) <= best.squared &&
           std::all_of(over.begin(), over.end(), [&](const Plane& plane) {
             const Vector3 farthest = (plane.normal.array() > 0).select(node.high, node.low);
             return plane.heightOf(farthest) > 0;
           });
  }
  void offer(const Vector3& on, const Triangle& t) {
    const double squared = (place - on).squaredNorm();
    if (!(squared <= (1 + kSame) * best.squared)) return;
    const bool nearer = !found || squared < (1 - kSame) * best.squared;
    const Vector3 normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
    const double faces = std::abs((place - on).dot(normal));
    if (!nearer && !(faces > facing)) return;
    best = {on, normal, std::min(squared, best.squared)};
    facing = faces;
    found = true;
  }
  void look(const Triangle& t);
};

/// What lies over the planes is a polygon.
void MeshNearest::Search::look(const Triangle& t) {
  const auto isBelow = [&](const Plane& plane) {
    return !(plane.heightOf(t[0]) > 0) && !(plane.heightOf(t[1]) > 0) && !(plane.heightOf(t[2]) > 0);
  };
  if (std::any_of(over.begin(), over.end(), isBelow)) return;
  const Vector3 on = nearestOn(t, place);
  if (!((place - on).squaredNorm() <= (1 + kSame) * best.squared)) return;  // nor is any part of it
  if (std::all_of(over.begin(), over.end(), [&](const Plane& plane) { return plane.heightOf(on) > 0; }))
    return offer(on, t);
  std::array<Vector3, kMostCorners> corners{t[0], t[1], t[2]}, cut;
  size_t count = 3;
  for (const Plane& plane : over) {
    size_t left = 0;
    for (size_t k = 0; k < count; ++k) {
      const Vector3 &a = corners[k], &b = corners[(k + 1) % count];
      const double ofA = plane.heightOf(a), ofB = plane.heightOf(b);
      if (ofA > 0) cut[left++] = a;
      if ((ofA > 0) != (ofB > 0)) cut[left++] = a + ofA / (ofA - ofB) * (b - a);
    }
    corners.swap(cut);
    count = left;
    if (count == 0) return;
  }
  for (size_t k = 2; k < count; ++k) offer(nearestOn({corners[0], corners[k - 1], corners[k]}, place), t);
}

void MeshNearest::find(Search& search) const {
  std::array<uint32_t, kMostDepth> waiting;
  size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const uint32_t index = waiting[--count];
    const Node& node = m_nodes[index];
    if (!search.mayBeIn(node)) continue;
    if (node.right == 0) {
      for (uint32_t k = node.first; k < node.last; ++k) search.look(m_triangles[k]);
      continue;
    }
    const uint32_t left = index + 1;
    const bool leftFirst = squaredDistance(search.place, m_nodes[left].low, m_nodes[left].high) <=
                           squaredDistance(search.place, m_nodes[node.right].low, m_nodes[node.right].high);
    waiting[count++] = leftFirst ? node.right : left;
    waiting[count++] = leftFirst ? left : node.right;
  }
}

MeshNearest::Hit MeshNearest::at(const Vector3& place) const {
  Search search{place, {}, {{}, {}, HUGE_VAL}};
  find(search);
  return search.best;
}

std::optional<MeshNearest::Hit> MeshNearest::within(double reach, const Vector3& place,
                                                    std::span<const Plane> over) const {
  Search search{place, over.first(std::min(over.size(), kMostPlanes)), {{}, {}, reach * reach}};
  find(search);
  return search.found ? std::optional(search.best) : std::nullopt;
}

}  // namespace ps
