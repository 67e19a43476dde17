// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/nearwalls.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/solver/contact/nearwalls.cpp"
// In this order:
// clang-format off
#include "hwy/foreach_target.h"
#include "core/particles/compressed-inl.h"
#include "core/particles/float4lanes-inl.h"
#include "core/solver/contact/wallheights-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace ps {
namespace HWY_NAMESPACE {

void FindNearWalls(std::span<const WallSurface> walls, const WallSet& met, float reach,
                   std::span<const api::Float4> places, std::span<WallSet> near) {
  const D d;
  const hn::RebindToUnsigned<D> du;
  for (size_t k = 0; k < places.size(); k += kLanes) {
    const size_t count = HWY_MIN(kLanes, places.size() - k);
    alignas(64) uint32_t id[kLanes];
    for (size_t lane = 0; lane < kLanes; ++lane) id[lane] = static_cast<uint32_t>(k + HWY_MIN(lane, count - 1));
    const Vectors4 place = loadTransposed(places.data(), id);
    auto bits = hn::Zero(du);
    met.forEach(walls.size(), [&](size_t wall) HWY_ATTR {
      const auto far = hn::RebindMask(du, hn::Gt(overWall(walls[wall], place).height, hn::Set(d, reach)));
      bits = hn::Or(bits, hn::IfThenZeroElse(far, hn::Set(du, WallSet::bitOf(wall))));
    });
    hn::Store(bits, du, id);
    for (size_t lane = 0; lane < count; ++lane) near[k + lane] = WallSet::ofBits(id[lane]);
  }
}

size_t FindBelow(std::span<const WallSurface> walls, const WallSet& met, const api::Float4* places,
                 const uint32_t* which, size_t first, size_t last, uint32_t* out) {
  const D d;
  const hn::RebindToUnsigned<D> du;
  size_t used = 0;
  for (size_t k = first; k < last; k += kLanes) {
    const size_t count = HWY_MIN(kLanes, last - k);
    alignas(64) uint32_t id[kLanes];
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const size_t at = k + HWY_MIN(lane, count - 1);
      id[lane] = which != nullptr ? which[at] : static_cast<uint32_t>(at);
    }
    const Vectors4 place = loadTransposed(places, id);
    auto below = hn::FirstN(d, 0);
    met.forEach(walls.size(), [&](size_t wall) HWY_ATTR {
      below = hn::Or(below, hn::Lt(overWall(walls[wall], place).height, hn::Zero(d)));
    });
    const auto found = hn::RebindMask(du, hn::And(below, hn::FirstN(d, count)));
    if (hn::AllFalse(du, found)) continue;
    hn::StoreU(compressed(hn::Load(du, id), found), du, out + used);
    used += hn::CountTrue(du, found);
  }
  return used;
}

}  // namespace HWY_NAMESPACE
}  // namespace ps
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ps {
HWY_EXPORT(FindNearWalls);
HWY_EXPORT(FindBelow);
void findNearWalls(std::span<const WallSurface> walls, float reach, std::span<const api::Float4> places,
                   std::span<WallSet> near) {
  const WallSet met = wallsBelow(walls, reach, places);
  if (met.any())
    HWY_DYNAMIC_DISPATCH(FindNearWalls)(walls, met, reach, places, near);
  else
    std::fill(near.begin(), near.end(), WallSet());
}
size_t findBelow(std::span<const WallSurface> walls, const WallSet& met, const api::Float4* places,
                 const uint32_t* which, size_t first, size_t last, uint32_t* out) {
  return HWY_DYNAMIC_DISPATCH(FindBelow)(walls, met, places, which, first, last, out);
}
}  // namespace ps
#endif
