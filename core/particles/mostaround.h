// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/cellgrid.h"

#include <algorithm>

namespace ps {

/// The most that any place has of something, in its cell or in those next to it: what no place there has, no neighbour
/// in a list has, and the list need not be read. A copy for each thread: who asks for places of one cell one after
/// another has it looked up once.
template <class T>
class MostAround {
 public:
  /// `of[i]` by index of the places, into memory that is used again.
  MostAround(const CellGrid& grid, const std::vector<T>& of, std::vector<T>& ofCell) : m_grid(grid), m_ofCell(ofCell) {
    const std::span<const uint32_t> starts = grid.starts(), order = grid.order();
    ofCell.resize(starts.size() - 1);
    forChunks(ofCell.size(), grain::kParticles, [&](size_t first, size_t last) {
      for (size_t c = first; c < last; ++c) {
        T most = 0;
        for (uint32_t slot = starts[c]; slot < starts[c + 1]; ++slot) most = std::max(most, of[order[slot]]);
        ofCell[c] = most;
      }
    });
  }
  T at(size_t place) {
    const uint32_t cell = m_grid.cellOfEach()[place];
    if (cell == m_cell) return m_most;
    m_cell = cell, m_most = 0;
    m_grid.aroundCell(cell, [&](size_t c) { m_most = std::max(m_most, m_ofCell[c]); });
    return m_most;
  }

 private:
  const CellGrid& m_grid;
  const std::vector<T>& m_ofCell;
  uint32_t m_cell = ~0u;
  T m_most = 0;
};

}  // namespace ps
