// SPDX-License-Identifier: Apache-2.0
#include "core/particles/cellgrid.h"

namespace ps {

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
  const size_t count = m_cellOf.size();
  m_starts.assign(cell(0, 0, m_cells[2]) + 1, 0);
  for (const uint32_t c : m_cellOf) ++m_starts[c + 1];
  for (size_t c = 1; c < m_starts.size(); ++c) m_starts[c] += m_starts[c - 1];
  m_order.resize(count + kSpareSlots);
  m_sorted = true;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t slot = m_starts[m_cellOf[i]]++;
    m_order[slot] = static_cast<uint32_t>(i);
    m_sorted = m_sorted && slot == i;
  }
  for (size_t c = m_starts.size() - 1; c > 0; --c) m_starts[c] = m_starts[c - 1];
  m_starts[0] = 0;
}

void CellGrid::reorder() {
  m_next.resize(m_cellOf.size());
  for (size_t slot = 0; slot < m_next.size(); ++slot) m_next[slot] = m_cellOf[m_order[slot]];
  m_cellOf.swap(m_next);
  for (size_t slot = 0; slot < m_cellOf.size(); ++slot) m_order[slot] = static_cast<uint32_t>(slot);
  m_sorted = true;
}

}  // namespace ps
