// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"
#include "core/solver/constraintsystem.h"

namespace ps {

/// Contact of solid particles that no constraint ties together, with each other and with static ones: spheres of 0.95
/// spacings, mass-weighted, Coulomb friction on the way of the substep (Macklin et al. 2014, sections 5 and 6.1),
/// averaged over a particle's contacts. Sphere contact is bumpy: a box tips as if its base were one spacing narrower.
class SolidContact {
 public:
  void configure(const SolverSettings& settings, std::span<const BakedMaterial> materials);
  /// Finds the pairs that may touch, after a new order or a new structure, and when stale(). Members of rigid bodies (1
  /// in `rigid`) are left to RigidContact.
  void refresh(const ParticleStore& store, const Neighbours& neighbours, ConstraintSystem& constraints,
               std::span<const uint8_t> rigid);
  /// True when a solid has moved more than half the skin since the pairs were found. Liquid that splashes asks for new
  /// neighbour lists far more often than solids ask for new pairs.
  bool stale(const ParticleStore& store) const;
  void project(ParticleStore& store);

 private:
  struct Chunk {
    std::vector<uint32_t> who, begin, other;
    std::vector<api::Float4> correction;
  };
  api::Float4 correctionOf(const ParticleStore& store, const Chunk& chunk, size_t k) const;
  size_t touching(const ParticleStore& store, const Chunk& chunk, size_t k) const;

  double m_diameter = 0, m_reach = 0, m_halfSkin = 0;
  std::vector<float> m_friction;  ///< per material
  std::vector<Chunk> m_chunks;
  std::vector<uint32_t> m_solids;
  std::vector<api::Float4> m_found;  ///< where the solids were when the pairs were found
  std::vector<uint8_t> m_contacts;
  bool m_any = false;
};

}  // namespace ps
