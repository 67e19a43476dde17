// SPDX-License-Identifier: Apache-2.0
// The part of ConstraintSystem that takes constraints out. Matter that melts loses some of very many in each frame.
#include "core/solver/structure/constraintsystem.h"

#include <algorithm>

namespace ps {

/// Where constraints go and none come, those behind them move up, all others stay.
void ConstraintSystem::closeGaps(Set& set, std::span<const uint8_t> removed) {
  std::vector<size_t> gaps;
  for (size_t k = 0; k < set.count; ++k) {
    if (removed[k] != 0) gaps.push_back(k);
  }
  const auto close = [&](auto& column, size_t each) {
    auto to = column.begin() + static_cast<std::ptrdiff_t>(gaps[0] * each);
    for (size_t g = 0; g < gaps.size(); ++g) {
      const size_t last = g + 1 < gaps.size() ? gaps[g + 1] : set.count;
      const auto at = [&](size_t k) { return column.begin() + static_cast<std::ptrdiff_t>(k * each); };
      to = std::copy(at(gaps[g] + 1), at(last), to);
    }
    column.erase(to, column.end());
  };
  close(set.particles, set.arity);
  for (size_t v = 0; v < set.valueCount; ++v) close(set.values[v], 1);
  const auto moved = [&](size_t k) {
    return k - static_cast<size_t>(std::lower_bound(gaps.begin(), gaps.end(), k) - gaps.begin());
  };
  std::vector<Run> runs;
  for (size_t r = 0; r < set.runs.size(); ++r) {
    const size_t first = moved(set.runs[r].first), end = r + 1 < set.runs.size() ? set.runs[r + 1].first : set.count;
    if (moved(end) > first) runs.push_back({first, set.runs[r].body});
  }
  for (size_t& start : set.colourStart) start = moved(start);
  set.runs = std::move(runs);
  set.count -= gaps.size();
}

}  // namespace ps
