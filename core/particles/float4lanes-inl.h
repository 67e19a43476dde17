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
using VBlock = hn::Vec<DBlock>;
constexpr size_t kLanes = HWY_MIN(HWY_LANES(float), kVirtualLanes);

template <class VT>
struct VectorsOf {
  VT x, y, z, w;
};
using Vectors4 = VectorsOf<V>;

/// The first `few` of a list of indices as a whole vector of them: where they are fewer, in `room`, filled up with
/// `filling`.
HWY_INLINE const uint32_t* wholeOf(const uint32_t* list, size_t few, uint32_t filling, uint32_t* room) {
  if (few >= kLanes) return list;
  for (size_t lane = 0; lane < kLanes; ++lane) room[lane] = lane < few ? list[lane] : filling;
  return room;
}

HWY_INLINE VBlock loadBlocks(DBlock d, const float* base, const uint32_t* id) {
  return hn::Load(d, base + 4 * size_t{id[0]});
}

/// Of a half from blocks 0 to n/2 - 1, of the other from the rest.
template <class DT>
HWY_INLINE hn::Vec<DT> loadBlocks(DT d, const float* base, const uint32_t* id) {
  const hn::Half<DT> half;
  return hn::Combine(d, loadBlocks(half, base, id + hn::MaxLanes(half)), loadBlocks(half, base, id));
}

/// Of as many particles as DT has lanes.
template <class DT>
HWY_INLINE VectorsOf<hn::Vec<DT>> loadTransposed(DT d, const api::Float4* particles, const uint32_t* id) {
  const hn::Repartition<double, DT> dd;
  const float* base = &particles->x;
  const auto a0 = loadBlocks(d, base, id), a1 = loadBlocks(d, base, id + 1);
  const auto a2 = loadBlocks(d, base, id + 2), a3 = loadBlocks(d, base, id + 3);
  const auto xy01 = hn::BitCast(dd, hn::InterleaveLower(d, a0, a1));  // x0 x1 y0 y1 in each block
  const auto zw01 = hn::BitCast(dd, hn::InterleaveUpper(d, a0, a1));
  const auto xy23 = hn::BitCast(dd, hn::InterleaveLower(d, a2, a3));
  const auto zw23 = hn::BitCast(dd, hn::InterleaveUpper(d, a2, a3));
  return {hn::BitCast(d, hn::InterleaveLower(dd, xy01, xy23)), hn::BitCast(d, hn::InterleaveUpper(dd, xy01, xy23)),
          hn::BitCast(d, hn::InterleaveLower(dd, zw01, zw23)), hn::BitCast(d, hn::InterleaveUpper(dd, zw01, zw23))};
}

HWY_INLINE Vectors4 loadTransposed(const api::Float4* particles, const uint32_t* id) {
  return loadTransposed(D(), particles, id);
}

}  // namespace HWY_NAMESPACE
}  // namespace ps
HWY_AFTER_NAMESPACE();
#endif
