// SPDX-License-Identifier: Apache-2.0
// Density, pressure and the filter of velocities.
#include "core/solver/fluid/pairkernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/solver/fluid/pairkernels.cpp"
// In this order:
// clang-format off
#include "hwy/foreach_target.h"
#include "core/particles/compressed-inl.h"
#include "core/solver/fluid/pairkernels-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace ps {
namespace HWY_NAMESPACE {

/// Squared slopes of neighbours, weighted: each by its own u_j.
struct WeightOfEach {
  const float* each;
  HWY_INLINE explicit WeightOfEach(const DensityWeights& weights) : each(weights.each) {}
  template <class VT>
  HWY_INLINE VT share(VT, VT slope, const uint32_t* id) const {
    return hn::Mul(loadByIndex(hn::DFromV<VT>(), each, id), hn::Mul(slope, slope));
  }
  HWY_INLINE float whole(float sum) const { return sum; }
};

/// Where nobody asks for them.
struct NoWeight {
  HWY_INLINE explicit NoWeight(const DensityWeights&) {}
  template <class VT>
  HWY_INLINE VT share(VT, VT, const uint32_t*) const {
    return hn::Zero(hn::DFromV<VT>());
  }
  HWY_INLINE float whole(float) const { return 0; }
};

/// By the kind that a volume says.
struct WeightByKind {
  V inverseMass;  // the table in each block
  HWY_INLINE explicit WeightByKind(const DensityWeights& weights)
      : inverseMass(hn::LoadDup128(D(), weights.inverseMass)) {}
  template <class VT>
  HWY_INLINE VT share(VT volume, VT slope, const uint32_t*) const {
    const hn::DFromV<VT> d;
    const hn::RebindToSigned<decltype(d)> di;
    const auto kind = hn::And(hn::BitCast(di, volume), hn::Set(di, int32_t{DensityWeights::kKinds - 1}));
    const VT mass = hn::TableLookupLanes(lanesOf(d, inverseMass), hn::IndicesFromVec(d, kind));
    const VT part = hn::Mul(volume, slope);
    return hn::Mul(mass, hn::Mul(part, part));
  }
  HWY_INLINE float whole(float sum) const { return sum; }
};

/// Where all that moves has one mass: the kind says whether a neighbour moves.
struct WeightOfOne {
  float inverseMass;
  HWY_INLINE explicit WeightOfOne(const DensityWeights& weights) : inverseMass(weights.inverseMass[1]) {}
  template <class VT>
  HWY_INLINE VT share(VT volume, VT slope, const uint32_t*) const {
    const hn::DFromV<VT> d;
    const hn::RebindToSigned<decltype(d)> di;
    const auto moves = hn::RebindMask(d, hn::TestBit(hn::BitCast(di, volume), hn::Set(di, 1)));
    const VT part = hn::Mul(volume, slope);
    return hn::IfThenElseZero(moves, hn::Mul(part, part));
  }
  HWY_INLINE float whole(float sum) const { return inverseMass * sum; }
};

/// Fills an array by entry up to the end of its list.
template <class T>
HWY_INLINE void fillUp(T* values, uint32_t last, T filling) {
  const hn::Rebind<T, D> d;
  const hn::RebindToSigned<D> di;
  const uint32_t used = last % kVirtualLanes;
  if (used == 0) return;
  T* const at = values + (last - used);
  const auto count = hn::Set(di, static_cast<int32_t>(used));
  for (size_t p = 0; p < kParts; ++p) {
    const auto taken = hn::RebindMask(d, hn::Lt(hn::Iota(di, static_cast<int32_t>(p * kLanes)), count));
    hn::StoreU(hn::IfThenElse(taken, hn::LoadU(d, at + p * kLanes), hn::Set(d, filling)), d, at + p * kLanes);
  }
}

/// One list as it becomes shorter. What is stored never lies ahead of what has been read: whole vectors fit.
class NearEntries {
 public:
  HWY_INLINE NearEntries(const NearRoom& room, uint32_t begin) : m_room(room), m_used(begin) {}
  /// Entries id[0 ..) at these squared distances, and what belongs to them.
  template <class DT, class VT, class... Kept>
  HWY_INLINE void add(DT d, const uint32_t* id, VT q2, Kept... kept) {
    const hn::RebindToUnsigned<DT> du;
    const auto near = hn::Lt(q2, hn::Set(d, m_room.q2));
    const auto wanted = hn::RebindMask(du, near);
    hn::StoreU(compressed(hn::LoadU(du, id), wanted), du, m_room.index + m_used);
    (hn::StoreU(compressed(kept.values, near), d, kept.array + m_used), ...);
    m_used += static_cast<uint32_t>(hn::CountTrue(du, wanted));
  }
  template <class... Arrays>
  HWY_INLINE void end(size_t i, Arrays... arrays) {
    m_room.last[i] = m_used;
    fillUp(m_room.index, m_used, m_room.dummy);
    (fillUp(arrays, m_used, 0.0f), ...);
  }

