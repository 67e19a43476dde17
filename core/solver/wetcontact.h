// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/neighbours.h"

#include <vector>

namespace ps {

/// Keeps liquid out of solids: their particles stay 0.76 spacings apart, weighted by mass and averaged over a
/// particle's contacts. Density alone keeps volumes apart, not pairs: what is squeezed, or thick, sinks into a lattice.
/// Matter at rest lies farther apart and does not notice.
class WetContact {
 public:
  /// Both in m; `skin` is that of the neighbour lists.
  void configure(double spacing, double skin);
  /// After new lists: who has a partner. `wet`: solids with fluid in their list.
  void refreshLists(const ParticleStore& store, const Neighbours& neighbours, std::span<const uint32_t> wet);
  void project(ParticleStore& store);

 private:
  template <class Visit>
  void forPartners(const ParticleStore& store, size_t k, Visit&& visit) const;
  void findPartners(const ParticleStore& store, const Neighbours& neighbours, uint32_t i, api::Motion wanted);

  float m_distance = 0, m_reach = 0;  ///< m
  std::vector<size_t> m_begin;        ///< of each of `m_who` in m_partner, and the end
  std::vector<uint32_t> m_partner, m_found;
  std::vector<uint32_t> m_who;
  std::vector<uint8_t> m_contacts;
  std::vector<api::Float4> m_move;
};

}  // namespace ps
