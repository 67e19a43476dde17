// SPDX-License-Identifier: Apache-2.0
#include "core/solver/structure/piecelists.h"

#include "core/base/parallelarrays.h"
#include "core/solver/structure/constraintsystem.h"

#include <algorithm>

namespace ps {

void PieceLists::refresh(std::span<const uint32_t> pieceOf) {
  findIndices(pieceOf.size(), m_tied, [&](size_t i) { return pieceOf[i] != ConstraintSystem::kNoPiece; });
  findIndices(pieceOf.size(), m_first, [&](size_t i) { return pieceOf[i] == i; });
  const auto firstOf = [&](size_t k) { return pieceOf[m_tied[k]]; };
  findIndices(m_tied.size(), m_runs, [&](size_t k) { return k == 0 || firstOf(k) != firstOf(k - 1); });
  lengthen(m_number, pieceOf.size());
  for (size_t piece = 0; piece < count(); ++piece) m_number[m_first[piece]] = static_cast<uint32_t>(piece);
  const auto endOf = [&](size_t run) { return run + 1 < m_runs.size() ? m_runs[run + 1] : m_tied.size(); };
  m_begin.assign(count() + 1, 0);
  for (size_t run = 0; run < m_runs.size(); ++run)
    m_begin[m_number[firstOf(m_runs[run])] + size_t{1}] += endOf(run) - m_runs[run];
  for (size_t piece = 0; piece < count(); ++piece) m_begin[piece + 1] += m_begin[piece];
  m_next.assign(m_begin.begin(), m_begin.end() - 1);
  m_to.resize(m_runs.size());
  for (size_t run = 0; run < m_runs.size(); ++run) {
    size_t& next = m_next[m_number[firstOf(m_runs[run])]];
    m_to[run] = static_cast<uint32_t>(next);
    next += endOf(run) - m_runs[run];
  }
  lengthen(m_members, m_tied.size());
  forChunks(m_tied.size(), grain::kNumbers, [&](size_t first, size_t last) {
    size_t run = static_cast<size_t>(std::upper_bound(m_runs.begin(), m_runs.end(), first) - m_runs.begin()) - 1;
    for (; first < last; ++run) {
      const size_t end = std::min<size_t>(last, endOf(run));
      std::copy(m_tied.data() + first, m_tied.data() + end, m_members.data() + m_to[run] + (first - m_runs[run]));
      first = end;
    }
  });
}

}  // namespace ps
