// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/nearneighbours.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/solver/contact/nearneighbours.cpp"
// In this order:
// clang-format off
#include "hwy/foreach_target.h"
#include "core/particles/compressed-inl.h"
#include "core/particles/float4lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace ps {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

size_t FindNear(const api::Float4* at, uint32_t i, const uint32_t* list, size_t count, float square, uint32_t* out) {
  const D d;
  const hn::RebindToUnsigned<D> du;
  const V px = hn::Set(d, at[i].x), py = hn::Set(d, at[i].y), pz = hn::Set(d, at[i].z), most = hn::Set(d, square);
  uint32_t tile[kLanes];
  size_t used = 0;
  for (size_t k = 0; k < count; k += kLanes) {
    const size_t few = HWY_MIN(count - k, kLanes);
    const uint32_t* id = wholeOf(list + k, few, i, tile);
    const Vectors4 other = loadTransposed(at, id);
    const V x = hn::Sub(px, other.x), y = hn::Sub(py, other.y), z = hn::Sub(pz, other.z);
    const V distance2 = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
    auto near = hn::Lt(distance2, most);
    if (few < kLanes) near = hn::And(near, hn::FirstN(d, few));
    const auto wanted = hn::RebindMask(du, near);
    hn::StoreU(compressed(hn::LoadU(du, id), wanted), du, out + used);
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
