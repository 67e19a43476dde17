// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/parallel.h"
#include "core/particles/period.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace ps {

/// Cells of one size over the box around some places, and which places lie in each: whoever looks for what is near asks
/// the cells around it. A counting sort: rows of cells along x are one range of slots, and places of a cell keep their
/// order, whoever put them there.
class CellGrid {
 public:
  /// `placeOf(i)`, an api::Double3 in m within the period, for i < count. Cells are `edge` m wide or more, since there
  /// are at most 8 per place and 4096: they grow where a lonely place stretches the box. Along an axis that repeats
  /// itself, they fill the period and are at least three. A coordinate that is not finite counts for the first or the
  /// last cell.
  template <class PlaceOf>
  void sort(size_t count, double edge, const Period& period, PlaceOf&& placeOf) {
    m_bounds.assign(chunkCount(count, grain::kParticles), {});
    forChunks(count, grain::kParticles, [&](size_t first, size_t last) {
      for (size_t i = first; i < last; ++i) m_bounds[first / grain::kParticles].add(placeOf(i));
    });
    Bounds whole;
    for (const Bounds& part : m_bounds) whole.add(part);
    fit(whole, count, edge, period);
    forChunks(count, grain::kParticles, [&](size_t first, size_t last) {
      for (size_t i = first; i < last; ++i) m_cellOf[i] = cellOf(placeOf(i));
    });
    sortByCell();
  }
  /// The places have been brought into order: slots are their indices from now on.
  void reorder();

  int cells(size_t axis) const { return m_cells[axis]; }
  double low(size_t axis) const { return m_low[axis]; }            ///< where the first cell begins, m
  double perMetre(size_t axis) const { return m_perMetre[axis]; }  ///< cells of one metre
  /// Cell along an axis, of those that there are.
  int along(double coordinate, size_t axis) const {
    const double t = (coordinate - m_low[axis]) * m_perMetre[axis];
    if (!(t > 0)) return 0;
    return t >= m_cells[axis] ? m_cells[axis] - 1 : static_cast<int>(t);
  }
  /// visit(first, last) for slots that hold all places within `edge` m of a place, across the faces of a period too.
  template <class Visit>
  void around(const api::Double3& place, Visit&& visit) const {
    aroundCell(cellOf(place), [&](size_t c) { visit(m_starts[c], m_starts[c + 1]); });
  }
  /// visit(cell) for a cell and those next to it, across the faces of a period too.
  template <class Visit>
  void aroundCell(size_t c, Visit&& visit) const {
    const int own = static_cast<int>(c), nx = m_cells[0], ny = m_cells[1];
    const int at[3] = {own % nx, own / nx % ny, own / (nx * ny)};
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        const int z = turned(at[2] + dz, 2), y = turned(at[1] + dy, 1);
        if (z < 0 || y < 0) continue;
        for (int dx = -1; dx <= 1; ++dx) {
          const int x = turned(at[0] + dx, 0);
          if (x >= 0) visit(cell(x, y, z));
        }
      }
    }
  }
  size_t cell(int x, int y, int z) const { return static_cast<size_t>((z * m_cells[1] + y) * m_cells[0] + x); }
  /// First slot of a cell; that of the next one is its end.
  std::span<const uint32_t> starts() const { return m_starts; }
  /// Index of the place in a slot; 16 more may be read.
  std::span<const uint32_t> order() const { return {m_order.data(), m_cellOf.size()}; }
  /// Whether slots are indices.
  bool sorted() const { return m_sorted; }
  /// Cell of a place, by its index.
  std::span<const uint32_t> cellOfEach() const { return m_cellOf; }

 private:
  /// The box around finite places.
  struct Bounds {
    double low[3] = {kNone, kNone, kNone}, high[3] = {-kNone, -kNone, -kNone};  ///< m
    static constexpr double kNone = std::numeric_limits<double>::infinity();
    void add(const api::Double3& place) {
      const double p[3] = {place.x, place.y, place.z};
      for (size_t a = 0; a < 3; ++a) {  // comparisons with not-a-number are false
        if (p[a] < low[a] && p[a] > -kNone) low[a] = p[a];
        if (p[a] > high[a] && p[a] < kNone) high[a] = p[a];
      }
    }
    void add(const Bounds& other) {
      for (size_t a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], other.low[a]);
        high[a] = std::max(high[a], other.high[a]);
      }
    }
  };
  void fit(const Bounds& bounds, size_t count, double edge, const Period& period);
  uint32_t cellOf(const api::Double3& p) const {
    return static_cast<uint32_t>(cell(along(p.x, 0), along(p.y, 1), along(p.z, 2)));
  }
  void sortByCell();
  void sortAlone();
  void sortTogether();
  /// A cell next to one of the grid's; -1: there is none.
  int turned(int c, size_t axis) const {
    if (c >= 0 && c < m_cells[axis]) return c;
    return m_repeats[axis] ? (c + m_cells[axis]) % m_cells[axis] : -1;
  }

  static constexpr size_t kSpareSlots = 16;
  double m_low[3] = {0, 0, 0}, m_perMetre[3] = {1, 1, 1};  ///< m, 1/m
  int m_cells[3] = {1, 1, 1};
  bool m_repeats[3] = {false, false, false};
  std::vector<Bounds> m_bounds;  ///< by chunk
  std::vector<uint32_t> m_starts, m_order, m_cellOf, m_next;
  bool m_sorted = false;
};

}  // namespace ps
