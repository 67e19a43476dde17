// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/constraint.h>

#include "rotation.h"

#include <array>
#include <vector>

// Sums over the members of clusters and what follows for each of them, a vector of members at a time (Highway). Sums
// run in eight lanes that are added in one order, so that every instruction set gives the same bits. Some clusters that
// share no particle are handled by one call, which leaves the sums of each in a lane: their shapes are then found all
// at once.
namespace ps::constraint {

/// Members of one cluster, and what each of them has in the batch.
struct ClusterMembers {
  const uint32_t* particles;
  size_t count;
  std::array<const float*, 3> rest;    ///< m, place in the undeformed frame
  std::array<float*, 3> displacement;  ///< m, what the cluster has moved it by in the substep, were it free to move
  std::array<const float*, 3> way;     ///< m, of the substep, by its velocity
  const float* mass;                   ///< kg
  bool held;                           ///< a member cannot move
};

/// Where the passes leave what they have read of one cluster.
class ClusterScratch {
 public:
  enum Column { kX, kY, kZ, kW, kPreviousX, kPreviousY, kPreviousZ, kColumns };
  void begin(size_t members);
  float* column(size_t c) const { return m_columns + c * m_stride; }
  static constexpr size_t kPadding = 8;

 private:
  static constexpr size_t kFew = 128;
  size_t m_stride = 0;
  float* m_columns = nullptr;
  alignas(64) std::array<float, kColumns * kFew> m_few;
  std::vector<float> m_many;
};

/// Clusters that are handled at once, each in a lane of the arrays below.
constexpr size_t kClusterLanes = 8;
using ClusterLanes = std::array<double, kClusterLanes>;
using ClusterVectors = std::array<ClusterLanes, 3>;
using ClusterScratches = std::array<ClusterScratch, kClusterLanes>;

inline Vector laneOf(const ClusterVectors& v, size_t k) { return {v[0][k], v[1][k], v[2][k]}; }

/// Sums over members, of mass m, at x from the first of them, at rest at r, since the start of the substep gone by w.
struct alignas(64) ClusterSums {
  ClusterVectors origin;                  ///< m, of the first member: not a sum
  ClusterVectors place;                   ///< m x
  std::array<ClusterVectors, 3> moments;  ///< m x r^T
  ClusterVectors shift;                   ///< m w
  ClusterVectors turning;                 ///< m x × w
  std::array<ClusterLanes, 6> second;     ///< m x x^T: xx, yy, zz, xy, xz, yz
};

/// kg m2, about the centre, of the cluster in lane `k`, of `mass` kg.
Matrix inertiaOf(const ClusterSums& sums, size_t k, double mass);

/// Where members are pulled to, and how.
struct ClusterPull {
  Vector offset;          ///< m, where the undeformed frame's origin has gone
  Matrix turned;          ///< rotation times scale
  Vector centre;          ///< m
  Vector shift, turning;  ///< m, rad: of the whole since the start of the substep
  double friction = 0;    ///< time of inner friction over that of the substep
  double softness = 0;    ///< 1/(kappa dt2); less than 0: not pulled
};

/// Writes x - previous of `count` members, of whatever clusters, as single numbers.
void findWays(const api::ParticleView& particles, const uint32_t* members, size_t count,
              const std::array<float*, 3>& way);

/// Of `count` clusters, kClusterLanes at most. With `rubs` what friction needs as well; without it those sums stay as
/// they are.
void sumMembers(const api::ParticleView& particles, const ClusterMembers* members, size_t count, bool rubs,
                ClusterScratches& scratch, ClusterSums& out);
/// After sumMembers(): moves members, and adds to their displacements.
void pullMembers(const api::MovableParticles& particles, const ClusterMembers* members, size_t count,
                 const ClusterPull* pull, ClusterScratches& scratch);

/// What turnMembers() is made from.
struct ClusterTurns {
  ClusterSums sums;     ///< place and second
  ClusterVectors lost;  ///< kg m2: sum of m (way - x) × displacement
  ClusterLanes moved;   ///< m2: sum of the squares of displacements
};
void sumTurns(const api::ParticleView& particles, const ClusterMembers* members, size_t count,
              ClusterScratches& scratch, ClusterTurns& out);
/// After sumTurns(): adds the rigid turn by `spin` rad/s about `centre` to their velocities.
void turnMembers(const api::MovableParticles& particles, const ClusterMembers& members, Vector centre, Vector spin,
                 const ClusterScratch& scratch);

}  // namespace ps::constraint
