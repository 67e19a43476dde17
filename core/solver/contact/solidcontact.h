// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/parallel.h"
#include "core/matter/material.h"
#include "core/particles/impulse.h"
#include "core/particles/reactions.h"
#include "core/solver/contact/fixedsurface.h"
#include "core/solver/contact/latticesurface.h"
#include "core/solver/structure/constraintsystem.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace ps {

/// Solid particles meet as spheres of this diameter, in spacings: a little below one, so that neighbours of a lattice
/// at rest are left alone.
inline constexpr double kContactDiameter = 0.955;

/// Whether j belongs to the same lattice as i: tied to it, or, in a lattice of axial ties, to what that is tied to.
bool sameLattice(const StructureGraph& graph, uint32_t i, uint32_t j);

/// Contact of solid particles that no constraint ties together, with each other and with static ones: mass-weighted,
/// averaged over a particle's contacts. Where a face of a lattice takes part they meet along its normal, as in
/// RigidContact, so that lattices do not interlock; all else, grains, ropes and edges, as spheres, which is bumpy: a
/// box tips as if its base were one spacing narrower. Friction acts on the way of the substep (Macklin et al. 2014,
/// eq. 24): all of it is taken back within the static cone, else as much as the kinetic one allows; a pair has the mean
/// of its materials' coefficients, as RigidContact. It cannot do: a smooth surface where a lattice's layers are steps,
/// on a slope that is not one of its planes.
class SolidContact {
 public:
  void configure(const SolverSettings& settings, std::span<const BakedMaterial> materials);
  /// Finds the pairs that may touch as long as the lists hold, after new lists or a new structure, by the positions
  /// that the lists were made for. `pieceOf` as ConstraintSystem::pieces() has it: within a piece all are round.
  /// Members of rigid bodies (1 in `rigid`) are left to RigidContact.
  void refresh(const ParticleStore& store, const Neighbours& neighbours, ConstraintSystem& constraints,
               std::span<const uint32_t> pieceOf, std::span<const uint8_t> rigid);
  /// Before the substeps of a frame: what is fixed may have been put elsewhere.
  void startFrame() { std::fill(m_stood.begin(), m_stood.end(), uint8_t{0}); }
  /// Once per substep, when positions have been predicted: finds along what the pairs meet. What has just frozen is
  /// handed its overlap, see handover.h.
  void begin(ParticleStore& store);
  void project(ParticleStore& store);
  /// Share of the solids inside a lattice that is squeezed so far that its own, untied particles meet, when the lists
  /// were made: by a third at least.
  double squeezedShare() const { return m_squeezedShare; }
  /// By particle, kg m2: what pushes in this substep, acting half way between two solids (where one of them is tied to
  /// nothing, at that one), would have turned its piece more than they did, acting at its centre. Empty where nothing
  /// may touch.
  std::span<const api::Float4> couple() const { return m_any ? m_couple : std::span<const api::Float4>(); }
  /// After begin(): the face of a particle that may touch others; none: no neighbours.
  LatticeSurface::Normal faceOf(uint32_t i) const {
    return m_any && m_surface.has(i) ? m_normals[m_surface.slotOf(i)] : LatticeSurface::Normal{};
  }
  /// What fixed particles moved, kg m.
  ExternalImpulse& externalImpulse() { return m_externalImpulse; }
  /// Where walls and fixed particles are told what they get.
  void tell(Reactions& reactions) { m_reactions = &reactions; }
  /// visit(chunk, i, j, normal) for every pair that may touch, i a solid; pairs of two solids may come from both sides.
  /// The normal from j to i is that of a face, its w the distance in m at which the two rest; 0 for round ones. From
  /// several threads, those of one chunk, below pairChunks(), from one of them in their order.
  template <class Visit>
  void forPairs(const Visit& visit) const {
    if (!m_any) return;
    forChunks(m_chunks.size(), 1, [&](size_t first, size_t last) {
      for (size_t c = first; c < last; ++c) {
        const Chunk& chunk = m_chunks[c];
        for (size_t k = 0; k < chunk.who.size(); ++k) {
          for (uint32_t q = chunk.begin[k]; q < chunk.begin[k + 1]; ++q)
            visit(c, chunk.who[k], chunk.other[q], chunk.facing[q]);
        }
      }
    });
  }
  size_t pairChunks() const { return m_chunks.size(); }
  /// Ties of a particle inside a cubic lattice, six along the axes and twelve along the diagonals: its own structure
  /// fills all places around it, so that nothing else can touch it unless it is squeezed.
  static constexpr size_t kEnclosed = 18;

