// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/particlestore.h"

#include <algorithm>

namespace ps {

/// What freezes lies where it lay as a liquid: deeper in the hollows of others than solids come. That overlap is handed
/// over to it and decays, as the compression of what melts (DensityStage::handOver()), and in the same field: a solid's
/// compression offset is the spacings by which it may overlap yet. Taken back at once, it would throw a grain up at
/// metres per second. Within a piece nothing is handed over: its ties hold it. Rigid bodies need none either,
/// RigidContact gives overlap back without a push. It cannot do: tell one neighbour from another; the deepest overlap
/// is allowed with all of them.
namespace overlap {

/// Offset of what has frozen since the last substep.
inline constexpr float kUnknown = -1;
inline constexpr double kHandOverTime = 0.1;  ///< s

/// How far two may overlap yet, in spacings.
inline float allowed(const ParticleStore& store, uint32_t i, uint32_t j) {
  const auto of = [&](uint32_t p) {
    return store.motion()[p] == api::Motion::Solid ? std::max(0.0f, store.compression()[p]) : 0.0f;
  };
  return std::max(of(i), of(j));
}

}  // namespace overlap
}  // namespace ps
