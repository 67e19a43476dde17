// SPDX-License-Identifier: Apache-2.0
// Matter that has come apart becomes a body of its own, tied as it was. Ties and groups lie in order of bodies, whose
// parameters they are called with.
#include "core/solver/structure/constraintsink.h"

namespace ps {

void ConstraintSystem::passed(const ParticleStore& store, uint32_t from, uint32_t to) {
  const auto follow = [&](auto& list, auto none) {
    if (from >= list.size()) return;
    if (to >= list.size()) list.resize(to + size_t{1}, none);
    list[to] = list[from];
  };
  follow(m_thin, uint8_t{0});
  for (Set& set : m_sets) {
    if (from >= set.used.size() || set.used[from] == 0) continue;
    follow(set.used, uint8_t{0});
    follow(set.bodyParameters, std::vector<double>{});
    refreshParameters(set);
    set.membersOf = ~size_t{0};
    if (set.groups) set.groups->bodiesChanged({store.body(), store.size()});
    if (set.structural) sortByBody(set, store);
  }
  m_graphValid = false;
}

void ConstraintSystem::sortByBody(Set& set, const ParticleStore& store) {
  m_keptParticles.resize(set.particles.size());
  m_keptValues.resize(std::max(m_keptValues.size(), set.valueCount));
  for (size_t v = 0; v < set.valueCount; ++v) m_keptValues[v].resize(set.count);
  set.runs.clear();
  for (size_t colour = 0; colour + 1 < set.colourStart.size(); ++colour) {
    const std::vector<Run> own = mergeColour(set, store, {}, {}, colour, set.colourStart[colour]);
    set.runs.insert(set.runs.end(), own.begin(), own.end());
  }
  set.particles.swap(m_keptParticles);
  for (size_t v = 0; v < set.valueCount; ++v) set.values[v].swap(m_keptValues[v]);
}

}  // namespace ps
