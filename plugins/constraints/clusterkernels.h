// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/constraint.h>

#include "rotation.h"

#include <array>
#include <vector>

// Sums over the members of a cluster and what follows for each of them, a vector of members at a time (Highway). Sums
// run in eight lanes that are added in one order, so that every instruction set gives the same bits.
namespace ps::constraint {

/// Members of one cluster, and what each of them has in the batch.
struct ClusterMembers {
  const uint32_t* particles;
  size_t count;
  std::array<const float*, 3> rest;  ///< m, place in the undeformed frame
  std::array<float*, 3> multiplier;  ///< kg m
  std::array<const float*, 3> way;   ///< m, of the substep, by its velocity
};

/// Members as the passes read them; places in m from the first member.
class ClusterScratch {
 public:
  enum Column { kX, kY, kZ, kWayX, kWayY, kWayZ, kColumns };
  enum Weight { kMass, kInverseMass, kWeights };
  /// Reads who the last members are, and all masses; beyond the last one, up to a whole number of vectors, stands the
  /// first without mass.
  void begin(const api::ParticleView& particles, const ClusterMembers& members);
  double* column(size_t c) const { return m_columns + c * m_stride; }
  float* weight(size_t c) const { return m_weights + c * m_stride; }
  /// Particles of the members from `first`, a multiple of kPadding, as many as that.
  const uint32_t* particles(const ClusterMembers& members, size_t first) const {
    return first + kPadding <= members.count ? members.particles + first : m_last.data();
  }
  static constexpr size_t kPadding = 8;

 private:
  static constexpr size_t kFew = 128;
  size_t m_stride = 0;
  double* m_columns = nullptr;
  float* m_weights = nullptr;
  alignas(64) std::array<double, kColumns * kFew> m_few;
  alignas(64) std::array<float, kWeights * kFew> m_fewWeights;
  alignas(64) std::array<uint32_t, kPadding> m_last;
  std::vector<double> m_many;
  std::vector<float> m_manyWeights;
};

/// Sums over members, of mass m, at x from the first of them, at rest at r, since the start of the substep gone by w.
struct ClusterSums {
  double mass = 0;
  Vector origin;       ///< m, of the first member: not a sum
  Vector place, rest;  ///< m x, m r
  Matrix moments;      ///< m x r^T
  Vector shift;        ///< m w
  Vector turning;      ///< m x × w
  Matrix second;       ///< m x x^T
  Vector centre() const { return 1 / mass * place; }
  /// kg m2, about the centre.
  Matrix inertia() const;
};

/// Where members are pulled to, and how.
struct ClusterPull {
  Vector centre, restCentre;  ///< m, from the first member; in the undeformed frame
  Matrix turned;              ///< rotation times scale
  Vector shift, turning;      ///< m, rad: of the whole since the start of the substep
  double friction = 0;        ///< time of inner friction over that of the substep
  double softness = 0;        ///< 1/(kappa dt2)
};

/// Writes x - previous of `count` members, of whatever clusters, as single numbers.
void findWays(const api::ParticleView& particles, const uint32_t* members, size_t count,
              const std::array<float*, 3>& way);

/// With `rubs` what friction needs as well; without it those sums stay 0.
ClusterSums sumsOf(const api::ParticleView& particles, const ClusterMembers& members, bool rubs,
                   ClusterScratch& scratch);
/// After sumsOf(): moves members, and adds to their multipliers.
void pullMembers(const api::MovableParticles& particles, const ClusterMembers& members, const ClusterPull& pull,
                 ClusterScratch& scratch);

/// What turnMembers() is made from.
struct ClusterTurn {
  ClusterSums sums;    ///< mass, place and second
  Vector lost;         ///< kg m2: sum of (way - place) × multiplier
  bool moved = false;  ///< a multiplier is not 0
  bool held = false;   ///< a member cannot move
};
ClusterTurn turnOf(const api::ParticleView& particles, const ClusterMembers& members, ClusterScratch& scratch);
/// After turnOf(): adds the rigid turn by `spin` rad/s about the centre to their velocities.
void turnMembers(const api::MovableParticles& particles, const ClusterMembers& members, Vector centre, Vector spin,
                 ClusterScratch& scratch);

}  // namespace ps::constraint
