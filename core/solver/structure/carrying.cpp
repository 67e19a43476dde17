// SPDX-License-Identifier: Apache-2.0
// What structure makes of matter that is carried to another place between two frames.
#include "core/solver/structure/constraintsystem.h"

#include <algorithm>
#include <utility>

namespace ps {

void ConstraintSystem::takeAlong(const ParticleStore& store, std::vector<uint8_t>& goes) {
  const StructureGraph& ties = graph(store.size());
  const auto moves = [&](uint32_t i) { return store.velocity()[i].w > 0; };
  std::vector<std::span<const uint32_t>> groups;  // by their serial in the graph
  for (const Set& set : m_sets) {
    for (size_t g = 0; set.groups && g < set.groups->count(); ++g) groups.push_back(set.groups->members(g));
  }
  std::vector<uint8_t> seen(groups.size(), 0);
  m_open.clear();
  for (uint32_t i = 0; i < store.size(); ++i) {
    if (goes[i] != 0 && moves(i)) m_open.push_back(i);
  }
  const auto reach = [&](uint32_t i) {
    if (goes[i] == 0 && moves(i)) goes[i] = 1, m_open.push_back(i);
  };
  while (!m_open.empty()) {
    const uint32_t i = m_open.back();
    m_open.pop_back();
    for (uint32_t k = ties.begin[i]; k < ties.begin[i + 1]; ++k) reach(ties.partner[k]);
    for (uint32_t k = ties.groupBegin[i]; k < ties.groupBegin[i + 1]; ++k) {
      if (std::exchange(seen[ties.group[k]], uint8_t{1}) != 0) continue;
      for (const uint32_t member : groups[ties.group[k]]) reach(member);
    }
  }
}

void ConstraintSystem::carry(ParticleStore& store, std::span<const uint8_t> goes, const api::Carrying& carrying) {
  const api::ParticleView view = store.view();
  for (Set& set : m_sets) {
    if (!set.groups || set.groups->count() == 0 || set.disabled) continue;
    const auto* poses = static_cast<const api::GroupPoses*>(set.plugin->extension(api::kGroupPoses));
    if (!poses) continue;
    std::vector<uint8_t> carried(set.groups->count(), 0);
    for (size_t g = 0; g < carried.size(); ++g) {
      const std::span<const uint32_t> members = set.groups->members(g);
      const bool any = std::any_of(members.begin(), members.end(),
                                   [&](uint32_t i) { return goes[i] != 0 && store.velocity()[i].w > 0; });
      carried[g] = any ? 1 : 0;
    }
    GroupLists::Batch all;
    set.groups->fill(all, 0, set.groups->count());
    guarded(set, [&] {
      poses->carry(context(set, m_settings.dt, 0, 0), movable(store, view), all.view, carried.data(), carrying);
    });
  }
}

}  // namespace ps
