// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/impulse.h"
#include "core/particles/neighbours.h"
#include "core/particles/reactions.h"

#include <span>
#include <vector>

namespace ps {

/// Keeps liquid off certain solids: their particles stay a diameter apart, as spheres that slide without friction,
/// weighted by mass and averaged over a particle's contacts. Density alone keeps volumes apart, not pairs. Matter at
/// rest lies farther apart and does not notice.
class LiquidContact {
 public:
  struct Options {
    double diameter = 1;  ///< spacings
    int relaxation = 1;   ///< contacts of one particle that act at full strength, since they lean apart
  };
  explicit LiquidContact(const Options& options) : m_options(options) {}

  /// Both in m; `skin` is that of the neighbour lists.
  void configure(double spacing, double skin);
  /// After new lists or a new structure; finds the pairs of a solid and a liquid particle that may come too near.
  void refresh(const ParticleStore& store, const Neighbours& neighbours, std::span<const uint32_t> solids);
  /// Whether any liquid is near a solid.
  bool any() const { return !m_contacts.empty(); }
  void project(ParticleStore& store);
  /// What fixed particles moved, kg m.
  ExternalImpulse& externalImpulse() { return m_externalImpulse; }
  /// Where walls and fixed particles are told what they get.
  void tell(Reactions& reactions) { m_reactions = &reactions; }

 private:
  struct Contact {
    uint32_t who, begin, end;  ///< a particle, and its partners of the other kind
  };
  struct Chunk {
    std::vector<Contact> contacts;
    std::vector<uint32_t> liquids;
    std::vector<uint32_t> near;  ///< of one solid
  };
  void findLiquids(const ParticleStore& store, const Neighbours& neighbours, std::span<const uint32_t> solids,
                   Chunk& chunk) const;
  void addSolidsOfLiquids(size_t particles);
  api::Float4 moveOf(const ParticleStore& store, const Contact& contact, size_t chunk);

  Options m_options;
  float m_diameter = 0, m_reach = 0;  ///< m
  std::vector<Chunk> m_chunks;
  std::vector<Contact> m_contacts;  ///< solids, then liquids, both ascending
  std::vector<uint32_t> m_partner;
  std::vector<uint32_t> m_next;     ///< by particle, while lists are made
  std::vector<uint32_t> m_liquids;  ///< likewise
  std::vector<uint8_t> m_touching;  ///< partners too near, by particle
  std::vector<api::Float4> m_moves;
  ChunkSum m_fromFixed;
  ExternalImpulse m_externalImpulse;
  Reactions* m_reactions = &Reactions::none();
};

}  // namespace ps
