// SPDX-License-Identifier: Apache-2.0
// Members of clusters and rigid bodies in lanes. Doubles, eight virtual lanes: one vector of AVX-512, two of AVX2, four
// of 16 bytes. Lanes beyond the last member have no mass. Included once for each target, between
// HWY_BEFORE_NAMESPACE() and HWY_AFTER_NAMESPACE(), as Highway's own parts are.
#if defined(PS_MEMBERLANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PS_MEMBERLANES_INL_H
#undef PS_MEMBERLANES_INL_H
#else
#define PS_MEMBERLANES_INL_H
#endif
#include "rotation.h"

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ps::constraint {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr size_t kVirtualLanes = 8;
using D = hn::CappedTag<double, kVirtualLanes>;
using V = hn::Vec<D>;
using DF = hn::Rebind<float, D>;
constexpr size_t kLanes = HWY_MIN(HWY_LANES(double), kVirtualLanes);
constexpr size_t kParts = kVirtualLanes / kLanes;

/// One sum in eight virtual lanes.
struct Lanes {
  V part[kParts];
  HWY_INLINE Lanes() {
    for (V& v : part) v = hn::Zero(D());
  }
  HWY_INLINE void add(size_t p, V v) { part[p] = hn::Add(part[p], v); }
  /// Lanes k and k + 4, then k and k + 2, then the last two: the same tree for any width.
  HWY_INLINE double sum() const {
    const auto two = lastTwo();
    return hn::GetLane(two) + hn::GetLane(hn::Reverse(DTwo(), two));
  }
  /// This one and another's, of the same tree.
  HWY_INLINE void sumsWith(const Lanes& other, double* both) const {
    const auto a = lastTwo(), b = other.lastTwo();
    hn::Store(hn::Add(hn::InterleaveLower(DTwo(), a, b), hn::InterleaveUpper(DTwo(), a, b)), DTwo(), both);
  }

 private:
  using DTwo = hn::CappedTag<double, 2>;
  HWY_INLINE hn::Vec<DTwo> lastTwo() const {
#if HWY_MAX_BYTES >= 64
    const hn::Half<D> d4;
    const auto four = hn::Add(hn::LowerHalf(d4, part[0]), hn::UpperHalf(d4, part[0]));
    return hn::Add(hn::LowerHalf(DTwo(), four), hn::UpperHalf(DTwo(), four));
#elif HWY_MAX_BYTES >= 32
    const auto four = hn::Add(part[0], part[1]);
    return hn::Add(hn::LowerHalf(DTwo(), four), hn::UpperHalf(DTwo(), four));
#else
    return hn::Add(hn::Add(part[0], part[2]), hn::Add(part[1], part[3]));
#endif
  }
};

struct V3 {
  V x, y, z;
};
struct Lanes3 {
  Lanes x, y, z;
  HWY_INLINE Lanes3() {}  // one that is made up by the compiler would not be of this target
  HWY_INLINE void add(size_t p, V3 v) { x.add(p, v.x), y.add(p, v.y), z.add(p, v.z); }
  HWY_INLINE Vector sum() const { return {x.sum(), y.sum(), z.sum()}; }
};
HWY_INLINE V3 operator*(V s, V3 a) { return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)}; }
HWY_INLINE V3 operator+(V3 a, V3 b) { return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)}; }
HWY_INLINE V3 operator-(V3 a, V3 b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)}; }
HWY_INLINE V3 cross(V3 a, V3 b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE V3 all(Vector v) {
  const D d;
  return {hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
}
HWY_INLINE V dot(V3 a, V3 b) { return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z)); }

/// Members of a cluster that one vector holds.
struct Few {
  size_t first, count;
  Few(size_t at, size_t all) : first(at), count(at < all ? HWY_MIN(all - at, kLanes) : 0) {}
};

/// As many as there are lanes.
struct Whole {
  size_t first;
  static constexpr size_t count = kLanes;
};

/// 0 beyond the last member.
template <class Members>
HWY_INLINE V loadFloats(const float* from, Members few) {
  const DF df;
  if (few.count == kLanes) return hn::PromoteTo(D(), hn::LoadU(df, from + few.first));
#if HWY_MAX_BYTES >= 32  // others read and write what is masked
  return hn::PromoteTo(D(), hn::MaskedLoad(hn::FirstN(df, few.count), df, from + few.first));
#endif
  alignas(32) float tile[kLanes] = {};
  for (size_t k = 0; k < few.count; ++k) tile[k] = from[few.first + k];
  return hn::PromoteTo(D(), hn::Load(df, tile));
}
template <class Floats, class Members>
HWY_INLINE V3 loadFloats3(const Floats& from, Members few) {
  return {loadFloats(from[0], few), loadFloats(from[1], few), loadFloats(from[2], few)};
}
template <class Members>
HWY_INLINE void storeFloats(V v, float* to, Members few) {
  const DF df;
  if (few.count == kLanes) return hn::StoreU(hn::DemoteTo(df, v), df, to + few.first);
#if HWY_MAX_BYTES >= 32
  return hn::BlendedStore(hn::DemoteTo(df, v), hn::FirstN(df, few.count), df, to + few.first);
#endif
  alignas(32) float tile[kLanes];
  hn::Store(hn::DemoteTo(df, v), df, tile);
  for (size_t k = 0; k < few.count; ++k) to[few.first + k] = tile[k];
}

