// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "clustermodel.h"
#include "rotation.h"

#include <vector>

namespace ps::constraint {

/// A new cluster of particles, given by their places in the undeformed frame.
struct NewCluster {
  /// Fewer members do not span a volume.
  static constexpr size_t kLeastMembers = 4;
  /// Particles hang together across the axial and face-diagonal steps of a cubic lattice, 1 and 1.414 spacings.
  static constexpr double kReach = 1.5;

  std::vector<uint32_t> particles;
  std::vector<float> memberValues;

  void add(uint32_t particle, Vector rest, float volume);
  void emit(Quaternion rotation, double volume, float scale, api::GroupSink& sink) const;
};

/// Finds the clusters of newly created particles: those within a radius of the points of a coarse lattice, as far as
/// they hang together, and one more around each particle that no point has reached.
void findClusters(const api::ConstraintContext& context, const api::ParticleView& particles,
                  api::Span<const uint32_t> members, const api::GroupBatch& all, api::GroupSink& sink);

}  // namespace ps::constraint
