// SPDX-License-Identifier: Apache-2.0
// Viscous stress.
#include "core/solver/fluid/pairkernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/solver/fluid/stresskernels.cpp"
// In this order:
// clang-format off
#include "hwy/foreach_target.h"
#include "core/solver/fluid/pairkernels-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace ps {
namespace HWY_NAMESPACE {

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
      const V theirs = loadByIndex(d, field.viscosity, id);
      const auto bothFluid = hn::And(ownFluid, hn::Ge(theirs, zero));
      const V mean =
          hn::IfThenElse(bothFluid, hn::Mul(half, hn::Add(own, theirs)), hn::Max(zero, hn::Max(own, theirs)));
      const V counts = hn::Max(ownViscous, loadByIndex(d, field.viscous, id));
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
HWY_EXPORT(StressCoefficients);
HWY_EXPORT(SumStress);
HWY_EXPORT(SumShear);

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
}  // namespace ps
#endif
