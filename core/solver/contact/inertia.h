// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"

#include <cstdint>
#include <span>

namespace ps {

class ParticleStore;

/// Particles that an impulse moves as one: where their mass is.
struct MassSpread {
  double mass = 0;         ///< kg
  Vector3 centre;          ///< m
  Matrix3 inverseInertia;  ///< 1/(kg m2), about the centre; zero along axes about which they have none
  double gyration2 = 0;    ///< m2, mean square of the distance from the centre
};

/// Of members at `points`.
MassSpread massSpread(const ParticleStore& store, std::span<const uint32_t> members, const api::Float4* points);

}  // namespace ps
