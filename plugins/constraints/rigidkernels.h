// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/constraint.h>

#include "rotation.h"

#include <algorithm>
#include <array>
#include <limits>

// Sums over the members of a rigid body and their places, a vector of members at a time (Highway). Sums run in eight
// lanes that are added in one order, and by chunks of members, so that every instruction set and any number of threads
// give the same bits.
namespace ps::constraint {

struct RigidMembers {
  const uint32_t* particles;
  size_t count;
  std::array<const float*, 3> rest;       ///< m, place in the undeformed frame
  const api::Threads* threads = nullptr;  ///< that share what is to be done with many
};

/// Where the members of a body are: at centre + turned (rest - restCentre).
struct RigidPose {
  Vector centre, restCentre;  ///< m
  Matrix turned;              ///< rotation times scale
};

/// Mass in kg, and the sum of mass times place in the undeformed frame; `lightest`: 1/kg, the least inverse mass of a
/// member, 0 where one is held.
struct RigidMass {
  double mass = 0, lightest = std::numeric_limits<double>::infinity();
  Vector moment;
  void operator+=(const RigidMass& other) {
    mass += other.mass, moment += other.moment;
    lightest = std::min(lightest, other.lightest);
  }
};
RigidMass massOf(const api::ParticleView& particles, const RigidMembers& members);

/// How far points have left the places of a pose, which are rounded as they are stored.
struct RigidOffset {
  bool moved = false;
  Vector shift;    ///< kg m, sum of mass times way
  Matrix moments;  ///< kg m2, sum of m (x - centre) (rest - restCentre)^T
  void operator+=(const RigidOffset& other) {
    moved = moved || other.moved;
    shift += other.shift;
    moments += other.moments;
  }
};
RigidOffset offsetOf(const api::ParticleView& particles, const RigidMembers& members, const RigidPose& pose,
                     const api::Float4* points);

void placeMembers(const RigidMembers& members, const RigidPose& pose, api::Float4* position);

/// In the undeformed frame, about the centre.
struct RigidSpread {
  Matrix second;         ///< kg m2, sum of m r r^T
  double farthest2 = 0;  ///< m2, of members from the frame's origin
  void operator+=(const RigidSpread& other) {
    second += other.second;
    farthest2 = std::max(farthest2, other.farthest2);
  }
};
RigidSpread spreadOf(const api::ParticleView& particles, const RigidMembers& members, Vector restCentre);

/// Of members at `points`, angular about `centre`.
struct RigidMomentum {
  Vector linear, angular;  ///< kg m/s, kg m2/s
  void operator+=(const RigidMomentum& other) { linear += other.linear, angular += other.angular; }
};
RigidMomentum momentumOf(const api::ParticleView& particles, const RigidMembers& members, Vector centre,
                         const api::Float4* points);
/// The same of what velocities have beyond the way of the substep, rate (position - previous).
RigidMomentum extraMomentumOf(const api::ParticleView& particles, const RigidMembers& members, Vector centre,
                              float rate);

/// Velocities of a body that turns by `spin` rad/s.
void setVelocities(const RigidMembers& members, const RigidPose& pose, Vector velocity, Vector spin, api::Float4* to);

}  // namespace ps::constraint
