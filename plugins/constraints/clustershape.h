// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "clusterkernels.h"
#include "clustermodel.h"
#include "rotation.h"
#include "rotationkernels.h"

namespace ps::constraint {

/// What of a cluster stays the same while a frame lasts. In double precision: what is rounded would push a cluster
/// the same way at each pass.
struct ClusterConstants {
  double mass = 0;    ///< kg
  Vector restCentre;  ///< m
  bool held = false;  ///< a member cannot move
  /// By the batch's masses of members, which it finds as well.
  static ClusterConstants find(const api::ParticleView& particles, const api::GroupBatch& batch, size_t group);
  void keep(const api::GroupBatch& batch, size_t group) const;
};

/// Shapes of some clusters of a batch at once, by sums over all of their members.
class ClusterFits {
 public:
  /// Of the `count` clusters from `first` on. Finds the rotations, and keeps them in the batch's values.
  void find(const api::GroupBatch& batch, size_t first, size_t count, const ClusterSums& sums);
  double mass(size_t k) const { return m_mass[k]; }
  Vector centre(size_t k) const { return laneOf(m_fits.centre, k); }
  /// Where the undeformed frame's origin goes.
  Vector offset(size_t k) const { return laneOf(m_fits.offset, k); }
  /// Rotation times scale.
  Matrix turned(size_t k) const {
    const auto row = [&](size_t i) { return laneOf(m_fits.moments[i], k); };
    return {{row(0), row(1), row(2)}};
  }

 private:
  ShapeFits m_fits;
  ClusterLanes m_mass;
};
/// kg, as kept.
double massOf(const api::GroupBatch& batch, size_t group);

/// One cluster of a batch: its undeformed shape, and where its members are pulled to. Places `k` count through the
/// batch's arrays.
class ClusterShape {
 public:
  ClusterShape(const api::ParticleView& particles, const api::GroupBatch& batch, size_t group);

  /// Finds the centre and the rotation of the members where they are, and keeps the rotation. Leaves out those with
  /// `without[k]` = 1.
  void fit(const uint8_t* without = nullptr);
  Vector goal(size_t k) const { return m_centre + m_turned * (rest(k) - m_restCentre); }
  /// Place in the undeformed frame.
  Vector rest(size_t k) const {
    const auto value = [&](ClusterModel::MemberValue v) { return m_batch.memberValues[v][k]; };
    return {value(ClusterModel::kRestX), value(ClusterModel::kRestY), value(ClusterModel::kRestZ)};
  }
  Quaternion rotation() const { return m_rotation; }
  Vector meanVelocity(const uint8_t* without) const;

  /// Cube root of the members' rest volumes against those when they joined.
  double scaleOfVolumes() const;
  /// kg m², sum m r²/3 of the undeformed shape.
  double restMoment() const;

 private:
  double mass(size_t k) const { return m_p.mass[m_batch.particles[k]]; }
  template <class Visit>
  void each(const uint8_t* without, Visit&& visit) const {
    for (size_t k = m_first; k < m_last; ++k) {
      if (!without || without[k] == 0) visit(k);
    }
  }

  const api::ParticleView& m_p;
  const api::GroupBatch& m_batch;
  size_t m_group, m_first, m_last;
  Vector m_restCentre, m_centre;
  Quaternion m_rotation;
  Matrix m_turned;  ///< rotation times scale
};

}  // namespace ps::constraint
