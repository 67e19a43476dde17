// SPDX-License-Identifier: Apache-2.0
// Particles are 16-byte float4. Four vectors are filled by block loads, block b of vector k from the particle
// id[4 b + k], and two levels of interleaving transpose them into x, y, z, w: several times faster than gathers.
// Included once for each instruction set: no guard of its own but Highway's.
#if defined(PS_FLOAT4LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PS_FLOAT4LANES_INL_H
#undef PS_FLOAT4LANES_INL_H
#else
#define PS_FLOAT4LANES_INL_H
#endif

#include <phasesketch/types.h>

#include "hwy/highway.h"

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace ps {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
#error "HWY_SCALAR has no 16-byte blocks: build with -mssse3 or newer"
#endif

constexpr size_t kVirtualLanes = 16;
using D = hn::CappedTag<float, kVirtualLanes>;
using V = hn::Vec<D>;
using DBlock = hn::Full128<float>;
constexpr size_t kLanes = HWY_MIN(HWY_LANES(float), kVirtualLanes);

struct Vectors4 {
  V x, y, z, w;
};

HWY_INLINE V loadBlocks(const float* base, const uint32_t* id) {
  const DBlock d1;
#if HWY_MAX_BYTES >= 64
  const hn::Half<D> d2;
  return hn::Combine(D(),
                     hn::Combine(d2, hn::Load(d1, base + 4 * size_t{id[12]}), hn::Load(d1, base + 4 * size_t{id[8]})),
                     hn::Combine(d2, hn::Load(d1, base + 4 * size_t{id[4]}), hn::Load(d1, base + 4 * size_t{id[0]})));
#elif HWY_MAX_BYTES == 32
  return hn::Combine(D(), hn::Load(d1, base + 4 * size_t{id[4]}), hn::Load(d1, base + 4 * size_t{id[0]}));
#else
  return hn::Load(d1, base + 4 * size_t{id[0]});
#endif
}

HWY_INLINE Vectors4 loadTransposed(const api::Float4* particles, const uint32_t* id) {
  const D d;
  const hn::Repartition<double, D> dd;
  const float* base = &particles->x;
  const V a0 = loadBlocks(base, id), a1 = loadBlocks(base, id + 1);
  const V a2 = loadBlocks(base, id + 2), a3 = loadBlocks(base, id + 3);
  const auto xy01 = hn::BitCast(dd, hn::InterleaveLower(d, a0, a1));  // x0 x1 y0 y1 in each block
  const auto zw01 = hn::BitCast(dd, hn::InterleaveUpper(d, a0, a1));
  const auto xy23 = hn::BitCast(dd, hn::InterleaveLower(d, a2, a3));
  const auto zw23 = hn::BitCast(dd, hn::InterleaveUpper(d, a2, a3));
  return {hn::BitCast(d, hn::InterleaveLower(dd, xy01, xy23)), hn::BitCast(d, hn::InterleaveUpper(dd, xy01, xy23)),
          hn::BitCast(d, hn::InterleaveLower(dd, zw01, zw23)), hn::BitCast(d, hn::InterleaveUpper(dd, zw01, zw23))};
}

}  // namespace HWY_NAMESPACE
}  // namespace ps
HWY_AFTER_NAMESPACE();
#endif
