// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "rigidkernels.h"

#include <algorithm>
#include <functional>
#include <vector>

namespace ps::constraint {

/// What follows from the masses of a body's members and their undeformed places alone. Neither changes within a
/// substep, and a body asks for it as it is predicted, in each iteration, and when its velocity is derived.
struct RigidRest {
  RigidMass mass;
  RigidSpread spread;
};
inline RigidRest restOf(const api::ParticleView& particles, const RigidMembers& members) {
  RigidRest rest{massOf(particles, members), {}};
  if (rest.mass.lightest > 0)  // what is held does not turn
    rest.spread = spreadOf(particles, members, 1 / rest.mass.mass * rest.mass.moment);
  return rest;
}

/// Of the groups that were predicted last, told from each other by where their members lie: in ascending order, so that
/// the first one of a substep lies no higher than the last one of the substep before.
class RigidRests {
 public:
  const RigidRest& note(const api::ParticleView& particles, const RigidMembers& members) {
    const std::less<> isBelow;  // of any pointers
    if (!m_noted.empty() && !isBelow(m_noted.back().members, members.particles)) m_noted.clear();
    m_noted.push_back({members.particles, members.count, restOf(particles, members)});
    return m_noted.back().rest;
  }
  /// nullptr where it was not noted.
  const RigidRest* find(const RigidMembers& members) const {
    const auto at = std::lower_bound(m_noted.begin(), m_noted.end(), members.particles,
                                     [](const Noted& a, const uint32_t* b) { return std::less<>()(a.members, b); });
    return at != m_noted.end() && at->members == members.particles && at->count == members.count ? &at->rest : nullptr;
  }

 private:
  struct Noted {
    const uint32_t* members;
    size_t count;
    RigidRest rest;
  };
  std::vector<Noted> m_noted;
};

}  // namespace ps::constraint
