// SPDX-License-Identifier: Apache-2.0
#include "rigidpieces.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ps::constraint {

DisjointSets::DisjointSets(size_t count) : m_parent(count) {
  for (size_t k = 0; k < count; ++k) m_parent[k] = k;
}

size_t DisjointSets::find(size_t k) {
  while (m_parent[k] != k) k = m_parent[k] = m_parent[m_parent[k]];
  return k;
}

void DisjointSets::unite(size_t a, size_t b) {
  a = find(a), b = find(b);
  m_parent[std::max(a, b)] = std::min(a, b);
}

std::vector<std::vector<size_t>> DisjointSets::sets() {
  std::vector<std::vector<size_t>> result;
  std::vector<size_t> place(m_parent.size());
  for (size_t k = 0; k < m_parent.size(); ++k) {
    const size_t least = find(k);
    if (least == k) {
      place[k] = result.size();
      result.emplace_back();
    }
    result[place[least]].push_back(k);
  }
  return result;
}

namespace {

/// Points in cells no smaller than a radius, so that all within it of a point lie in its cell and those around. Cells
/// grow until there are no more than some for each point: what lies scattered is few to a cell anyway.
class PointCells {
 public:
  PointCells(const std::vector<Vector>& points, double radius) {
    Vector low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    for (const Vector& x : points) {
      low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
      high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
    }
    const double most = 4 * static_cast<double>(points.size()) + 64;
    const auto along = [](double size, double edge) { return std::floor(size / edge) + 1; };
    double edge = radius;
    for (;; edge *= 2) {
      const double n[] = {along(high.x - low.x, edge), along(high.y - low.y, edge), along(high.z - low.z, edge)};
      if (n[0] * n[1] * n[2] > most) continue;
      for (size_t a = 0; a < 3; ++a) m_count[a] = static_cast<size_t>(n[a]);
      break;
    }
    m_begin.assign(m_count[0] * m_count[1] * m_count[2] + 1, 0);
    std::vector<uint32_t> cell(points.size());
    for (size_t k = 0; k < points.size(); ++k) {
      const Vector d = points[k] - low;
      const auto place = [&](double c, size_t a) { return std::min(static_cast<size_t>(c / edge), m_count[a] - 1); };
      cell[k] = static_cast<uint32_t>((place(d.z, 2) * m_count[1] + place(d.y, 1)) * m_count[0] + place(d.x, 0));
      ++m_begin[cell[k] + 1];
    }
    for (size_t c = 1; c < m_begin.size(); ++c) m_begin[c] += m_begin[c - 1];
    m_order.resize(points.size());
    std::vector<uint32_t> next(m_begin.begin(), m_begin.end() - 1);
    for (size_t k = 0; k < points.size(); ++k) m_order[next[cell[k]]++] = static_cast<uint32_t>(k);
  }

  /// visit(a, b) for each pair that may be within the radius, once.
  template <class Visit>
  void forPairs(Visit&& visit) const {
    size_t cell = 0;
    for (size_t z = 0; z < m_count[2]; ++z) {
      for (size_t y = 0; y < m_count[1]; ++y) {
        for (size_t x = 0; x < m_count[0]; ++x, ++cell) {
          if (m_begin[cell] != m_begin[cell + 1]) forPairsOf(x, y, z, cell, visit);
        }
      }
    }
  }

 private:
  /// Those of a cell with each other, and with those of the 13 cells that come after it.
  template <class Visit>
  void forPairsOf(size_t x, size_t y, size_t z, size_t cell, Visit&& visit) const {
    const size_t nx = m_count[0], plane = nx * m_count[1];
    const size_t left = x > 0 ? 1 : 0, right = x + 1 < nx ? 1 : 0;
    const auto row = [&](size_t middle) { run(cell, m_begin[middle - left], m_begin[middle + right + 1], visit); };
    for (uint32_t a = m_begin[cell]; a < m_begin[cell + 1]; ++a) {
      for (uint32_t b = a + 1; b < m_begin[cell + 1 + right]; ++b) visit(m_order[a], m_order[b]);
    }
    if (y + 1 < m_count[1]) row(cell + nx);
    if (z + 1 == m_count[2]) return;
    if (y > 0) row(cell + plane - nx);
    row(cell + plane);
    if (y + 1 < m_count[1]) row(cell + plane + nx);
  }
  template <class Visit>
  void run(size_t cell, uint32_t first, uint32_t last, Visit&& visit) const {
    for (uint32_t a = m_begin[cell]; a < m_begin[cell + 1]; ++a) {
      for (uint32_t b = first; b < last; ++b) visit(m_order[a], m_order[b]);
    }
  }

  std::array<size_t, 3> m_count{};
  std::vector<uint32_t> m_begin, m_order;
};

}  // namespace

std::vector<std::vector<size_t>> piecesOf(const std::vector<Vector>& points, double radius,
                                          const std::function<bool(size_t, size_t)>& parted) {
  if (points.empty()) return {};
  DisjointSets sets(points.size());
  PointCells(points, radius).forPairs([&](uint32_t a, uint32_t b) {
    const Vector d = points[a] - points[b];
    if (dot(d, d) < radius * radius && !(parted && parted(a, b))) sets.unite(a, b);
  });
  return sets.sets();
}

}  // namespace ps::constraint
