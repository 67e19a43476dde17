// SPDX-License-Identifier: Apache-2.0
#include "core/particles/cellgrid.h"

#include "core/base/parallelarrays.h"

namespace ps {
namespace {

/// Places, times how many threads help, from which on they sort them together: below that, sharing the work costs more
/// than it saves.
constexpr size_t kMany = 1 << 16;

}  // namespace

void CellGrid::fit(const Bounds& bounds, size_t count, double edge, const Period& period) {
  double extent[3];
  for (size_t a = 0; a < 3; ++a) {
    const bool any = bounds.low[a] <= bounds.high[a];
    m_low[a] = any ? bounds.low[a] : 0;
    extent[a] = any ? bounds.high[a] - bounds.low[a] : 0;
  }
  const auto most = static_cast<double>(8 * count + 4096);
  const auto cellsAlong = [&](size_t a) {
    if (period.length(a) > 0) return std::max(3.0, std::floor(double{period.length(a)} / edge));
    return std::floor(extent[a] / edge) + 1;
  };
  while (cellsAlong(0) * cellsAlong(1) * cellsAlong(2) > most) edge *= 1.25;
  for (size_t a = 0; a < 3; ++a) {
    m_cells[a] = static_cast<int>(cellsAlong(a));
    m_perMetre[a] = 1 / edge;
    m_repeats[a] = period.length(a) > 0;
    if (!m_repeats[a]) continue;
    m_low[a] = period.low(a);
    m_perMetre[a] = m_cells[a] * double{period.inverse(a)};
  }
  m_cellOf.resize(count);
}

void CellGrid::sortByCell() {
  m_starts.resize(cell(0, 0, m_cells[2]) + 1);
  m_order.resize(m_cellOf.size() + kSpareSlots);
  if (m_cellOf.size() * static_cast<size_t>(threadCount() - 1) < kMany)
    sortAlone();
  else
    sortTogether();
}

void CellGrid::sortAlone() {
  const size_t count = m_cellOf.size(), cells = m_starts.size() - 1;
  std::fill(m_starts.begin(), m_starts.end(), 0);
  // Where a cell begins stands with the next one until its places are put there.
  for (const uint32_t c : m_cellOf) {
    if (c + size_t{2} <= cells) ++m_starts[c + size_t{2}];
  }
  for (size_t c = 2; c <= cells; ++c) m_starts[c] += m_starts[c - 1];
  m_sorted = true;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t slot = m_starts[m_cellOf[i] + size_t{1}]++;
    m_order[slot] = static_cast<uint32_t>(i);
    m_sorted = m_sorted && slot == i;
  }
}

/// Places come to their cells in the order that threads have them; each cell then sorts its own.
void CellGrid::sortTogether() {
  const size_t count = m_cellOf.size(), cells = m_starts.size() - 1;
  forChunks(m_starts.size(), grain::kNumbers, [&](size_t first, size_t last) {
    std::fill(m_starts.begin() + static_cast<ptrdiff_t>(first), m_starts.begin() + static_cast<ptrdiff_t>(last), 0);
  });
  forChunks(count, grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) addOne(m_starts[m_cellOf[i] + 1]);
  });
  sumUp(m_starts);
  m_next.resize(cells);
  forChunks(cells, grain::kNumbers, [&](size_t first, size_t last) {
    std::copy(m_starts.begin() + static_cast<ptrdiff_t>(first), m_starts.begin() + static_cast<ptrdiff_t>(last),
              m_next.begin() + static_cast<ptrdiff_t>(first));
  });
  forChunks(count, grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) m_order[addOne(m_next[m_cellOf[i]])] = static_cast<uint32_t>(i);
  });
  forChunks(cells, grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t c = first; c < last; ++c) std::sort(m_order.data() + m_starts[c], m_order.data() + m_starts[c + 1]);
  });
  m_sorted = !anyChunk(count, grain::kNumbers, [&](size_t first, size_t last) {
    bool moved = false;
    for (size_t slot = first; slot < last; ++slot) moved = moved || m_order[slot] != slot;
    return moved;
  });
}

void CellGrid::reorder() {
  const size_t count = m_cellOf.size();
  m_next.resize(count);
  forChunks(count, grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t slot = first; slot < last; ++slot) {
      m_next[slot] = m_cellOf[m_order[slot]];
      m_order[slot] = static_cast<uint32_t>(slot);
    }
  });
  m_cellOf.swap(m_next);
  m_sorted = true;
}

}  // namespace ps
