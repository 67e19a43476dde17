// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/neighbours.h"

#include <vector>

namespace ps {

/// Keeps liquid out of solids: their particles stay 0.8 spacings apart, weighted by mass and averaged over a particle's
/// contacts. Density alone keeps volumes apart, not pairs: what is squeezed, or thick, sinks into a lattice. Matter at
/// rest lies farther apart and does not notice.
class WetContact {
 public:
  void configure(double spacing);
  /// After new lists: who has a partner. `wet`: solids with fluid in their list.
  void refreshLists(const ParticleStore& store, const Neighbours& neighbours, std::span<const uint32_t> wet);
  void project(ParticleStore& store, const Neighbours& neighbours);

 private:
  template <class Visit>
  void forPartners(const ParticleStore& store, const api::NeighbourView& view, uint32_t i, Visit&& visit) const;

  float m_distance = 0;  ///< m
  std::vector<uint32_t> m_who;
  std::vector<uint8_t> m_isWho, m_contacts;
  std::vector<api::Float4> m_move;
};

}  // namespace ps
