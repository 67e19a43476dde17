// SPDX-License-Identifier: Apache-2.0
// What loops over pairs share. Padding entries of lists point at a dummy far away and add exactly zero.
// Included once for each instruction set: no guard of its own but Highway's.
#if defined(PS_PAIRKERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PS_PAIRKERNELS_INL_H
#undef PS_PAIRKERNELS_INL_H
#else
#define PS_PAIRKERNELS_INL_H
#endif

#include "core/particles/float4lanes-inl.h"
#include "core/solver/fluid/pairkernels.h"
#include "hwy/highway.h"

#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace ps {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Images that two particles may be apart at most; the dummy lies farther away than that.
constexpr int kMostImages = 1000;
constexpr size_t kParts = kVirtualLanes / kLanes;  // accumulators: 1 on AVX-512, 2 on AVX2, 4 with 16-byte vectors

template <class DT>
HWY_INLINE hn::Vec<DT> loadByIndex(DT d, const float* values, const uint32_t* id) {
  const hn::RebindToSigned<DT> di;
  return hn::GatherIndex(d, values, hn::LoadU(di, reinterpret_cast<const int32_t*>(id)));
}

/// The first lanes of what is the same in all.
template <class DT>
HWY_INLINE hn::Vec<DT> lanesOf(DT, V v) {
  if constexpr (hn::MaxLanes(DT()) == kLanes)
    return v;
  else
    return hn::LowerHalf(DT(), v);
}

/// One sum in 16 virtual lanes.
struct Lanes {
  V part[kParts];
  HWY_INLINE Lanes() {
    for (V& v : part) v = hn::Zero(D());
  }
  template <class VT>
  HWY_INLINE void add(size_t p, VT v) {
    if constexpr (hn::MaxLanes(hn::DFromV<VT>()) == kLanes)
      part[p] = hn::Add(part[p], v);
    else
      part[p] = hn::Add(part[p], hn::ZeroExtendVector(D(), v));
  }
};

/// Adds blocks b and b + n/2 until one is left: the same tree for any width.
HWY_INLINE VBlock sumBlocks(const Lanes& lanes) {
#if HWY_MAX_BYTES >= 64
  const hn::Half<D> d2;
  const auto half = hn::Add(hn::LowerHalf(d2, lanes.part[0]), hn::UpperHalf(d2, lanes.part[0]));
  return hn::Add(hn::LowerHalf(DBlock(), half), hn::UpperHalf(DBlock(), half));
#elif HWY_MAX_BYTES == 32
  const V half = hn::Add(lanes.part[0], lanes.part[1]);
  return hn::Add(hn::LowerHalf(DBlock(), half), hn::UpperHalf(DBlock(), half));
#else
  return hn::Add(hn::Add(lanes.part[0], lanes.part[2]), hn::Add(lanes.part[1], lanes.part[3]));
#endif
}

/// Four sums at once: (a, b, c, e).
HWY_INLINE VBlock sumFour(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& e) {
  const DBlock d;
  const hn::Repartition<double, DBlock> dd;
  const VBlock sa = sumBlocks(a), sb = sumBlocks(b), sc = sumBlocks(c), se = sumBlocks(e);
  const auto ab = hn::BitCast(dd, hn::Add(hn::InterleaveLower(d, sa, sb), hn::InterleaveUpper(d, sa, sb)));
  const auto ce = hn::BitCast(dd, hn::Add(hn::InterleaveLower(d, sc, se), hn::InterleaveUpper(d, sc, se)));
  return hn::Add(hn::BitCast(d, hn::InterleaveLower(dd, ab, ce)), hn::BitCast(d, hn::InterleaveUpper(dd, ab, ce)));
}

/// hn::SumOfLanes adds in another order on other machines; this does not.
HWY_INLINE float sumOne(const Lanes& lanes) {
  VBlock v = sumBlocks(lanes);
  v = hn::Add(v, hn::Shuffle1032(v));
  return hn::GetLane(hn::Add(v, hn::Shuffle2301(v)));
}

// Kernels: roots and quotients are those of IEEE 754, the same everywhere; the unit that makes them works beside the
// others. Slopes come without a factor, which sums get once.

/// Monaghan's cubic spline without branches: w = 2 a^3 - c^3, w' = 6 (c^2 - a^2), a = (1 - q)+, c = (1 - 2 q)+.
struct Spline {
  static constexpr float kSlope = 6;

  template <class VT>
  struct At {
    VT q, a, c, a2, c2;
    HWY_INLINE explicit At(VT q2) {
      const hn::DFromV<VT> d;
      const VT one = hn::Set(d, 1.0f);
      q = hn::Sqrt(q2);
      a = hn::Max(hn::Zero(d), hn::Sub(one, q)), c = hn::Max(hn::Zero(d), hn::Sub(one, hn::Add(q, q)));
      a2 = hn::Mul(a, a), c2 = hn::Mul(c, c);
    }
    HWY_INLINE VT value() const {
      const VT a3 = hn::Mul(a2, a);
      return hn::Sub(hn::Add(a3, a3), hn::Mul(c2, c));
    }
    HWY_INLINE VT slope() const { return hn::Sub(c2, a2); }
    HWY_INLINE VT slopeOverQ() const { return hn::Div(slope(), q); }
  };
};

/// Wendland C2: w = a^4 (1 + 4 q), w' = -20 a^3 q.
struct Wendland {
  static constexpr float kSlope = -20;

