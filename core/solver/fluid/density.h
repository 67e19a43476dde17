// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/impulse.h"
#include "core/particles/neighbours.h"
#include "core/particles/reactions.h"
#include "core/solver/fluid/constraintkernels.h"
#include "core/solver/fluid/nearlists.h"
#include "core/solver/fluid/pairkernels.h"
#include "core/solver/fluid/trappedfilm.h"

namespace ps {

struct DensityError {
  double mean = 0, max = 0;  ///< of max(C, 0) over liquid particles, as a fraction
  size_t liquids = 0;
};

/// Position-based density (Macklin & Mueller 2013, eq. 1 to 12) in the volume form of Solenthaler & Pajarola 2008:
/// C_i = sum_j V_j W_ij - 1 over all phases and boundary particles, an inequality (C <= 0), solved by under-relaxed
/// Jacobi steps or their Chebyshev semi-iteration (Golub & Varga 1961).
/// Solid and static particles have no constraint of their own. They count with the volume that their own kind leaves
/// them, 1/sum W (Akinci et al. 2012, eq. 4, within bounds), or else ice would sink; static ones whose body has a known
/// surface with none, since half a space behind that counts.
/// It cannot pull: there is no surface tension and no negative pressure. Pressure is that of a substep's push: sound
/// and water hammer, which live shorter, are not in it.
class DensityStage {
 public:
  /// `shapes` is asked whenever lists are refreshed, after it has been.
  void configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                 const FixedShapes& shapes = FixedShapes::none());
  /// After a change of order, of motion or of volumes: who takes part, and with which volume.
  void refresh(const ParticleStore& store, const Neighbours& neighbours);
  /// After new lists in the same order.
  void refreshLists(const ParticleStore& store, const Neighbours& neighbours);
  /// One iteration; moves fluid particles and the solids that touch them.
  void project(ParticleStore& store, const Neighbours& neighbours, int iteration);
  /// What project() moved in sum where walls or fixed particles took part, kg m. Particles among themselves move by
  /// equal and opposite amounts.
  ExternalImpulse& externalImpulse() { return m_externalImpulse; }
  /// Where walls and fixed particles are told what they get.
  void tell(Reactions& reactions) { m_reactions = &reactions; }
  /// When a frame begins, whose pressure measure() is to write.
  void startPressure() { m_multiplierSum.assign(m_volume.size(), 0); }
  /// Fixed particles of watched bodies that have fluid near, ascending.
  std::span<const uint32_t> watchedFixed() const { return m_watched; }
  /// Fixed particles have fluid near.
  bool touchesFixed() const { return m_touchesFixed; }
  /// C at the present positions, written to the store, and the mean pressure of the frame: the virial of what the
  /// iterations of a substep added up to, -1/(3 V) sum_j r f / 2 over all pairs of a particle, half of each
  /// pair its own (Irving & Kirkwood 1950). Solids and walls push by the multiplier of the liquid alone, which is
  /// larger beside them. 0 for all but liquid and vapour. What was stopped outside of the bounds stands crowded there,
  /// and is left out of the error.
  DensityError measure(ParticleStore& store, const Neighbours& neighbours, const Bounds& bounds);
  /// Hands the present compression over to particles that have just become fluid: they start without a push, and the
  /// offset decays (see handover.h). Call after refresh().
  void handOver(ParticleStore& store, const Neighbours& neighbours, std::span<const uint32_t> melted);

  /// Liquid and gas particles, ascending.
  std::span<const uint32_t> fluid() const { return m_fluid; }
  /// Solid particles that have a fluid neighbour, ascending.
  std::span<const uint32_t> wetSolids() const { return m_wet; }
  PairLists lists(const ParticleStore& store, const Neighbours& neighbours) const;
  /// Of fluids and wet solids, without what is out of reach where that is known: from project() on until there are new
  /// lists.
  PairLists nearLists(const ParticleStore& store, const Neighbours& neighbours) const {
    const PairLists all = lists(store, neighbours);
    return m_nearKnown ? m_near.lists(all) : all;
  }
  /// The room of the near lists, until the next project() or measure(): they are forgotten.
  PairRoom& lendRoom() {
    m_nearKnown = false;
    return m_near.pairs();
  }
  /// Volumes as the density sum counts them, times kernelScale(); by particle, with the dummy's 0 at the end.
  std::span<const float> volumes() const { return m_volume; }
  double kernelScale() const { return m_scale; }  ///< 1/m3: W = scale * w(q)

 private:
  void findTouched(const Neighbours& neighbours);
  void solidVolumes(const ParticleStore& store, const PairLists& lists, api::Motion motion, float least, float most);
  void weigh(const ParticleStore& store);
  void loadPoints(const ParticleStore& store);
  void multipliers(const ParticleStore& store, const PairLists& lists, float relaxation, bool findNear, size_t first,
                   size_t last);
  void makeRoom();
  void startNear(const ParticleStore& store, const PairLists& lists);
  void sumMoves(const PairLists& near, size_t first, size_t last);
  Vector3 inFilm(const ParticleStore& store, const PairLists& lists, uint32_t i, float lambda) const;
  const api::Float4* movesInFilm(const ParticleStore& store, const PairLists& lists, size_t first, size_t last);
  void move(ParticleStore& store, const PairLists& lists, size_t first, size_t last);
  void tellWalls(const ParticleStore& store);
  void tellFixed(const ParticleStore& store, const PairLists& lists);

  SolverSettings m_settings;
  HalfSpaces m_walls;
  const FixedShapes* m_shapes = nullptr;
  TrappedFilm m_film;
  double m_scale = 0, m_support = 0;
  float m_chebyshev = 1;
  std::vector<uint32_t> m_fluid, m_wet, m_some;
  std::vector<uint8_t> m_touched, m_isFluid, m_cellHasFluid;
  std::vector<float> m_volume, m_weight;
  DensityWeights m_weights;
  std::vector<api::Float4> m_points, m_multipliers;
  ChunkSum m_moved;
  ExternalImpulse m_externalImpulse;
  bool m_touchesFixed = false;
  // Of fluids. The first four have spare elements at the end (see solveConstraints()).
  std::vector<DensitySums> m_sums;
  std::vector<float> m_squares;
  std::vector<HalfSpaces::Sum> m_ofShapes;
  std::vector<DensityConstraint> m_constraints;
  std::vector<api::Float4> m_moves, m_movesInFilm;
  std::vector<api::Float4> m_carried;  ///< by particle: m and, in w, J s2 of an iteration
  std::vector<float> m_multiplierSum;  ///< J s2, by particle: of the frame
  std::vector<CompressionSums> m_compression;
  std::vector<uint32_t> m_watched;  ///< fixed particles with fluid near, of watched bodies
  std::vector<api::Float4> m_watchedMoves;
  std::vector<DensityError> m_errors;  ///< by chunk
  /// Of fluids and wet solids, from the first iteration of a substep on, with w'(q)/q of each entry.
  NearLists m_near;
  bool m_nearKnown = false;  ///< since the last lists
  Reactions* m_reactions = &Reactions::none();
};

}  // namespace ps
