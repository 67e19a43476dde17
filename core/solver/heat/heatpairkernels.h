// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/types.h>

#include "core/math/kernels.h"

#include <cstddef>
#include <cstdint>

// What HeatPairs does with the neighbours of one particle, a vector of them at a time (Highway), with the same bits on
// every instruction set.
namespace ps {

/// A kernel with support in m, as pairs of particles ask for it.
struct HeatKernel {
  HeatKernel(KernelShape shape, double support);
  KernelShape shape;
  float radius;  ///< m
  float scale;   ///< 1/m3, of W
  float slope;   ///< 1/m4, of its derivative
};

/// Slots of one particle: partners of its own material lie in [begin, same), others in [other, end), with room for
/// whole vectors from `begin` to `end`.
struct HeatSlots {
  uint32_t begin, same, other, end;
};

/// Writes those of `list` that are nearer to particle i than the root of `limit` m2, and their squared distances, of
/// which none is below `least`, and returns how many they are. Writes up to 16 entries beyond the last.
size_t findHeatPartners(const api::Float4* at, uint32_t i, const uint32_t* list, size_t count, float limit, float least,
                        uint32_t* partner, float* square);

/// Sums over a particle's partners.
struct HeatSums {
  float moment = 0;  ///< V (-F) r2
  float filled = 0;  ///< V W
};
/// From squared distances in `square`: W into `kernel`, -F into `conductance`, where F r is the derivative of W. The
/// first two belong to this particle alone and begin at its first slot.
HeatSums sumHeatSlots(const HeatKernel& kernel, const HeatSlots& slots, const uint32_t* partner, const float* volume,
                      const float* square, float* kernelValue, float* conductance);

}  // namespace ps
