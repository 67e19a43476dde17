// SPDX-License-Identifier: Apache-2.0
// Blocks of four 16-byte places are interleaved into x, y and z, as in the sums over pairs.
#include "core/solver/contact/nearneighbours.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/solver/contact/nearneighbours.cpp"
#include "hwy/foreach_target.h"  // before highway.h
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ps {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;
constexpr size_t kLanes = HWY_MIN(HWY_LANES(float), 16);

/// Block b of the place of id[4 b].
HWY_INLINE V loadBlocks(const float* base, const uint32_t* id) {
  const hn::Full128<float> d1;
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

size_t FindNear(const api::Float4* at, uint32_t i, const uint32_t* list, size_t count, float square, uint32_t* out) {
  const D d;
  const hn::Repartition<double, D> dd;
  const hn::RebindToUnsigned<D> du;
  const float* base = &at->x;
  const V px = hn::Set(d, at[i].x), py = hn::Set(d, at[i].y), pz = hn::Set(d, at[i].z), most = hn::Set(d, square);
  uint32_t tile[kLanes];
  size_t used = 0;
  for (size_t k = 0; k < count; k += kLanes) {
    const uint32_t* id = list + k;
    const size_t few = HWY_MIN(count - k, kLanes);
    if (few < kLanes) {
      for (size_t lane = 0; lane < kLanes; ++lane) tile[lane] = lane < few ? id[lane] : i;
      id = tile;
    }
    const V a0 = loadBlocks(base, id), a1 = loadBlocks(base, id + 1);
    const V a2 = loadBlocks(base, id + 2), a3 = loadBlocks(base, id + 3);
    const auto xy01 = hn::BitCast(dd, hn::InterleaveLower(d, a0, a1)),
               zw01 = hn::BitCast(dd, hn::InterleaveUpper(d, a0, a1));
    const auto xy23 = hn::BitCast(dd, hn::InterleaveLower(d, a2, a3)),
               zw23 = hn::BitCast(dd, hn::InterleaveUpper(d, a2, a3));
    const V x = hn::Sub(px, hn::BitCast(d, hn::InterleaveLower(dd, xy01, xy23)));
    const V y = hn::Sub(py, hn::BitCast(d, hn::InterleaveUpper(dd, xy01, xy23)));
    const V z = hn::Sub(pz, hn::BitCast(d, hn::InterleaveLower(dd, zw01, zw23)));
    const V distance2 = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
    auto near = hn::Lt(distance2, most);
    if (few < kLanes) near = hn::And(near, hn::FirstN(d, few));
    const auto wanted = hn::RebindMask(du, near);
    hn::StoreU(hn::Compress(hn::LoadU(du, id), wanted), du, out + used);
    used += hn::CountTrue(du, wanted);
  }
  return used;
}

}  // namespace HWY_NAMESPACE
}  // namespace ps
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ps {
namespace {
HWY_EXPORT(FindNear);
}  // namespace

size_t NearNeighbours::find(uint32_t i, float square, uint32_t* out) const {
  const uint32_t first = m_view.begin[i];
  return HWY_DYNAMIC_DISPATCH(FindNear)(m_at.data(), i, m_view.index + first, m_view.last[i] - first, square, out);
}

size_t NearNeighbours::findPlainly(uint32_t i, float square, uint32_t* out) const {
  size_t used = 0;
  for (uint32_t q = m_view.begin[i]; q < m_view.last[i]; ++q) {
    const uint32_t j = m_view.index[q];
    float x = m_at[i].x - m_at[j].x, y = m_at[i].y - m_at[j].y, z = m_at[i].z - m_at[j].z;
    m_period.shorten(x, y, z);
    if (x * x + y * y + z * z < square) out[used++] = j;
  }
  return used;
}

}  // namespace ps
#endif
