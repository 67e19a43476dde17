// SPDX-License-Identifier: Apache-2.0
// Highway 1.0.3 keeps the table of its own Compress for instruction sets before AVX-512 within the function: g++ copies
// it, 1 KiB, to the stack at each call, which took seven tenths of the search for neighbours.
// Included once for each instruction set: no guard of its own but Highway's.
#if defined(PS_COMPRESSED_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PS_COMPRESSED_INL_H
#undef PS_COMPRESSED_INL_H
#else
#define PS_COMPRESSED_INL_H
#endif

#include "core/particles/lanesofmask.h"

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ps {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The lanes under a mask in their order, then others. Of 32 bits each.
template <class VT, class MT>
HWY_INLINE VT compressed(VT v, MT mask) {
#if HWY_TARGET == HWY_SSSE3 || HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_AVX2
  const hn::DFromV<VT> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  uint8_t bits[8];  // as many as StoreMaskBits may write
  hn::StoreMaskBits(d, mask, bits);
  if constexpr (hn::MaxLanes(d) == 8) {
    alignas(32) static constexpr uint32_t kShifts[8] = {0, 4, 8, 12, 16, 20, 24, 28};
    const auto lanes = hn::Shr(hn::Set(du, kLanesOfEight[bits[0]]), hn::Load(du, kShifts));
    return hn::TableLookupLanes(v, hn::IndicesFromVec(d, hn::And(lanes, hn::Set(du, 7))));
  } else {
    static_assert(hn::MaxLanes(d) == 4);
    const hn::Repartition<uint8_t, decltype(d)> bytes;
    const auto from = hn::Load(bytes, kBytesOfFour.data() + 16 * size_t{bits[0]});
    return hn::BitCast(d, hn::TableLookupBytes(hn::BitCast(bytes, v), from));
  }
#else
  return hn::Compress(v, mask);
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace ps
HWY_AFTER_NAMESPACE();

#endif  // per target
