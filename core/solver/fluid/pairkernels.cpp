// SPDX-License-Identifier: Apache-2.0
// Density, pressure and the filter of velocities.
#include "core/solver/fluid/pairkernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/solver/fluid/pairkernels.cpp"
// In this order:
// clang-format off
#include "hwy/foreach_target.h"
#include "core/solver/fluid/pairkernels-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace ps {
namespace HWY_NAMESPACE {

/// Squared slopes of neighbours, weighted: each by its own u_j.
struct WeightOfEach {
  const float* each;
  HWY_INLINE explicit WeightOfEach(const DensityWeights& weights) : each(weights.each) {}
  HWY_INLINE V share(V, V slope, const uint32_t* id) const {
    return hn::Mul(loadByIndex(each, id), hn::Mul(slope, slope));
  }
  HWY_INLINE float whole(float sum) const { return sum; }
};

/// Where nobody asks for them.
struct NoWeight {
  HWY_INLINE explicit NoWeight(const DensityWeights&) {}
  HWY_INLINE V share(V, V, const uint32_t*) const { return hn::Zero(D()); }
  HWY_INLINE float whole(float) const { return 0; }
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
                            const uint32_t* which, size_t first, size_t last, DensitySums* out, float* squares,
                            float* slopes) {
  const Weight weight(weights);
  const D d;
  alignas(16) constexpr float kFactors[4] = {1, Shape::kSlope, Shape::kSlope, Shape::kSlope};
  const VBlock factors = hn::Load(DBlock(), kFactors);
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
    hn::StoreU(hn::Mul(factors, sumFour(s, gx, gy, gz)), DBlock(), &out[k].excess);
    if constexpr (!std::is_same_v<Weight, NoWeight>) squares[k] = kSlope * kSlope * weight.whole(sumOne(g2));
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

template <class Space, class Shape>
HWY_INLINE void compressionLoop(const PairLists& lists, const api::Float4* points, const api::Float4* multipliers,
                                const uint32_t* which, size_t first, size_t last, CompressionSums* out) {
  const D d;
  const Space space(lists);
  const V inverseR2 = hn::Set(d, lists.inverseSupportSquared);
  constexpr float kFactor = -Shape::kSlope / 3;
  for (size_t k = first; k < last; ++k) {
    const size_t i = which[k];
    const V px = hn::Set(d, points[i].x), py = hn::Set(d, points[i].y), pz = hn::Set(d, points[i].z);
    Lanes excess, volumes, others;
    forNeighbours(lists, i, [&](size_t p, const uint32_t* id) HWY_ATTR {
      const Vectors4 other = loadTransposed(points, id);
      const Shape w(offsetsTo(space, px, py, pz, other, inverseR2).q2);
      const V approach = hn::Mul(w.q, w.slope());
      excess.add(p, hn::Mul(other.w, w.value()));
      volumes.add(p, hn::Mul(other.w, approach));
      others.add(p, hn::Mul(loadTransposed(multipliers, id).w, approach));
    });
    out[k] = {sumOne(excess), kFactor * sumOne(volumes), kFactor * sumOne(others)};
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

void SumDensity(const PairLists& lists, const api::Float4* points, const DensityWeights& weights, const uint32_t* which,
                size_t first, size_t last, DensitySums* out, float* squares, float* slopes) {
  bySpaceAndKernel(lists, [&](auto space, auto shape) HWY_ATTR {
    using Space = typename decltype(space)::Type;
    using Shape = typename decltype(shape)::Type;
    byFlag(slopes != nullptr, [&](auto keep) HWY_ATTR {
      constexpr bool kKeep = decltype(keep)::Type::value;
      const auto loop = [&](auto weight) HWY_ATTR {
        using Weight = typename decltype(weight)::Type;
        densityLoop<Space, Shape, Weight, kKeep>(lists, points, weights, which, first, last, out, squares, slopes);
      };
      if (squares == nullptr)
        loop(Choice<NoWeight>());
      else if (weights.each != nullptr)
        loop(Choice<WeightOfEach>());
      else if (weights.onlyKind())
        loop(Choice<WeightOfOne>());
      else
        loop(Choice<WeightByKind>());
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
                    const uint32_t* which, size_t first, size_t last, CompressionSums* out) {
  bySpaceAndKernel(lists, [&](auto space, auto shape) HWY_ATTR {
    compressionLoop<typename decltype(space)::Type, typename decltype(shape)::Type>(lists, points, multipliers, which,
                                                                                    first, last, out);
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

void sumDensity(const PairLists& lists, const api::Float4* points, const DensityWeights& weights, const uint32_t* which,
                size_t first, size_t last, DensitySums* out, float* squares, float* slopes) {
  HWY_DYNAMIC_DISPATCH(SumDensity)(lists, points, weights, which, first, last, out, squares, slopes);
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
                    const uint32_t* which, size_t first, size_t last, CompressionSums* out) {
  HWY_DYNAMIC_DISPATCH(SumCompression)(lists, points, multipliers, which, first, last, out);
}
void sumViscosity(const PairLists& lists, const api::Float4* position, const api::Float4* velocity,
                  const float* coefficient, const uint32_t* which, size_t first, size_t last, api::Float4* out) {
  HWY_DYNAMIC_DISPATCH(SumViscosity)(lists, position, velocity, coefficient, which, first, last, out);
}
void sumViscosity(const PairLists& lists, const api::Float4* position, const api::Float4* velocity, float coefficient,
                  const uint32_t* which, size_t first, size_t last, api::Float4* out) {
  HWY_DYNAMIC_DISPATCH(SumCommonViscosity)(lists, position, velocity, coefficient, which, first, last, out);
}
namespace targets {
int64_t compiled() { return HWY_TARGETS; }
}  // namespace targets
}  // namespace ps
#endif