 private:
  const NearRoom& m_room;
  uint32_t m_used;
};

template <class VT>
struct KeptValues {
  VT values;
  float* array;
};
template <class VT>
HWY_INLINE KeptValues<VT> kept(VT values, float* array) {
  return {values, array};
}

enum class Slopes { Drop, Keep, KeepNear };

template <class Space, class Shape, class Weight, Slopes kSlopes>
HWY_INLINE void densityLoop(const PairLists& lists, const api::Float4* points, const DensityWeights& weights,
                            const NearRoom& room, const uint32_t* which, size_t first, size_t last, DensitySums* out,
                            float* squares, float* slopes) {
  const Weight weight(weights);
  alignas(16) constexpr float kFactors[4] = {1, Shape::kSlope, Shape::kSlope, Shape::kSlope};
  const VBlock factors = hn::Load(DBlock(), kFactors);
  const D d;
  const Space space(lists);
  const V inverseR2 = hn::Set(d, lists.inverseSupportSquared);
  for (size_t k = first; k < last; ++k) {
    const size_t i = which[k];
    const V px = hn::Set(d, points[i].x), py = hn::Set(d, points[i].y), pz = hn::Set(d, points[i].z);
    Lanes s, gx, gy, gz, g2;
    NearEntries near(room, lists.begin[i]);
    forNeighboursClosely(lists, i, [&](auto tag, size_t p, const uint32_t* id) HWY_ATTR {
      const auto other = loadTransposed(tag, points, id);
      const auto r = offsetsTo(space, px, py, pz, other, inverseR2);
      const auto w = kernelAt<Shape>(r.q2);
      s.add(p, hn::Mul(other.w, w.value()));
      const auto slopeOverQ = w.slopeOverQ(), f = hn::Mul(other.w, slopeOverQ);
      if constexpr (kSlopes == Slopes::Keep) hn::StoreU(slopeOverQ, tag, slopes + (id - lists.index));
      if constexpr (kSlopes == Slopes::KeepNear) near.add(tag, id, r.q2, kept(slopeOverQ, slopes));
      gx.add(p, hn::Mul(f, r.x)), gy.add(p, hn::Mul(f, r.y)), gz.add(p, hn::Mul(f, r.z));
      g2.add(p, weight.share(other.w, w.slope(), id));
    });
    if constexpr (kSlopes == Slopes::KeepNear) near.end(i, slopes);
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
    forNeighboursClosely(lists, i, [&](auto tag, size_t p, const uint32_t* id) HWY_ATTR {
      const auto other = loadTransposed(tag, points, id);
      const auto r = offsetsTo(space, px, py, pz, other, inverseR2);
      hn::Vec<decltype(tag)> slope;
      if constexpr (kKnowsSlopes)
        slope = hn::LoadU(tag, slopes + (id - lists.index));
      else
        slope = kernelAt<Shape>(r.q2).slopeOverQ();
      const auto f = hn::Mul(other.w, slope);
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
    forNeighboursClosely(lists, i, [&](auto tag, size_t p, const uint32_t* id) HWY_ATTR {
      const auto other = loadTransposed(tag, points, id);
      const auto w = kernelAt<Shape>(offsetsTo(space, px, py, pz, other, inverseR2).q2);
      const auto approach = hn::Mul(w.q, w.slope());
      excess.add(p, hn::Mul(other.w, w.value()));
      volumes.add(p, hn::Mul(other.w, approach));
      others.add(p, hn::Mul(loadTransposed(tag, multipliers, id).w, approach));
    });
    out[k] = {sumOne(excess), kFactor * sumOne(volumes), kFactor * sumOne(others)};
  }
}

/// c_ij by the coefficients of both.
struct CoefficientOfEach {
  const float* each;
  V own;
  HWY_INLINE void start(size_t i) { own = hn::Set(D(), each[i]); }
  template <class VT>
  HWY_INLINE VT of(VT part, const uint32_t* id) const {
    const hn::DFromV<VT> d;
    const VT zero = hn::Zero(d), theirs = loadByIndex(d, each, id), mine = lanesOf(d, own);
    const auto bothFluid = hn::And(hn::Ge(mine, zero), hn::Ge(theirs, zero));
    const VT mean = hn::Mul(hn::Set(d, 0.5f), hn::Add(mine, theirs));
    return hn::Mul(part, hn::IfThenElse(bothFluid, mean, hn::Max(zero, hn::Max(mine, theirs))));
  }
  HWY_INLINE float factor() const { return 1; }
};

struct CommonCoefficient {
  float c;
  HWY_INLINE void start(size_t) {}
  template <class VT>
  HWY_INLINE VT of(VT part, const uint32_t*) const {
    return part;
  }
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
    forNeighboursClosely(lists, i, [&](auto tag, size_t p, const uint32_t* id) HWY_ATTR {
      const auto at = loadTransposed(tag, position, id), moving = loadTransposed(tag, velocity, id);
      const auto w = kernelAt<Shape>(offsetsTo(space, px, py, pz, at, inverseR2).q2);
      const auto mass = hn::Div(lanesOf(tag, twice), hn::Add(lanesOf(tag, inverseMass), moving.w));
      const auto f = coefficient.of(hn::Mul(hn::Add(lanesOf(tag, volume), at.w), hn::Mul(mass, w.value())), id);
      sx.add(p, hn::Mul(f, hn::Sub(moving.x, lanesOf(tag, vx))));
      sy.add(p, hn::Mul(f, hn::Sub(moving.y, lanesOf(tag, vy))));
      sz.add(p, hn::Mul(f, hn::Sub(moving.z, lanesOf(tag, vz))));
    });
    hn::Store(hn::Mul(factor, sumFour(sx, sy, sz, Lanes())), DBlock(), &out[k].x);
  }
}

template <Slopes kSlopes>
HWY_INLINE void densityByWeight(const PairLists& lists, const api::Float4* points, const DensityWeights& weights,
                                const NearRoom& room, const uint32_t* which, size_t first, size_t last,
                                DensitySums* out, float* squares, float* slopes) {
  bySpaceAndKernel(lists, [&](auto space, auto shape) HWY_ATTR {
    const auto loop = [&](auto weight) HWY_ATTR {
      densityLoop<typename decltype(space)::Type, typename decltype(shape)::Type, typename decltype(weight)::Type,
                  kSlopes>(lists, points, weights, room, which, first, last, out, squares, slopes);
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
}

void SumDensity(const PairLists& lists, const api::Float4* points, const DensityWeights& weights, const uint32_t* which,
                size_t first, size_t last, DensitySums* out, float* squares, float* slopes) {
  if (slopes != nullptr)
    densityByWeight<Slopes::Keep>(lists, points, weights, {}, which, first, last, out, squares, slopes);
  else
    densityByWeight<Slopes::Drop>(lists, points, weights, {}, which, first, last, out, squares, slopes);
}

void SumDensityFindingNear(const PairLists& lists, const api::Float4* points, const DensityWeights& weights,
                           const NearRoom& room, const uint32_t* which, size_t first, size_t last, DensitySums* out,
                           float* squares, float* slopes) {
  densityByWeight<Slopes::KeepNear>(lists, points, weights, room, which, first, last, out, squares, slopes);
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

template <class Space>
HWY_INLINE void nearLoop(const PairLists& lists, const api::Float4* points, const NearRoom& room, const uint32_t* which,
                         size_t first, size_t last) {
  const D d;
  const Space space(lists);
  const V inverseR2 = hn::Set(d, lists.inverseSupportSquared);
  for (size_t k = first; k < last; ++k) {
    const size_t i = which[k];
    const V px = hn::Set(d, points[i].x), py = hn::Set(d, points[i].y), pz = hn::Set(d, points[i].z);
    NearEntries near(room, lists.begin[i]);
    forNeighbours(lists, i, [&](size_t, const uint32_t* id) HWY_ATTR {
      near.add(d, id, offsetsTo(space, px, py, pz, loadTransposed(points, id), inverseR2).q2);
    });
    near.end(i);
  }
}

void FindNear(const PairLists& lists, const api::Float4* points, const NearRoom& room, const uint32_t* which,
              size_t first, size_t last) {
  bySpace(lists, [&](auto space)
                     HWY_ATTR { nearLoop<typename decltype(space)::Type>(lists, points, room, which, first, last); });
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
HWY_EXPORT(SumDensityFindingNear);
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
void sumDensityFindingNear(const PairLists& lists, const api::Float4* points, const DensityWeights& weights,
                           const NearRoom& room, const uint32_t* which, size_t first, size_t last, DensitySums* out,
                           float* squares, float* slopes) {
  HWY_DYNAMIC_DISPATCH(SumDensityFindingNear)
  (lists, points, weights, room, which, first, last, out, squares, slopes);
}
void findNear(const PairLists& lists, const api::Float4* points, const NearRoom& room, const uint32_t* which,
              size_t first, size_t last) {
  HWY_DYNAMIC_DISPATCH(FindNear)(lists, points, room, which, first, last);
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
