// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"
#include "core/particles/impulse.h"
#include "core/solver/structure/constraintsystem.h"

#include <utility>

namespace ps {

/// Solid particles meet as spheres of this diameter, in spacings: a little below one, so that neighbours of a lattice
/// at rest are left alone.
inline constexpr double kContactDiameter = 0.955;

/// Contact of solid particles that no constraint ties together, with each other and with static ones: spheres,
/// mass-weighted, averaged over a particle's contacts. Friction acts on the way of the substep (Macklin et al. 2014,
/// eq. 24): all of it is taken back within the static cone, else as much as the kinetic one allows; a pair has the mean
/// of its materials' coefficients, as RigidContact. Sphere contact is bumpy: a box tips as if its base were one spacing
/// narrower.
class SolidContact {
 public:
  void configure(const SolverSettings& settings, std::span<const BakedMaterial> materials);
  /// Finds the pairs that may touch as long as the lists hold, after new lists or a new structure, by the positions
  /// that the lists were made for. Members of rigid bodies (1 in `rigid`) are left to RigidContact.
  void refresh(const ParticleStore& store, const Neighbours& neighbours, ConstraintSystem& constraints,
               std::span<const uint8_t> rigid);
  void project(ParticleStore& store);
  /// Share of the solids inside a lattice that is squeezed so far that its own, untied particles meet, when the lists
  /// were made: by a third at least.
  double squeezedShare() const { return m_squeezedShare; }
  /// What fixed particles moved, kg m.
  ExternalImpulse& externalImpulse() { return m_externalImpulse; }
  /// visit(i, j) for every pair that may touch, i a solid; pairs of two solids may come from both sides.
  template <class Visit>
  void forPairs(Visit&& visit) const {
    if (!m_any) return;
    for (const Chunk& chunk : m_chunks) {
      for (size_t k = 0; k < chunk.who.size(); ++k) {
        for (uint32_t q = chunk.begin[k]; q < chunk.begin[k + 1]; ++q) visit(chunk.who[k], chunk.other[q]);
      }
    }
  }
  /// Ties of a particle inside a cubic lattice, six along the axes and twelve along the diagonals: its own structure
  /// fills all places around it, so that nothing else can touch it unless it is squeezed.
  static constexpr size_t kEnclosed = 18;

 private:
  struct Friction {
    float staticFriction, kineticFriction;
  };
  struct Chunk {
    std::vector<uint32_t> who, begin, other;
    std::vector<api::Float4> correction;
    std::vector<std::pair<uint32_t, uint32_t>> mirrored;  ///< pairs whose first is not looked at by itself
    Vector3 fromFixed;                                    ///< kg m
    size_t squeezed = 0;                                  ///< of a lattice, and yet within reach of others
  };
  api::Float4 correctionOf(const ParticleStore& store, Chunk& chunk, size_t k) const;
  void addMirrored(size_t chunks);
  size_t touching(const ParticleStore& store, const Chunk& chunk, size_t k) const;

  double m_diameter = 0, m_reach = 0;
  uint32_t m_crowded = 0;  ///< neighbours that a particle has when its lattice is squeezed
  double m_squeezedShare = 0;
  std::vector<Friction> m_friction;  ///< per material
  std::vector<Chunk> m_chunks;
  ExternalImpulse m_externalImpulse;
  std::vector<uint32_t> m_solids;
  std::vector<uint8_t> m_contacts;
  bool m_any = false;
};

}  // namespace ps
