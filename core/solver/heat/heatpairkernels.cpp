// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heat/heatpairkernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/solver/heat/heatpairkernels.cpp"
// In this order:
// clang-format off
#include "hwy/foreach_target.h"
#include "core/particles/compressed-inl.h"
#include "core/solver/fluid/pairkernels-inl.h"
// clang-format on

#include <numbers>

HWY_BEFORE_NAMESPACE();
namespace ps {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DU = hn::RebindToUnsigned<D>;

size_t FindHeatPartners(const api::Float4* at, uint32_t i, const uint32_t* list, size_t count, float limit, float least,
                        uint32_t* partner, float* square) {
  const D d;
  const DU du;
  const V px = hn::Set(d, at[i].x), py = hn::Set(d, at[i].y), pz = hn::Set(d, at[i].z), most = hn::Set(d, limit);
  uint32_t tile[kLanes];
  size_t used = 0;
  for (size_t k = 0; k < count; k += kLanes) {
    const size_t few = HWY_MIN(count - k, kLanes);
    const uint32_t* id = wholeOf(list + k, few, i, tile);
    const Vectors4 other = loadTransposed(at, id);
    const V x = hn::Sub(px, other.x), y = hn::Sub(py, other.y), z = hn::Sub(pz, other.z);
    const V r2 = hn::Max(hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z)), hn::Set(d, least));
    auto near = hn::Lt(r2, most);
    if (few < kLanes) near = hn::And(near, hn::FirstN(d, few));
    const auto wanted = hn::RebindMask(du, near);
    hn::StoreU(compressed(hn::LoadU(du, id), wanted), du, partner + used);
    hn::StoreU(compressed(r2, near), d, square + used);
    used += hn::CountTrue(du, wanted);
  }
  return used;
}

struct Values {
  V value, slope;  ///< W, -F
};
HWY_INLINE Values valuesOf(const HeatKernel& kernel, V r2) {
  const D d;
  const V one = hn::Set(d, 1), r = hn::Sqrt(r2), q = hn::Mul(r, hn::Set(d, 1.0f / kernel.radius));
  const V a = hn::Sub(one, q), scale = hn::Set(d, kernel.scale), slope = hn::Div(hn::Set(d, kernel.slope), r);
  const V a2 = hn::Mul(a, a);
  if (kernel.shape == KernelShape::CubicSpline) {
    const V b = hn::Max(hn::Sub(hn::Set(d, 0.5f), q), hn::Zero(d)), b2 = hn::Mul(b, b);
    return {hn::Mul(scale, hn::Sub(hn::Mul(hn::Set(d, 2), hn::Mul(a2, a)), hn::Mul(hn::Set(d, 8), hn::Mul(b2, b)))),
            hn::Mul(slope, hn::Sub(hn::Mul(hn::Set(d, 6), a2), hn::Mul(hn::Set(d, 24), b2)))};
  }
  return {hn::Mul(scale, hn::Mul(hn::Mul(a2, a2), hn::Add(one, hn::Mul(hn::Set(d, 4), q)))),
          hn::Mul(slope, hn::Mul(hn::Mul(hn::Set(d, 20), q), hn::Mul(a2, a)))};
}

void SumHeatSlots(const HeatKernel& kernel, const HeatSlots& slots, const uint32_t* partner, const float* volume,
                  const float* square, float* kernelValue, float* conductance, HeatSums& out) {
  const D d;
  const DU du;
  Lanes moment, filled;
  for (uint32_t from = slots.begin; from < slots.end; from += kVirtualLanes) {
    if (from >= slots.same && from + kVirtualLanes <= slots.other) continue;
    for (size_t part = 0; part < kParts; ++part) {
      const uint32_t k = from + static_cast<uint32_t>(part * kLanes);
      const auto number = hn::Add(hn::Iota(du, 0), hn::Set(du, k));
      const auto taken =
          hn::Or(hn::Lt(number, hn::Set(du, slots.same)), hn::Not(hn::Lt(number, hn::Set(du, slots.other))));
      const auto wanted = hn::RebindMask(d, taken);
      const V r2 = hn::IfThenElse(wanted, hn::LoadU(d, square + (k - slots.begin)), hn::Set(d, 1));
      const Values pair = valuesOf(kernel, r2);
      hn::StoreU(pair.value, d, kernelValue + (k - slots.begin));
      hn::StoreU(pair.slope, d, conductance + k);
      const auto id = hn::BitCast(hn::RebindToSigned<D>(), hn::IfThenElseZero(taken, hn::LoadU(du, partner + k)));
      const V v = hn::IfThenElseZero(wanted, hn::GatherIndex(d, volume, id));
      moment.add(part, hn::Mul(v, hn::Mul(pair.slope, r2)));
      filled.add(part, hn::Mul(v, pair.value));
    }
  }
  out = {sumOne(moment), sumOne(filled)};
}

}  // namespace HWY_NAMESPACE
}  // namespace ps
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ps {
namespace {
HWY_EXPORT(FindHeatPartners);
HWY_EXPORT(SumHeatSlots);
}  // namespace

HeatKernel::HeatKernel(KernelShape kernel, double support) : shape(kernel), radius(static_cast<float>(support)) {
  const bool spline = shape == KernelShape::CubicSpline;
  const double perVolume = (spline ? 8 : 21.0 / 2) / (std::numbers::pi * support * support * support);
  scale = static_cast<float>(perVolume);
  slope = static_cast<float>(perVolume / support);
}

size_t findHeatPartners(const api::Float4* at, uint32_t i, const uint32_t* list, size_t count, float limit, float least,
                        uint32_t* partner, float* square) {
  return HWY_DYNAMIC_DISPATCH(FindHeatPartners)(at, i, list, count, limit, least, partner, square);
}

HeatSums sumHeatSlots(const HeatKernel& kernel, const HeatSlots& slots, const uint32_t* partner, const float* volume,
                      const float* square, float* kernelValue, float* conductance) {
  HeatSums sums;
  HWY_DYNAMIC_DISPATCH(SumHeatSlots)(kernel, slots, partner, volume, square, kernelValue, conductance, sums);
  return sums;
}

}  // namespace ps
#endif
