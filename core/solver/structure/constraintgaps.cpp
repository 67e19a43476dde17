// SPDX-License-Identifier: Apache-2.0
// The part of ConstraintSystem that moves constraints up and into order. Matter that melts loses some of very many in
// each frame.
#include "core/solver/structure/constraintsystem.h"

#include <algorithm>

namespace ps {
namespace {

/// Share of a set that may lie before what it should follow: particles are sorted into cells anew in most frames, and
/// what moves as a whole stays nearly as it was.
constexpr double kMostDisorder = 0.25;

}  // namespace

/// Where constraints go and none come, those behind them move up, all others stay.
void ConstraintSystem::closeGaps(Set& set, std::vector<size_t> gaps) {
  std::sort(gaps.begin(), gaps.end());
  const auto close = [&](auto& column, size_t each) {
    auto to = column.begin() + static_cast<std::ptrdiff_t>(gaps[0] * each);
    for (size_t g = 0; g < gaps.size(); ++g) {
      const size_t last = g + 1 < gaps.size() ? gaps[g + 1] : set.count;
      const auto at = [&](size_t k) { return column.begin() + static_cast<std::ptrdiff_t>(k * each); };
      to = std::copy(at(gaps[g] + 1), at(last), to);
    }
    column.erase(to, column.end());
  };
  constexpr double kMicrosecondsEach = 0.001;
  const auto columns = [&](size_t first, size_t) {
    if (first < set.valueCount)
      close(set.values[first], 1);
    else
      close(set.particles, set.arity);
  };
  forChunks(set.valueCount + 1, 1, columns,
            kMicrosecondsEach * static_cast<double>((set.count - gaps[0]) * (set.valueCount + 1)));
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

/// Puts the constraints of each body and colour in order of their first particles: what lies side by side is then read
/// from side by side, and threads do not write to the same lines of memory. Nothing else depends on their order.
void ConstraintSystem::sortByParticle(Set& set, size_t particles) {
  const auto firstOf = [&](size_t k) { return set.particles[k * set.arity]; };
  const auto eachRun = [&](const auto& visit) {
    for (size_t r = 0; r < set.runs.size(); ++r)
      visit(r, set.runs[r].first, r + 1 < set.runs.size() ? set.runs[r + 1].first : set.count);
  };
  size_t behind = 0;
  eachRun([&](size_t, size_t first, size_t last) {
    for (size_t k = first + 1; k < last; ++k) behind += firstOf(k) < firstOf(k - 1) ? 1 : 0;
  });
  if (static_cast<double>(behind) <= kMostDisorder * static_cast<double>(set.count)) return;
  // Through all particles in order, each to the end of what its run has so far.
  auto& [end, ofParticle, runOf, from, next] = m_sorting;
  end.assign(particles + 1, 0);
  for (std::vector<uint32_t>* room : {&ofParticle, &runOf, &from}) room->resize(set.count);
  for (size_t k = 0; k < set.count; ++k) ++end[firstOf(k) + size_t{1}];
  for (size_t i = 0; i < particles; ++i) end[i + 1] += end[i];
  for (size_t k = 0; k < set.count; ++k) ofParticle[end[firstOf(k)]++] = static_cast<uint32_t>(k);
  next.clear();
  eachRun([&](size_t r, size_t first, size_t last) {
    next.push_back(static_cast<uint32_t>(first));
    std::fill(runOf.begin() + static_cast<std::ptrdiff_t>(first), runOf.begin() + static_cast<std::ptrdiff_t>(last),
              static_cast<uint32_t>(r));
  });
  for (const uint32_t k : ofParticle) from[next[runOf[k]]++] = k;
  m_keptParticles.resize(set.count * set.arity);
  m_keptValues.resize(std::max(m_keptValues.size(), set.valueCount));
  for (size_t v = 0; v < set.valueCount; ++v) m_keptValues[v].resize(set.count);
  const std::vector<uint32_t>& source = from;
  forChunks(set.count, grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      std::copy_n(set.particles.data() + source[k] * set.arity, set.arity, m_keptParticles.data() + k * set.arity);
      for (size_t v = 0; v < set.valueCount; ++v) m_keptValues[v][k] = set.values[v][source[k]];
    }
  });
  set.particles.swap(m_keptParticles);
  for (size_t v = 0; v < set.valueCount; ++v) set.values[v].swap(m_keptValues[v]);
}

}  // namespace ps