  template <class VT>
  struct At {
    VT a3, a, q;
    HWY_INLINE explicit At(VT q2) {
      const hn::DFromV<VT> d;
      q = hn::Sqrt(q2);
      a = hn::Max(hn::Zero(d), hn::Sub(hn::Set(d, 1.0f), q));
      a3 = hn::Mul(hn::Mul(a, a), a);
    }
    HWY_INLINE VT value() const {
      const hn::DFromV<VT> d;
      return hn::Mul(hn::Mul(a3, a), hn::Add(hn::Set(d, 1.0f), hn::Mul(hn::Set(d, 4.0f), q)));
    }
    HWY_INLINE VT slopeOverQ() const { return a3; }
    HWY_INLINE VT slope() const { return hn::Mul(a3, q); }
  };
};

template <class Shape, class VT>
HWY_INLINE typename Shape::template At<VT> kernelAt(VT q2) {
  return typename Shape::template At<VT>(q2);
}

/// How offsets are measured: as they are, or to the nearest image. Chosen once per call, so that open space does not
/// pay.
struct OpenSpace {
  HWY_INLINE explicit OpenSpace(const PairLists&) {}
  template <class VT>
  HWY_INLINE VT shortest(VT d, size_t) const {
    return d;
  }
};

struct PeriodicSpace {
  V length[3], inverse[3];
  HWY_INLINE explicit PeriodicSpace(const PairLists& lists) {
    for (size_t a = 0; a < 3; ++a)
      length[a] = hn::Set(D(), lists.period.length(a)), inverse[a] = hn::Set(D(), lists.period.inverse(a));
  }
  /// Rounding halves to even is odd in d: a pair looks the same from both sides. The dummy stays far away.
  template <class VT>
  HWY_INLINE VT shortest(VT offset, size_t axis) const {
    const hn::DFromV<VT> d;
    const VT most = hn::Set(d, static_cast<float>(kMostImages));
    const VT images = hn::Round(hn::Mul(offset, lanesOf(d, inverse[axis])));
    return hn::Sub(offset, hn::Mul(lanesOf(d, length[axis]), hn::Max(hn::Neg(most), hn::Min(images, most))));
  }
};

template <class VT>
struct OffsetsOf {
  VT x, y, z, q2;
};
using Offsets = OffsetsOf<V>;

/// From `other` to a place that is the same in all lanes.
template <class Space, class VT>
HWY_INLINE OffsetsOf<VT> offsetsTo(const Space& space, V px, V py, V pz, const VectorsOf<VT>& other,
                                   V inverseSupportSquared) {
  const hn::DFromV<VT> d;
  const VT x = space.shortest(hn::Sub(lanesOf(d, px), other.x), 0);
  const VT y = space.shortest(hn::Sub(lanesOf(d, py), other.y), 1);
  const VT z = space.shortest(hn::Sub(lanesOf(d, pz), other.z), 2);
  const VT d2 = hn::Add(hn::Mul(x, x), hn::Add(hn::Mul(y, y), hn::Mul(z, z)));
  // Coincident particles: q is kept from zero, the direction is zero all the same.
  return {x, y, z, hn::Max(hn::Mul(d2, lanesOf(d, inverseSupportSquared)), hn::Set(d, 1e-12f))};
}

/// body(part, id) for each run of kLanes neighbours; accumulator `part` takes virtual lanes part * kLanes and up.
/// Runs of padding alone are left out: they would add zero.
template <class Body>
HWY_INLINE void forNeighbours(const PairLists& lists, size_t i, Body&& body) {
  const uint32_t last = lists.last[i];
  for (uint32_t q = lists.begin[i]; q < last; q += kVirtualLanes) {
    body(0, lists.index + q);
    if constexpr (kParts > 1) {
      if (q + kLanes < last) body(1, lists.index + q + kLanes);
    }
    if constexpr (kParts > 2) {
      if (q + 2 * kLanes < last) body(2, lists.index + q + 2 * kLanes);
      if (q + 3 * kLanes < last) body(3, lists.index + q + 3 * kLanes);
    }
  }
}

/// body(tag, part, id): as forNeighbours(), with half a vector at the end of a list where that holds the rest of it.
/// Most lists of a liquid end a few entries beyond two vectors of 16.
template <class Body>
HWY_INLINE void forNeighboursClosely(const PairLists& lists, size_t i, Body&& body) {
#if HWY_MAX_BYTES >= 64
  const uint32_t last = lists.last[i];
  uint32_t q = lists.begin[i];
  for (; q + kLanes / 2 < last; q += kLanes) body(D(), 0, lists.index + q);
  if (q < last) body(hn::Half<D>(), 0, lists.index + q);
#else
  forNeighbours(lists, i, [&](size_t p, const uint32_t* id) HWY_ATTR { body(D(), p, id); });
#endif
}

template <class T>
struct Choice {
  using Type = T;
};

/// body(Choice<Space>): one branch per call decides for all pairs.
template <class Body>
HWY_INLINE void bySpace(const PairLists& lists, Body&& body) {
  if (lists.period.any())
    body(Choice<PeriodicSpace>());
  else
    body(Choice<OpenSpace>());
}

template <class Body>
HWY_INLINE void bySpaceAndKernel(const PairLists& lists, Body&& body) {
  bySpace(lists, [&](auto space) HWY_ATTR {
    if (lists.kernel == KernelShape::CubicSpline)
      body(space, Choice<Spline>());
    else
      body(space, Choice<Wendland>());
  });
}

/// body(Choice<std::bool_constant>): as bySpace().
template <class Body>
HWY_INLINE void byFlag(bool flag, Body&& body) {
  if (flag)
    body(Choice<std::true_type>());
  else
    body(Choice<std::false_type>());
}

}  // namespace HWY_NAMESPACE
}  // namespace ps
HWY_AFTER_NAMESPACE();
#endif
