// SPDX-License-Identifier: Apache-2.0
// Particles are 16-byte float4. Four vectors are filled by block loads, block b of vector k from the neighbour
// id[4 b + k], and two levels of interleaving transpose them into x, y, z, w: several times faster than gathers.
// Padding entries point at a dummy far away and add exactly zero.
#include "core/solver/fluid/pairkernels.h"

#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/solver/fluid/pairkernels.cpp"
#include "hwy/foreach_target.h"  // before highway.h
#include "hwy/highway.h"

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
/// Images that two particles may be apart at most; the dummy lies farther away than that.
constexpr int kMostImages = 1000;
constexpr size_t kParts = kVirtualLanes / kLanes;  // accumulators: 1 on AVX-512, 2 on AVX2, 4 with 16-byte vectors

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

HWY_INLINE V loadByIndex(const float* values, const uint32_t* id) {
  const hn::RebindToSigned<D> di;
  return hn::GatherIndex(D(), values, hn::LoadU(di, reinterpret_cast<const int32_t*>(id)));
}

/// One sum in 16 virtual lanes.
struct Lanes {
  V part[kParts];
  HWY_INLINE Lanes() {
    for (V& v : part) v = hn::Zero(D());
  }
  HWY_INLINE void add(size_t p, V v) { part[p] = hn::Add(part[p], v); }
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
  V q, a, c, a2, c2;
  HWY_INLINE explicit Spline(V q2) {
    const D d;
    const V one = hn::Set(d, 1.0f);
    q = hn::Sqrt(q2);
    a = hn::Max(hn::Zero(d), hn::Sub(one, q)), c = hn::Max(hn::Zero(d), hn::Sub(one, hn::Add(q, q)));
    a2 = hn::Mul(a, a), c2 = hn::Mul(c, c);
  }
  HWY_INLINE V value() const {
    const V a3 = hn::Mul(a2, a);
    return hn::Sub(hn::Add(a3, a3), hn::Mul(c2, c));
  }
  HWY_INLINE V slope() const { return hn::Sub(c2, a2); }
  HWY_INLINE V slopeOverQ() const { return hn::Div(slope(), q); }
};

/// Wendland C2: w = a^4 (1 + 4 q), w' = -20 a^3 q.
struct Wendland {
  static constexpr float kSlope = -20;
  V a3, a, q;
  HWY_INLINE explicit Wendland(V q2) {
    const D d;
    q = hn::Sqrt(q2);
    a = hn::Max(hn::Zero(d), hn::Sub(hn::Set(d, 1.0f), q));
    a3 = hn::Mul(hn::Mul(a, a), a);
  }
  HWY_INLINE V value() const {
    return hn::Mul(hn::Mul(a3, a), hn::Add(hn::Set(D(), 1.0f), hn::Mul(hn::Set(D(), 4.0f), q)));
  }
  HWY_INLINE V slopeOverQ() const { return a3; }
  HWY_INLINE V slope() const { return hn::Mul(a3, q); }
};

HWY_INLINE float slopeFactor(KernelShape shape) {
  return shape == KernelShape::CubicSpline ? Spline::kSlope : Wendland::kSlope;
}

/// How offsets are measured: as they are, or to the nearest image. Chosen once per call, so that open space does not
/// pay.
struct OpenSpace {
  HWY_INLINE explicit OpenSpace(const PairLists&) {}
  HWY_INLINE V shortest(V d, size_t) const { return d; }
};

struct PeriodicSpace {
  V length[3], inverse[3];
  HWY_INLINE explicit PeriodicSpace(const PairLists& lists) {
    for (size_t a = 0; a < 3; ++a)
      length[a] = hn::Set(D(), lists.period.length(a)), inverse[a] = hn::Set(D(), lists.period.inverse(a));
  }
  /// Rounding halves to even is odd in d: a pair looks the same from both sides. The dummy stays far away.
  HWY_INLINE V shortest(V d, size_t axis) const {
    const V most = hn::Set(D(), static_cast<float>(kMostImages));
    const V images = hn::Round(hn::Mul(d, inverse[axis]));
    return hn::Sub(d, hn::Mul(length[axis], hn::Max(hn::Neg(most), hn::Min(images, most))));
  }
};

