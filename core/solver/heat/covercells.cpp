// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heat/covercells.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/solver/heat/covercells.cpp"
// In this order:
// clang-format off
#include "hwy/foreach_target.h"
#include "core/particles/float4lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace ps {
namespace HWY_NAMESPACE {

using DI = hn::RebindToSigned<D>;
using DU = hn::RebindToUnsigned<D>;

/// coverCellOf(), operation by operation.
HWY_INLINE hn::Vec<DI> cellsOf(V x, V y, V z) {
  const D d;
  const DI di;
  const V ax = hn::Abs(x), ay = hn::Abs(y), az = hn::Abs(z);
  const auto alongY = hn::And(hn::Gt(ay, ax), hn::Ge(ay, az)), alongZ = hn::AndNot(alongY, hn::Gt(az, ax));
  const V major = hn::IfThenElse(alongY, y, hn::IfThenElse(alongZ, z, x));
  const V u = hn::IfThenElse(hn::Or(alongY, alongZ), x, y), v = hn::IfThenElse(alongZ, y, z);
  const auto either = [&](auto mask, int yes, hn::Vec<DI> no)
                          HWY_ATTR { return hn::IfThenElse(hn::RebindMask(di, mask), hn::Set(di, yes), no); };
  const auto face =
      hn::Add(either(alongY, 2, either(alongZ, 4, hn::Zero(di))), either(hn::Lt(major, hn::Zero(d)), 1, hn::Zero(di)));
  const V half = hn::Set(d, 0.5f * kCoverCells), scale = hn::Div(half, hn::Abs(major));
  const auto cell = [&](V w) HWY_ATTR {
    const auto whole = hn::ConvertTo(di, hn::Add(hn::Mul(w, scale), half));
    return hn::Min(hn::Max(whole, hn::Zero(di)), hn::Set(di, kCoverCells - 1));
  };
  const auto cells = hn::Set(di, kCoverCells);
  return hn::Add(hn::Mul(hn::Add(hn::Mul(face, cells), cell(u)), cells), cell(v));
}

size_t FindCoverCells(const api::Float4* at, uint32_t i, const uint32_t* list, size_t count, float least, float most,
                      uint32_t* neighbour, uint32_t* cell) {
  const D d;
  const DU du;
  const V px = hn::Set(d, at[i].x), py = hn::Set(d, at[i].y), pz = hn::Set(d, at[i].z);
  uint32_t tile[kLanes];
  size_t used = 0;
  for (size_t k = 0; k < count; k += kLanes) {
    const size_t few = HWY_MIN(count - k, kLanes);
    const uint32_t* id = wholeOf(list + k, few, i, tile);
    const Vectors4 other = loadTransposed(at, id);
    const V x = hn::Sub(other.x, px), y = hn::Sub(other.y, py), z = hn::Sub(other.z, pz);
    const V square = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
    auto near = hn::And(hn::Le(square, hn::Set(d, most)), hn::Ge(square, hn::Set(d, least)));
    if (few < kLanes) near = hn::And(near, hn::FirstN(d, few));
    const auto wanted = hn::RebindMask(du, near);
    hn::StoreU(hn::Compress(hn::LoadU(du, id), wanted), du, neighbour + used);
    hn::StoreU(hn::Compress(hn::BitCast(du, cellsOf(x, y, z)), wanted), du, cell + used);
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
HWY_EXPORT(FindCoverCells);
}  // namespace

size_t coverCellOf(float x, float y, float z) {
  const float ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
  float major = x, u = y, v = z;
  size_t face = 0;
  if (ay > ax && ay >= az) {
    major = y, u = x, v = z;
    face = 2;
  } else if (az > ax) {
    major = z, u = x, v = y;
    face = 4;
  }
  if (major < 0) ++face;
  const float scale = 0.5f * kCoverCells / std::abs(major);
  const auto cell = [&](float w) {
    return static_cast<size_t>(std::clamp(static_cast<int>(w * scale + 0.5f * kCoverCells), 0, kCoverCells - 1));
  };
  return (face * kCoverCells + cell(u)) * kCoverCells + cell(v);
}

size_t findCoverCells(const api::Float4* at, uint32_t i, const uint32_t* list, size_t count, float least, float most,
                      uint32_t* neighbour, uint32_t* cell) {
  return HWY_DYNAMIC_DISPATCH(FindCoverCells)(at, i, list, count, least, most, neighbour, cell);
}

}  // namespace ps
#endif
