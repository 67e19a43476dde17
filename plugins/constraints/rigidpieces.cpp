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

std::vector<std::vector<size_t>> piecesOf(const std::vector<Vector>& points, double radius) {
  struct Entry {
    std::array<int64_t, 3> cell;
    size_t point;
    bool operator<(const Entry& other) const { return cell != other.cell ? cell < other.cell : point < other.point; }
  };
  std::vector<Entry> entries;
  entries.reserve(points.size());
  for (size_t k = 0; k < points.size(); ++k) {
    const auto cell = [&](double c) { return static_cast<int64_t>(std::floor(c / radius)); };
    entries.push_back({{cell(points[k].x), cell(points[k].y), cell(points[k].z)}, k});
  }
  std::sort(entries.begin(), entries.end());
  DisjointSets sets(points.size());
  for (const Entry& e : entries) {
    for (int64_t dx = -1; dx <= 1; ++dx) {
      for (int64_t dy = -1; dy <= 1; ++dy) {
        // The three cells of a row along z lie one after the other.
        const std::array<int64_t, 3> first{e.cell[0] + dx, e.cell[1] + dy, e.cell[2] - 1};
        auto other = std::lower_bound(entries.begin(), entries.end(), Entry{first, 0});
        for (; other != entries.end() && other->cell <= std::array<int64_t, 3>{first[0], first[1], first[2] + 2};
             ++other) {
          const Vector d = points[e.point] - points[other->point];
          if (dot(d, d) < radius * radius) sets.unite(e.point, other->point);
        }
      }
    }
  }
  return sets.sets();
}

}  // namespace ps::constraint