struct Offsets {
  V x, y, z, q2;
};

template <class Space>
HWY_INLINE Offsets offsetsTo(const Space& space, V px, V py, V pz, const Vectors4& other, V inverseSupportSquared) {
  const V x = space.shortest(hn::Sub(px, other.x), 0), y = space.shortest(hn::Sub(py, other.y), 1),
          z = space.shortest(hn::Sub(pz, other.z), 2);
  const V d2 = hn::Add(hn::Mul(x, x), hn::Add(hn::Mul(y, y), hn::Mul(z, z)));
  // Coincident particles: q is kept from zero, the direction is zero all the same.
  return {x, y, z, hn::Max(hn::Mul(d2, inverseSupportSquared), hn::Set(D(), 1e-12f))};
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

/// Squared slopes of neighbours, weighted: each by its own u_j.
struct WeightOfEach {
  const float* each;
  HWY_INLINE explicit WeightOfEach(const DensityWeights& weights) : each(weights.each) {}
  HWY_INLINE V share(V, V slope, const uint32_t* id) const {
    return hn::Mul(loadByIndex(each, id), hn::Mul(slope, slope));
  }
  HWY_INLINE float whole(float sum) const { return sum; }
};

/// By the kind that a volume says.
struct WeightByKind {
  V inverseMass;  // the table in each block
  HWY_INLINE explicit WeightByKind(const DensityWeights& weights)
      : inverseMass(hn::LoadDup128(D(), weights.inverseMass)) {}
  HWY_INLINE V share(V volume, V slope, const uint32_t*) const {
    const hn::RebindToSigned<D> di;
    const auto kind = hn::And(hn::BitCast(di, volume), hn::Set(di, int32_t{DensityWeights::kKinds - 1}));
    const V mass = hn::TableLookupLanes(inverseMass, hn::IndicesFromVec(D(), kind)), part = hn::Mul(volume, slope);
    return hn::Mul(mass, hn::Mul(part, part));
  }
  HWY_INLINE float whole(float sum) const { return sum; }
};

/// Where all that moves has one mass: the kind says whether a neighbour moves.
struct WeightOfOne {
  float inverseMass;
  HWY_INLINE explicit WeightOfOne(const DensityWeights& weights) : inverseMass(weights.inverseMass[1]) {}
  HWY_INLINE V share(V volume, V slope, const uint32_t*) const {
    const hn::RebindToSigned<D> di;
    const auto moves = hn::RebindMask(D(), hn::TestBit(hn::BitCast(di, volume), hn::Set(di, 1)));
    const V part = hn::Mul(volume, slope);
    return hn::IfThenElseZero(moves, hn::Mul(part, part));
  }
  HWY_INLINE float whole(float sum) const { return inverseMass * sum; }
};

template <class Space, class Shape, class Weight, bool kKeepSlopes>
HWY_INLINE void densityLoop(const PairLists& lists, const api::Float4* points, const DensityWeights& weights,
                            const uint32_t* which, size_t first, size_t last, DensitySums* out, float* slopes) {
  const Weight weight(weights);
  const D d;
  const Space space(lists);
  const V inverseR2 = hn::Set(d, lists.inverseSupportSquared);
  for (size_t k = first; k < last; ++k) {
    const size_t i = which[k];
    const V px = hn::Set(d, points[i].x), py = hn::Set(d, points[i].y), pz = hn::Set(d, points[i].z);
    Lanes s, gx, gy, gz, g2;
    forNeighbours(lists, i, [&](size_t p, const uint32_t* id) HWY_ATTR {
      const Vectors4 other = loadTransposed(points, id);
      const Offsets r = offsetsTo(space, px, py, pz, other, inverseR2);
      const Shape w(r.q2);
      s.add(p, hn::Mul(other.w, w.value()));
      const V slopeOverQ = w.slopeOverQ(), f = hn::Mul(other.w, slopeOverQ);
      if constexpr (kKeepSlopes) hn::StoreU(slopeOverQ, d, slopes + (id - lists.index));
      gx.add(p, hn::Mul(f, r.x)), gy.add(p, hn::Mul(f, r.y)), gz.add(p, hn::Mul(f, r.z));
      const V slope = w.slope();
      g2.add(p, weight.share(other.w, slope, id));
    });
    constexpr float kSlope = Shape::kSlope;
    alignas(16) float sums[4];
    hn::Store(sumFour(s, gx, gy, gz), DBlock(), sums);
    out[k] = {sums[0], kSlope * sums[1], kSlope * sums[2], kSlope * sums[3],
              kSlope * kSlope * weight.whole(sumOne(g2))};
  }
}

/// `slopes`: of each slot; nullptr: to be found out.
template <class Space, class Shape, bool kKnowsSlopes>
HWY_INLINE void multiplierLoop(const PairLists& lists, const api::Float4* points, const uint32_t* which, size_t first,
                               size_t last, api::Float4* out, const float* slopes) {
  const D d;
  const Space space(lists);
  const V inverseR2 = hn::Set(d, lists.inverseSupportSquared);
  for (size_t k = first; k < last; ++k) {
    const size_t i = which[k];
    const V px = hn::Set(d, points[i].x), py = hn::Set(d, points[i].y), pz = hn::Set(d, points[i].z);
    Lanes gx, gy, gz;
    forNeighbours(lists, i, [&](size_t p, const uint32_t* id) HWY_ATTR {
      const Vectors4 other = loadTransposed(points, id);
      const Offsets r = offsetsTo(space, px, py, pz, other, inverseR2);
      V slope;
      if constexpr (kKnowsSlopes)
        slope = hn::LoadU(d, slopes + (id - lists.index));
      else
        slope = Shape(r.q2).slopeOverQ();
      const V f = hn::Mul(other.w, slope);
      gx.add(p, hn::Mul(f, r.x)), gy.add(p, hn::Mul(f, r.y)), gz.add(p, hn::Mul(f, r.z));
    });
    hn::Store(hn::Mul(hn::Set(DBlock(), Shape::kSlope), sumFour(gx, gy, gz, Lanes())), DBlock(), &out[k].x);
  }
}

template <class Space>
HWY_INLINE void compressionLoop(const PairLists& lists, const api::Float4* points, const api::Float4* multipliers,
                                const float* slopes, const uint32_t* which, size_t first, size_t last, float* byVolumes,
                                float* byMultipliers) {
  const D d;
  const Space space(lists);
  const V inverseR2 = hn::Set(d, lists.inverseSupportSquared);
  const float factor = -slopeFactor(lists.kernel) / 3;
  for (size_t k = first; k < last; ++k) {
    const size_t i = which[k];
    const V px = hn::Set(d, points[i].x), py = hn::Set(d, points[i].y), pz = hn::Set(d, points[i].z);
    Lanes volumes, others;
    forNeighbours(lists, i, [&](size_t p, const uint32_t* id) HWY_ATTR {
      const Vectors4 other = loadTransposed(points, id);
      const V q2 = offsetsTo(space, px, py, pz, other, inverseR2).q2;
      const V approach = hn::Mul(q2, hn::LoadU(d, slopes + (id - lists.index)));
      volumes.add(p, hn::Mul(other.w, approach));
      others.add(p, hn::Mul(loadTransposed(multipliers, id).w, approach));
    });
    byVolumes[k] = factor * sumOne(volumes);
    byMultipliers[k] = factor * sumOne(others);
  }
}

/// c_ij by the coefficients of both.
struct CoefficientOfEach {
  const float* each;
  V own;
  HWY_INLINE void start(size_t i) { own = hn::Set(D(), each[i]); }
  HWY_INLINE V of(V part, const uint32_t* id) const {
    const V zero = hn::Zero(D()), theirs = loadByIndex(each, id);
    const auto bothFluid = hn::And(hn::Ge(own, zero), hn::Ge(theirs, zero));
    const V mean = hn::Mul(hn::Set(D(), 0.5f), hn::Add(own, theirs));
    return hn::Mul(part, hn::IfThenElse(bothFluid, mean, hn::Max(zero, hn::Max(own, theirs))));
  }
  HWY_INLINE float factor() const { return 1; }
};

struct CommonCoefficient {
  float c;
  HWY_INLINE void start(size_t) {}
  HWY_INLINE V of(V part, const uint32_t*) const { return part; }
  HWY_INLINE float factor() const { return c; }
};

template <class Space, class Shape, class Coefficient>
HWY_INLINE void viscosityLoop(const PairLists& lists, const api::Float4* position, const api::Float4* velocity,
                              Coefficient coefficient, const uint32_t* which, size_t first, size_t last,
                              api::Float4* out) {
  const D d;
  const Space space(lists);
  const V inverseR2 = hn::Set(d, lists.inverseSupportSquared);
  const VBlock factor = hn::Set(DBlock(), 0.5f * coefficient.factor());  // of the mean volume, too
  for (size_t k = first; k < last; ++k) {
    const size_t i = which[k];
    const api::Float4 p0 = position[i], v0 = velocity[i];
    const V px = hn::Set(d, p0.x), py = hn::Set(d, p0.y), pz = hn::Set(d, p0.z), volume = hn::Set(d, p0.w);
    const V vx = hn::Set(d, v0.x), vy = hn::Set(d, v0.y), vz = hn::Set(d, v0.z);
    const V inverseMass = hn::Set(d, v0.w), twice = hn::Set(d, 2 * v0.w);
    coefficient.start(i);
    Lanes sx, sy, sz;
    forNeighbours(lists, i, [&](size_t p, const uint32_t* id) HWY_ATTR {
      const Vectors4 at = loadTransposed(position, id), moving = loadTransposed(velocity, id);
      const Shape w(offsetsTo(space, px, py, pz, at, inverseR2).q2);
      const V mass = hn::Div(twice, hn::Add(inverseMass, moving.w));
      const V f = coefficient.of(hn::Mul(hn::Add(volume, at.w), hn::Mul(mass, w.value())), id);
      sx.add(p, hn::Mul(f, hn::Sub(moving.x, vx)));
      sy.add(p, hn::Mul(f, hn::Sub(moving.y, vy)));
      sz.add(p, hn::Mul(f, hn::Sub(moving.z, vz)));
    });
    hn::Store(hn::Mul(factor, sumFour(sx, sy, sz, Lanes())), DBlock(), &out[k].x);
  }
}

/// (1 - q)2 (1 + 1/q).
HWY_INLINE V stressWeight(V q2) {
  const D d;
  const V one = hn::Set(d, 1.0f), q = hn::Sqrt(q2);
  const V a = hn::Max(hn::Zero(d), hn::Sub(one, q));
  return hn::Mul(hn::Mul(a, a), hn::Add(one, hn::Div(one, q)));
}

template <class Space>
HWY_INLINE void coefficientLoop(const PairLists& lists, const StressField& field, float factor, const uint32_t* which,
                                size_t first, size_t last, float* coefficient, api::Float4* diagonal,
                                api::Float4* offDiagonal) {
  const D d;
  const Space space(lists);
  const V inverseR2 = hn::Set(d, lists.inverseSupportSquared), zero = hn::Zero(d), half = hn::Set(d, 0.5f);
  for (size_t k = first; k < last; ++k) {
    const size_t i = which[k];
    const api::Float4 p0 = field.points[i];
    const V px = hn::Set(d, p0.x), py = hn::Set(d, p0.y), pz = hn::Set(d, p0.z), volume = hn::Set(d, p0.w);
    const V own = hn::Set(d, field.viscosity[i]), ownViscous = hn::Set(d, field.viscous[i]), scale = hn::Set(d, factor);
    const auto ownFluid = hn::Ge(own, zero);
    Lanes xx, yy, zz, xy, xz, yz;
    forNeighbours(lists, i, [&](size_t p, const uint32_t* id) HWY_ATTR {
      const Vectors4 other = loadTransposed(field.points, id);
      const V theirs = loadByIndex(field.viscosity, id);
      const auto bothFluid = hn::And(ownFluid, hn::Ge(theirs, zero));
      const V mean =
          hn::IfThenElse(bothFluid, hn::Mul(half, hn::Add(own, theirs)), hn::Max(zero, hn::Max(own, theirs)));
      const V counts = hn::Max(ownViscous, loadByIndex(field.viscous, id));
      const Offsets r = offsetsTo(space, px, py, pz, other, inverseR2);
      const V volumes = hn::Mul(volume, other.w);
      const V c = hn::Mul(hn::Mul(hn::Mul(scale, volumes), hn::Mul(mean, counts)), stressWeight(r.q2));
      hn::StoreU(c, d, coefficient + (id - lists.index));
      const V cx = hn::Mul(c, r.x), cy = hn::Mul(c, r.y), cz = hn::Mul(c, r.z);
      xx.add(p, hn::Mul(cx, r.x)), yy.add(p, hn::Mul(cy, r.y)), zz.add(p, hn::Mul(cz, r.z));
      xy.add(p, hn::Mul(cx, r.y)), xz.add(p, hn::Mul(cx, r.z)), yz.add(p, hn::Mul(cy, r.z));
    });
    hn::Store(sumFour(xx, yy, zz, Lanes()), DBlock(), &diagonal[k].x);
    hn::Store(sumFour(xy, xz, yz, Lanes()), DBlock(), &offDiagonal[k].x);
  }
}

template <class Space>
HWY_INLINE void stressLoop(const PairLists& lists, const api::Float4* points, const float* coefficient,
                           const api::Float4* vectors, const uint32_t* which, size_t first, size_t last,
                           api::Float4* out) {
  const D d;
  const Space space(lists);
  for (size_t k = first; k < last; ++k) {
    const size_t i = which[k];
    const api::Float4 p0 = points[i], u0 = vectors[i];
    const V px = hn::Set(d, p0.x), py = hn::Set(d, p0.y), pz = hn::Set(d, p0.z);
    const V ux = hn::Set(d, u0.x), uy = hn::Set(d, u0.y), uz = hn::Set(d, u0.z);
    Lanes sx, sy, sz;
    forNeighbours(lists, i, [&](size_t p, const uint32_t* id) HWY_ATTR {
      const Vectors4 at = loadTransposed(points, id), u = loadTransposed(vectors, id);
      const V x = space.shortest(hn::Sub(px, at.x), 0), y = space.shortest(hn::Sub(py, at.y), 1),
              z = space.shortest(hn::Sub(pz, at.z), 2);
      const V along =
          hn::Add(hn::Mul(x, hn::Sub(ux, u.x)), hn::Add(hn::Mul(y, hn::Sub(uy, u.y)), hn::Mul(z, hn::Sub(uz, u.z))));
      const V f = hn::Mul(hn::LoadU(d, coefficient + (id - lists.index)), along);
      sx.add(p, hn::Mul(f, x)), sy.add(p, hn::Mul(f, y)), sz.add(p, hn::Mul(f, z));
    });
    hn::Store(sumFour(sx, sy, sz, Lanes()), DBlock(), &out[k].x);
  }
}

template <class Space>
HWY_INLINE void shearLoop(const PairLists& lists, const api::Float4* points, const api::Float4* velocity,
                          const uint32_t* which, size_t first, size_t last, float* out) {
  const D d;
  const Space space(lists);
  const V inverseR2 = hn::Set(d, lists.inverseSupportSquared);
  for (size_t k = first; k < last; ++k) {
    const size_t i = which[k];
    const api::Float4 p0 = points[i], u0 = velocity[i];
    const V px = hn::Set(d, p0.x), py = hn::Set(d, p0.y), pz = hn::Set(d, p0.z);
    const V ux = hn::Set(d, u0.x), uy = hn::Set(d, u0.y), uz = hn::Set(d, u0.z);
    Lanes sum;
    forNeighbours(lists, i, [&](size_t p, const uint32_t* id) HWY_ATTR {
      const Vectors4 at = loadTransposed(points, id), u = loadTransposed(velocity, id);
      const Offsets r = offsetsTo(space, px, py, pz, at, inverseR2);
      const V along = hn::Add(hn::Mul(r.x, hn::Sub(ux, u.x)),
                              hn::Add(hn::Mul(r.y, hn::Sub(uy, u.y)), hn::Mul(r.z, hn::Sub(uz, u.z))));
      sum.add(p, hn::Mul(hn::Mul(at.w, stressWeight(r.q2)), hn::Mul(along, along)));
    });
    out[k] = sumOne(sum);
  }
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

void SumDensity(const PairLists& lists, const api::Float4* points, const DensityWeights& weights, const uint32_t* which,
                size_t first, size_t last, DensitySums* out, float* slopes) {
  bySpaceAndKernel(lists, [&](auto space, auto shape) HWY_ATTR {
    using Space = typename decltype(space)::Type;
    using Shape = typename decltype(shape)::Type;
    byFlag(slopes != nullptr, [&](auto keep) HWY_ATTR {
      constexpr bool kKeep = decltype(keep)::Type::value;
      if (weights.each != nullptr)
        densityLoop<Space, Shape, WeightOfEach, kKeep>(lists, points, weights, which, first, last, out, slopes);
      else if (weights.onlyKind())
        densityLoop<Space, Shape, WeightOfOne, kKeep>(lists, points, weights, which, first, last, out, slopes);
      else
        densityLoop<Space, Shape, WeightByKind, kKeep>(lists, points, weights, which, first, last, out, slopes);
    });
  });
}

void SumMultipliers(const PairLists& lists, const api::Float4* points, const uint32_t* which, size_t first, size_t last,
                    api::Float4* out, const float* slopes) {
  bySpaceAndKernel(lists, [&](auto space, auto shape) HWY_ATTR {
    byFlag(slopes != nullptr, [&](auto known) HWY_ATTR {
      multiplierLoop<typename decltype(space)::Type, typename decltype(shape)::Type, decltype(known)::Type::value>(
          lists, points, which, first, last, out, slopes);
    });
  });
}

/// Fills a list up to its next multiple of the virtual lanes.
HWY_INLINE void fillUp(uint32_t* index, uint32_t last, uint32_t dummy) {
  const hn::RebindToSigned<D> di;
  const uint32_t used = last % kVirtualLanes;
  if (used == 0) return;
  auto* const at = reinterpret_cast<int32_t*>(index + (last - used));
  const auto count = hn::Set(di, static_cast<int32_t>(used)), filling = hn::Set(di, static_cast<int32_t>(dummy));
  for (size_t p = 0; p < kParts; ++p) {
    const auto taken = hn::Lt(hn::Iota(di, static_cast<int32_t>(p * kLanes)), count);
    hn::StoreU(hn::IfThenElse(taken, hn::LoadU(di, at + p * kLanes), filling), di, at + p * kLanes);
  }
}

template <class Space>
HWY_INLINE void nearLoop(const PairLists& lists, const api::Float4* points, const NearRule& rule, const uint32_t* which,
                         size_t first, size_t last, uint32_t* lastOf, uint32_t* index) {
  const D d;
  const hn::RebindToSigned<D> di;
  const Space space(lists);
  const V inverseR2 = hn::Set(d, lists.inverseSupportSquared), most = hn::Set(d, rule.q2);
  for (size_t k = first; k < last; ++k) {
    const size_t i = which[k];
    const V px = hn::Set(d, points[i].x), py = hn::Set(d, points[i].y), pz = hn::Set(d, points[i].z);
    uint32_t out = lists.begin[i];
    // What is stored never lies ahead of what has been read: whole vectors fit.
    for (uint32_t q = lists.begin[i]; q < lists.last[i]; q += kLanes) {
      const uint32_t* id = lists.index + q;
      const Offsets r = offsetsTo(space, px, py, pz, loadTransposed(points, id), inverseR2);
      const auto near = hn::RebindMask(di, hn::Lt(r.q2, most));
      const auto ids = hn::LoadU(di, reinterpret_cast<const int32_t*>(id));
      hn::StoreU(hn::Compress(ids, near), di, reinterpret_cast<int32_t*>(index + out));
      out += static_cast<uint32_t>(hn::CountTrue(di, near));
    }
    lastOf[i] = out;
    fillUp(index, out, rule.dummy);
  }
}

void FindNear(const PairLists& lists, const api::Float4* points, const NearRule& rule, const uint32_t* which,
              size_t first, size_t last, uint32_t* lastOf, uint32_t* index) {
  bySpace(lists, [&](auto space) HWY_ATTR {
    nearLoop<typename decltype(space)::Type>(lists, points, rule, which, first, last, lastOf, index);
  });
}

void SumCompression(const PairLists& lists, const api::Float4* points, const api::Float4* multipliers,
                    const float* slopes, const uint32_t* which, size_t first, size_t last, float* byVolumes,
                    float* byMultipliers) {
  bySpace(lists, [&](auto space) HWY_ATTR {
    compressionLoop<typename decltype(space)::Type>(lists, points, multipliers, slopes, which, first, last, byVolumes,
                                                    byMultipliers);
  });
}

void SumViscosity(const PairLists& lists, const api::Float4* position, const api::Float4* velocity,
                  const float* coefficient, const uint32_t* which, size_t first, size_t last, api::Float4* out) {
  bySpaceAndKernel(lists, [&](auto space, auto shape) HWY_ATTR {
    viscosityLoop<typename decltype(space)::Type, typename decltype(shape)::Type>(
        lists, position, velocity, CoefficientOfEach{coefficient, hn::Zero(D())}, which, first, last, out);
  });
}

void SumCommonViscosity(const PairLists& lists, const api::Float4* position, const api::Float4* velocity,
                        float coefficient, const uint32_t* which, size_t first, size_t last, api::Float4* out) {
  bySpaceAndKernel(lists, [&](auto space, auto shape) HWY_ATTR {
    viscosityLoop<typename decltype(space)::Type, typename decltype(shape)::Type>(
        lists, position, velocity, CommonCoefficient{coefficient}, which, first, last, out);
  });
}

void StressCoefficients(const PairLists& lists, const StressField& field, float factor, const uint32_t* which,
                        size_t first, size_t last, float* coefficient, api::Float4* diagonal,
                        api::Float4* offDiagonal) {
  bySpace(lists, [&](auto space) HWY_ATTR {
    coefficientLoop<typename decltype(space)::Type>(lists, field, factor, which, first, last, coefficient, diagonal,
                                                    offDiagonal);
  });
}

void SumStress(const PairLists& lists, const api::Float4* points, const float* coefficient, const api::Float4* vectors,
               const uint32_t* which, size_t first, size_t last, api::Float4* out) {
  bySpace(lists, [&](auto space) HWY_ATTR {
    stressLoop<typename decltype(space)::Type>(lists, points, coefficient, vectors, which, first, last, out);
  });
}

void SumShear(const PairLists& lists, const api::Float4* points, const api::Float4* velocity, const uint32_t* which,
              size_t first, size_t last, float* out) {
  bySpace(lists, [&](auto space) HWY_ATTR {
    shearLoop<typename decltype(space)::Type>(lists, points, velocity, which, first, last, out);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace ps
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ps {
HWY_EXPORT(SumDensity);
HWY_EXPORT(SumMultipliers);
HWY_EXPORT(FindNear);
HWY_EXPORT(SumCompression);
HWY_EXPORT(SumViscosity);
HWY_EXPORT(SumCommonViscosity);
HWY_EXPORT(StressCoefficients);
HWY_EXPORT(SumStress);
HWY_EXPORT(SumShear);

void sumDensity(const PairLists& lists, const api::Float4* points, const DensityWeights& weights, const uint32_t* which,
                size_t first, size_t last, DensitySums* out, float* slopes) {
  HWY_DYNAMIC_DISPATCH(SumDensity)(lists, points, weights, which, first, last, out, slopes);
}
void sumMultipliers(const PairLists& lists, const api::Float4* points, const uint32_t* which, size_t first, size_t last,
                    api::Float4* out, const float* slopes) {
  HWY_DYNAMIC_DISPATCH(SumMultipliers)(lists, points, which, first, last, out, slopes);
}
void findNear(const PairLists& lists, const api::Float4* points, const NearRule& rule, const uint32_t* which,
              size_t first, size_t last, uint32_t* lastOf, uint32_t* index) {
  HWY_DYNAMIC_DISPATCH(FindNear)(lists, points, rule, which, first, last, lastOf, index);
}
void sumCompression(const PairLists& lists, const api::Float4* points, const api::Float4* multipliers,
                    const float* slopes, const uint32_t* which, size_t first, size_t last, float* byVolumes,
                    float* byMultipliers) {
  HWY_DYNAMIC_DISPATCH(SumCompression)
  (lists, points, multipliers, slopes, which, first, last, byVolumes, byMultipliers);
}
void sumViscosity(const PairLists& lists, const api::Float4* position, const api::Float4* velocity,
                  const float* coefficient, const uint32_t* which, size_t first, size_t last, api::Float4* out) {
  HWY_DYNAMIC_DISPATCH(SumViscosity)(lists, position, velocity, coefficient, which, first, last, out);
}
void sumViscosity(const PairLists& lists, const api::Float4* position, const api::Float4* velocity, float coefficient,
                  const uint32_t* which, size_t first, size_t last, api::Float4* out) {
  HWY_DYNAMIC_DISPATCH(SumCommonViscosity)(lists, position, velocity, coefficient, which, first, last, out);
}
void stressCoefficients(const PairLists& lists, const StressField& field, float factor, const uint32_t* which,
                        size_t first, size_t last, float* coefficient, api::Float4* diagonal,
                        api::Float4* offDiagonal) {
  HWY_DYNAMIC_DISPATCH(StressCoefficients)
  (lists, field, factor, which, first, last, coefficient, diagonal, offDiagonal);
}
void sumStress(const PairLists& lists, const api::Float4* points, const float* coefficient, const api::Float4* vectors,
               const uint32_t* which, size_t first, size_t last, api::Float4* out) {
  HWY_DYNAMIC_DISPATCH(SumStress)(lists, points, coefficient, vectors, which, first, last, out);
}
void sumShear(const PairLists& lists, const api::Float4* points, const api::Float4* velocity, const uint32_t* which,
              size_t first, size_t last, float* out) {
  HWY_DYNAMIC_DISPATCH(SumShear)(lists, points, velocity, which, first, last, out);
}
namespace targets {
int64_t compiled() { return HWY_TARGETS; }
}  // namespace targets
}  // namespace ps
#endif
