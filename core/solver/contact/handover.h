// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/parallel.h"
#include "core/particles/particlestore.h"

#include <algorithm>

namespace ps {

/// What changes its motion is in a place where it would be pushed out at once: what melts is denser than a liquid, and
/// what freezes lies where it lay as a liquid, deeper in the hollows of others than solids come. What it has then is
/// handed over to it, allowed at first and taken back within tenths of a second; at once, it would throw a grain up at
/// metres per second. The particle's compression offset has it: of a fluid the share of compression
/// (DensityStage::handOver()), of a solid the spacings by which it may overlap with what is not of its piece
/// (SolidContact). Within a piece ties hold it, and RigidContact gives overlap back without a push. It cannot do: tell
/// one neighbour from another; the deepest overlap is allowed with all of them.
namespace handover {

/// Offset of what has frozen since the last substep.
inline constexpr float kUnknownOverlap = -1;

/// How far two may overlap yet, in spacings.
inline float allowedOverlap(const ParticleStore& store, uint32_t i, uint32_t j) {
  const auto of = [&](uint32_t p) {
    return store.motion()[p] == api::Motion::Solid ? std::max(0.0f, store.compression()[p]) : 0.0f;
  };
  return std::max(of(i), of(j));
}

/// Takes some of it back from all, once per substep of `dt` s; what nobody has asked for is none.
inline void decay(ParticleStore& store, double dt) {
  constexpr double kTime = 0.1;  // s
  const float factor = static_cast<float>(1 / (1 + dt / kTime));
  float* offset = store.compression();
  forChunks(store.size(), grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) offset[i] = offset[i] < 1e-5f ? 0 : offset[i] * factor;
  });
}

}  // namespace handover
}  // namespace ps
