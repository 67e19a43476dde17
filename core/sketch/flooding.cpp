// SPDX-License-Identifier: Apache-2.0
#include "core/sketch/flooding.h"

#include "core/base/error.h"
#include "core/base/progress.h"

#include <algorithm>
#include <array>
#include <string>
#include <unordered_set>
#include <vector>

namespace ps {
namespace {

struct CellHash {
  size_t operator()(const api::Cell& cell) const {
    uint64_t hash = 0;
    for (const int32_t part : {cell.x, cell.y, cell.z})
      hash = (hash ^ static_cast<uint32_t>(part)) * 0x9e3779b97f4a7c15ULL, hash ^= hash >> 29;
    return hash;
  }
};
struct CellEqual {
  bool operator()(const api::Cell& a, const api::Cell& b) const { return sameCell(a, b); }
};
using Cells = std::unordered_set<api::Cell, CellHash, CellEqual>;

constexpr std::array<api::Cell, 6> kFaces{{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

api::Cell beside(const api::Cell& cell, const api::Cell& way) {
  return {cell.x + way.x, cell.y + way.y, cell.z + way.z};
}

class Flood {
 public:
  Flood(const SketchGrid& grid, const CellSet& filled, const Vector3& gravity, const FreeOf& freeOf, size_t most)
      : m_grid(grid),
        m_filled(filled),
        m_freeOf(freeOf),
        m_most(most),
        m_up(gravity.norm() > 0 ? Vector3(-gravity.normalized()) : Vector3(0, 1, 0)) {}

  /// Free ones, the highest first.
  std::vector<api::Cell> springs(const CellSet& seeds) const {
    CellSet outside = seeds;
    outside.remove(m_filled.cells());
    CellSet free = m_freeOf(m_grid, outside), blocked = outside;
    blocked.remove(free.cells());
    const api::Cell up = *std::max_element(kFaces.begin(), kFaces.end(), [&](const api::Cell& a, const api::Cell& b) {
      return heightOf(a) < heightOf(b);
    });
    std::vector<api::Cell> above;
    for (const api::Cell& cell : blocked.cells()) above.push_back(beside(cell, up));
    CellSet raised(above);
    raised.remove(m_filled.cells());
    free.add(m_freeOf(m_grid, raised).cells());
    std::vector<api::Cell> order(free.cells().begin(), free.cells().end());
    std::stable_sort(order.begin(), order.end(),
                     [&](const api::Cell& a, const api::Cell& b) { return heightOf(a) > heightOf(b); });
    return order;
  }

  /// What is full already lets it through.
  void from(const api::Cell& spring) {
    if (m_wet.count(spring)) return;
    const double level = heightOf(spring) + 1e-3 * m_grid.spacing;  // turned lattices are level to rounding
    Cells seen{spring};
    std::vector<api::Cell> rim{spring}, asked;
    while (!rim.empty()) {
      asked.clear();
      std::vector<api::Cell> next;
      for (const api::Cell& cell : rim) {
        if (!m_filled.contains(cell) && m_wet.insert(cell).second && isTooMuch()) refuse();
        for (const api::Cell& way : kFaces) {
          const api::Cell other = beside(cell, way);
          if (heightOf(other) <= level && seen.insert(other).second)
            (m_filled.contains(other) ? next : asked).push_back(other);
        }
      }
      constexpr size_t kAtOnce = 256;  // cells, of which each is asked for between all walls
      for (size_t first = 0; first < asked.size(); first += kAtOnce) {
        const auto from = asked.begin() + static_cast<ptrdiff_t>(first);
        const auto to = asked.begin() + static_cast<ptrdiff_t>(std::min(asked.size(), first + kAtOnce));
        const CellSet free = m_freeOf(m_grid, CellSet(std::vector<api::Cell>(from, to)));
        next.insert(next.end(), free.cells().begin(), free.cells().end());
        advance(free.cells().size());
      }
      rim = std::move(next);
    }
  }

  CellSet wet() const { return CellSet(std::vector<api::Cell>(m_wet.begin(), m_wet.end())); }

 private:
  double heightOf(const api::Cell& cell) const { return m_grid.centreOf(cell).dot(m_up); }
  bool isTooMuch() const { return m_wet.size() + m_filled.size() > m_most; }
  [[noreturn]] void refuse() const {
    throw InputError("From here more than " + std::to_string(m_most) +
                     " particles would run full: begin lower, close what is open, or make the particle spacing larger");
  }

  const SketchGrid& m_grid;
  const CellSet& m_filled;
  const FreeOf& m_freeOf;
  const size_t m_most;
  const Vector3 m_up;
  Cells m_wet;
};

}  // namespace

CellSet flooded(const SketchGrid& grid, const CellSet& seeds, const CellSet& filled, const Vector3& gravity,
                const FreeOf& freeOf, size_t most) {
  Flood flood(grid, filled, gravity, freeOf, most);
  for (const api::Cell& spring : flood.springs(seeds)) flood.from(spring);
  return flood.wet();
}

}  // namespace ps