 private:
  /// What is asked of a particle as one of a pair.
  enum Kind : uint8_t {
    kTouches = 1,    ///< solid or static, and not of a rigid body
    kOfLattice = 2,  ///< tied, or static
    kMoves = 4,      ///< solid, free to move, and not of a rigid body
    kInside = 8,     ///< as many ties as inside a lattice
    kShut = 16,      ///< and not squeezed: nothing can touch it
  };
  struct Friction {
    float staticFriction, kineticFriction;
  };
  struct Chunk {
    std::vector<uint32_t> who, begin, other, near;
    std::vector<api::Float4> correction;
    std::vector<api::Float4> facing;                      ///< by pair: a face's normal, w its distance in m or 0
    std::vector<std::pair<uint32_t, uint32_t>> mirrored;  ///< pairs whose first is not looked at by itself
    Vector3 fromFixed;                                    ///< kg m
    size_t squeezed = 0;                                  ///< of a lattice, and yet within reach of others
  };
  /// A pair that overlaps.
  struct Touch {
    float x, y, z;  ///< unit normal
    float depth;    ///< m, or 0: apart
    bool face;
  };
  Touch overlapOf(const ParticleStore& store, const Chunk& chunk, size_t k, size_t q) const;
  /// Without the overlap that is allowed yet.
  Touch touchOf(const ParticleStore& store, const Chunk& chunk, size_t k, size_t q) const;
  api::Float4 correctionOf(const ParticleStore& store, Chunk& chunk, size_t k);
  static void markRound(Chunk& chunk, std::span<const uint32_t> pieceOf);
  void findKinds(const ParticleStore& store, const Neighbours& neighbours, const StructureGraph& graph,
                 std::span<const uint8_t> rigid);
  void findPairs(const ParticleStore& store, const Neighbours& neighbours, const StructureGraph& graph,
                 std::span<const uint32_t> pieceOf);
  /// Adds to the chunk what particle i may touch.
  void findPairsOf(uint32_t i, const ParticleStore& store, std::span<const api::Float4> at, const StructureGraph& graph,
                   std::span<const uint32_t> pieceOf, const NearNeighbours& near, Chunk& chunk) const;
  void addMirrored(size_t chunks, size_t particles);
  void findSurfaces(const ParticleStore& store, const Neighbours& neighbours, const StructureGraph& graph);
  template <class Body>
  void everywhere(const Body& body) {
    forChunks(m_chunks.size(), 1, [&](size_t first, size_t last) {
      for (size_t c = first; c < last; ++c) {
        for (size_t k = 0; k < m_chunks[c].who.size(); ++k) body(m_chunks[c], k);
      }
    });
  }
  void findNormals(const ParticleStore& store);
  void handOver(ParticleStore& store);
  size_t touching(const ParticleStore& store, const Chunk& chunk, size_t k) const;

  double m_spacing = 0, m_diameter = 0, m_reach = 0, m_faceReach = 0;  ///< m
  uint32_t m_crowded = 0;  ///< neighbours that a particle has when its lattice is squeezed
  double m_squeezedShare = 0;
  std::vector<Friction> m_friction;           ///< per material
  std::vector<Chunk> m_chunks;                ///< of m_solids, and behind them of those that are mirrored
  std::vector<uint32_t> m_mirrored, m_place;  ///< who mirrored ones meet, and where those of a particle end
  ExternalImpulse m_externalImpulse;
  Reactions* m_reactions = &Reactions::none();
  std::vector<uint32_t> m_solids;
  std::vector<uint8_t> m_kinds;  ///< of Kind, when the lists were made
  std::vector<uint8_t> m_contacts;
  std::vector<uint8_t> m_loose;  ///< 1: tied to nothing
  std::vector<api::Float4> m_couple;
  LatticeSurface m_surface;  ///< of those that may touch and belong to a lattice
  FixedSurface m_fixed;
  std::vector<LatticeSurface::Normal> m_normals;  ///< by its slots
  std::vector<uint8_t> m_isKept;                  ///< by its slots; 1: of m_fixed
  std::vector<uint8_t> m_stood;                   ///< by its slots; 1: has its normal, and nothing has moved since
  bool m_any = false;
};

}  // namespace ps