struct V4 {
  V3 xyz;
  V w;
};
struct Floats4 {
  hn::Vec<DF> x, y, z, w;
};
/// Two levels of interleaving make x, y, z, w of blocks of four particles.
HWY_INLINE Floats4 gatherFloats(const api::Float4* particles, const uint32_t* id) {
  const float* base = &particles->x;
  const hn::Full128<float> d1;
  const auto block = [&](size_t k) HWY_ATTR { return hn::Load(d1, base + 4 * size_t{id[k]}); };
#if HWY_MAX_BYTES >= 32
#if HWY_MAX_BYTES >= 64
  const DF df;
  const auto blocks = [&](size_t k) HWY_ATTR { return hn::Combine(df, block(k + 4), block(k)); };
#else
  const hn::Full128<float> df;
  const auto blocks = block;
#endif
  const hn::Repartition<double, decltype(df)> dd;
  const auto a0 = blocks(0), a1 = blocks(1), a2 = blocks(2), a3 = blocks(3);
  const auto xy01 = hn::BitCast(dd, hn::InterleaveLower(df, a0, a1));  // x0 x1 y0 y1 in each block
  const auto zw01 = hn::BitCast(dd, hn::InterleaveUpper(df, a0, a1));
  const auto xy23 = hn::BitCast(dd, hn::InterleaveLower(df, a2, a3));
  const auto zw23 = hn::BitCast(dd, hn::InterleaveUpper(df, a2, a3));
  return {hn::BitCast(df, hn::InterleaveLower(dd, xy01, xy23)), hn::BitCast(df, hn::InterleaveUpper(dd, xy01, xy23)),
          hn::BitCast(df, hn::InterleaveLower(dd, zw01, zw23)), hn::BitCast(df, hn::InterleaveUpper(dd, zw01, zw23))};
#else
  const DF df;
  const auto xy = hn::InterleaveLower(d1, block(0), block(1)), zw = hn::InterleaveUpper(d1, block(0), block(1));
  return {hn::LowerHalf(df, xy), hn::UpperHalf(df, xy), hn::LowerHalf(df, zw), hn::UpperHalf(df, zw)};
#endif
}
HWY_INLINE V4 gather(const api::Float4* particles, const uint32_t* id) {
  const D d;
  const Floats4 of = gatherFloats(particles, id);
  return {{hn::PromoteTo(d, of.x), hn::PromoteTo(d, of.y), hn::PromoteTo(d, of.z)}, hn::PromoteTo(d, of.w)};
}
/// With the w that they have: it is written again, since stores with a mask take several times as long.
template <class Members>
HWY_INLINE void scatter(V3 v, hn::Vec<DF> w, api::Float4* particles, const uint32_t* id, Members few) {
  const DF df;
  const hn::Full128<float> d1;
  const auto x = hn::DemoteTo(df, v.x), y = hn::DemoteTo(df, v.y), z = hn::DemoteTo(df, v.z);
  alignas(64) api::Float4 tile[kLanes];
#if HWY_MAX_BYTES >= 64
  if (few.count == kLanes) {
    const hn::Repartition<double, DF> dd;
    const auto xy0 = hn::BitCast(dd, hn::InterleaveLower(df, x, y)),
               xy2 = hn::BitCast(dd, hn::InterleaveUpper(df, x, y));
    const auto zw0 = hn::BitCast(dd, hn::InterleaveLower(df, z, w)),
               zw2 = hn::BitCast(dd, hn::InterleaveUpper(df, z, w));
    const auto two = [&](auto both, size_t k) HWY_ATTR {  // particles k and k + 4
      const auto blocks = hn::BitCast(df, both);
      hn::Store(hn::LowerHalf(d1, blocks), d1, &particles[id[k]].x);
      hn::Store(hn::UpperHalf(d1, blocks), d1, &particles[id[k + 4]].x);
    };
    two(hn::InterleaveLower(dd, xy0, zw0), 0), two(hn::InterleaveUpper(dd, xy0, zw0), 1);
    two(hn::InterleaveLower(dd, xy2, zw2), 2), two(hn::InterleaveUpper(dd, xy2, zw2), 3);
    return;
  }
#endif
  hn::StoreInterleaved4(x, y, z, w, df, &tile[0].x);
  if (few.count == kLanes) {
    for (size_t k = 0; k < kLanes; ++k) hn::Store(hn::Load(d1, &tile[k].x), d1, &particles[id[k]].x);
  } else {
    for (size_t k = 0; k < few.count; ++k) hn::Store(hn::Load(d1, &tile[k].x), d1, &particles[id[k]].x);
  }
}
HWY_INLINE void scatter(V3 v, api::Float4* particles, const uint32_t* id, Few few) {
  scatter(v, gatherFloats(particles, id).w, particles, id, few);
}
struct SecondLanes {
  Lanes xx, yy, zz, xy, xz, yz;
  HWY_INLINE SecondLanes() {}
  HWY_INLINE void add(size_t p, V3 weighted, V3 x) {
    xx.add(p, hn::Mul(weighted.x, x.x)), yy.add(p, hn::Mul(weighted.y, x.y)), zz.add(p, hn::Mul(weighted.z, x.z));
    xy.add(p, hn::Mul(weighted.x, x.y)), xz.add(p, hn::Mul(weighted.x, x.z)), yz.add(p, hn::Mul(weighted.y, x.z));
  }
  HWY_INLINE Matrix sum() const {
    const double a = xy.sum(), b = xz.sum(), c = yz.sum();
    return {{Vector{xx.sum(), a, b}, Vector{a, yy.sum(), c}, Vector{b, c, zz.sum()}}};
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace ps::constraint
HWY_AFTER_NAMESPACE();
#endif
