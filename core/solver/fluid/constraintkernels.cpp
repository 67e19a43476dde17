// SPDX-License-Identifier: Apache-2.0
#include "core/solver/fluid/constraintkernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/solver/fluid/constraintkernels.cpp"
// In this order:
// clang-format off
#include "hwy/foreach_target.h"
#include "core/particles/float4lanes-inl.h"
#include "core/solver/contact/wallheights-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace ps {
namespace HWY_NAMESPACE {

/// Excess and gradient, of kLanes particles.
struct LaneSums {
  V excess, x, y, z;
};

/// What walls add: `met` are those that any of the particles may feel.
HWY_INLINE void addWalls(const HalfSpaces& walls, const WallSet& met, const Vectors4& at, LaneSums& sums) {
  const D d;
  const hn::RebindToSigned<D> di;
  const V nearest = hn::Set(d, walls.nearest()), support = hn::Set(d, walls.support());
  const V perMetre = hn::Set(d, walls.perMetre());
  const V intervals = hn::Set(d, static_cast<float>(HalfSpaceTable::kIntervals));
  met.forEach(walls.walls().size(), [&](size_t wall) HWY_ATTR {
    const auto [nx, ny, nz, distance] = overWall(walls.walls()[wall], at);
    const V place = hn::Mul(hn::Max(nearest, distance), perMetre);
    const auto feels = hn::And(hn::Lt(distance, support), hn::Lt(place, intervals));
    if (hn::AllFalse(d, feels)) return;
    const V inside = hn::IfThenElseZero(feels, place);
    const auto whole = hn::ConvertTo(di, inside);
    alignas(64) uint32_t entry[kLanes];
    hn::Store(hn::BitCast(hn::RebindToUnsigned<D>(), whole), hn::RebindToUnsigned<D>(), entry);
    const Vectors4 value = loadTransposed(walls.tableOf(wall).entries(), entry);
    const V between = hn::Sub(inside, hn::ConvertTo(d, whole));
    const V share = hn::IfThenElseZero(feels, hn::Add(value.x, hn::Mul(between, value.z)));
    const V slope = hn::IfThenElseZero(feels, hn::Add(value.y, hn::Mul(between, value.w)));
    sums.excess = hn::Add(sums.excess, share);
    sums.x = hn::Add(sums.x, hn::Mul(nx, slope));
    sums.y = hn::Add(sums.y, hn::Mul(ny, slope));
    sums.z = hn::Add(sums.z, hn::Mul(nz, slope));
  });
}

HWY_INLINE V valuesOf(const float* values, const uint32_t* id) {
  alignas(64) float each[kLanes];
  for (size_t lane = 0; lane < kLanes; ++lane) each[lane] = values[id[lane]];
  return hn::Load(D(), each);
}

void SolveConstraints(const ConstraintRule& rule, const ConstraintFields& fields, const HalfSpaces& walls,
                      const uint32_t* which, size_t first, size_t last, const DensitySums* sums, const float* squares,
                      DensityConstraint* constraints, api::Float4* multipliers) {
  const D d;
  const DBlock block;
  const V perR2 = hn::Set(d, rule.inverseSupportSquared), epsilon = hn::Set(d, rule.epsilon);
  const V minusRelaxation = hn::Set(d, -rule.relaxation), one = hn::Set(d, 1.0f);
  const WallSet met = walls.nearAny(which + first, last - first);
  for (size_t k = first; k < last; k += kLanes) {
    const size_t count = HWY_MIN(kLanes, last - k);
    uint32_t filled[kLanes];
    const uint32_t* const id = wholeOf(which + k, count, which[k], filled);
    const Vectors4 at = loadTransposed(fields.points, id);
    LaneSums ofWalls{hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    if (met.any()) addWalls(walls, met, at, ofWalls);
    if (fields.ofShapes != nullptr) {
      V excess, x, y, z;
      hn::LoadInterleaved4(d, &fields.ofShapes[k].excess, excess, x, y, z);
      ofWalls = {hn::Add(ofWalls.excess, excess), hn::Add(ofWalls.x, x), hn::Add(ofWalls.y, y), hn::Add(ofWalls.z, z)};
    }
    V sum, sx, sy, sz;
    hn::LoadInterleaved4(d, &sums[k].excess, sum, sx, sy, sz);
    const V x = hn::Add(hn::Mul(sx, perR2), ofWalls.x), y = hn::Add(hn::Mul(sy, perR2), ofWalls.y),
            z = hn::Add(hn::Mul(sz, perR2), ofWalls.z);
    const V dense = hn::Add(hn::Sub(hn::Add(at.w, sum), one), ofWalls.excess);
    const V active = hn::Sub(dense, valuesOf(fields.compression, id));
    const V inverseMass = loadTransposed(fields.velocity, id).w;
    const V own = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
    const V others = hn::Mul(hn::LoadU(d, squares + k), perR2);
    const V wanted =
        hn::Div(hn::Mul(minusRelaxation, active), hn::Add(hn::Mul(inverseMass, hn::Add(own, epsilon)), others));
    const V lambda = hn::IfThenElseZero(hn::Gt(active, hn::Zero(d)), wanted);
    hn::StoreInterleaved4(x, y, z, lambda, d, &constraints[k].x);
    alignas(64) float each[kLanes];
    hn::Store(lambda, d, each);
    for (size_t lane = 0; lane < count; ++lane) {
      const uint32_t i = id[lane];
      hn::StoreU(hn::InsertLane(hn::LoadU(block, &fields.points[i].x), 3, each[lane]), block, &multipliers[i].x);
    }
  }
}

template <bool kConstrained, bool kCarried>
HWY_INLINE api::Double3 moveLoop(const MoveRule& rule, const MoveFields& fields, const uint32_t* which, size_t first,
                                 size_t last, const api::Float4* byOthers, const DensityConstraint* constraints,
                                 const api::Float4* beside) {
  const DBlock d;
  const hn::Full128<double> dd;
  const VBlock chebyshev = hn::Set(d, rule.chebyshev), former = hn::Set(d, rule.chebyshev - 1);
  const auto places = hn::FirstN(d, 3);
  auto movedXY = hn::Zero(dd), movedZ = hn::Zero(dd);
  for (size_t k = first; k < last; ++k) {
    const size_t i = which[k];
    const float inverseMass = fields.velocity[i].w;
    const VBlock others = hn::Set(d, inverseMass * fields.volume[i] * rule.inverseSupportSquared);
    VBlock move = hn::IfThenElseZero(places, hn::Mul(others, hn::LoadU(d, &byOthers[k].x)));
    VBlock multiplier = hn::Zero(d);
    if constexpr (kConstrained) {
      const VBlock constraint = hn::LoadU(d, &constraints[k].x);
      const VBlock lambda = hn::Broadcast<3>(constraint);
      move = hn::Add(move, hn::Mul(hn::Mul(hn::Set(d, inverseMass), lambda), constraint));
      multiplier = lambda;
    }
    if (beside != nullptr) move = hn::Add(move, hn::Mul(hn::Set(d, inverseMass), hn::LoadU(d, &beside[k].x)));
    move = hn::IfThenElse(places, move, multiplier);
    // Only what density did is carried on, not what walls and structure did between two iterations, and by the same
    // factors for fluids and solids: so the semi-iteration keeps momentum, and ice feels the lift that water gives.
    // As places are carried on from one iteration to the next, so are the multipliers that moved them.
    float* const carried = &fields.carried[i].x;
    if constexpr (kCarried) move = hn::Add(hn::Mul(chebyshev, move), hn::Mul(former, hn::LoadU(d, carried)));
    hn::StoreU(move, d, carried);
    if (kConstrained && fields.multiplierSum != nullptr) fields.multiplierSum[i] += fields.carried[i].w;
    const VBlock step = hn::IfThenElseZero(places, move);
    float* const at = &fields.position[i].x;
    hn::StoreU(hn::Add(hn::LoadU(d, at), step), d, at);
    const auto mass = hn::Set(dd, double{fields.mass[i]});
    movedXY = hn::Add(movedXY, hn::Mul(mass, hn::PromoteTo(dd, hn::LowerHalf(step))));
    movedZ = hn::Add(movedZ, hn::Mul(mass, hn::PromoteTo(dd, hn::UpperHalf(hn::Half<DBlock>(), step))));
  }
  return {hn::GetLane(movedXY), hn::ExtractLane(movedXY, 1), hn::GetLane(movedZ)};
}

api::Double3 ApplyMoves(const MoveRule& rule, const MoveFields& fields, const uint32_t* which, size_t first,
                        size_t last, const api::Float4* byOthers, const DensityConstraint* constraints,
                        const api::Float4* beside) {
  const bool carries = rule.chebyshev != 1;
  if (constraints != nullptr) {
    if (carries) return moveLoop<true, true>(rule, fields, which, first, last, byOthers, constraints, beside);
    return moveLoop<true, false>(rule, fields, which, first, last, byOthers, constraints, beside);
  }
  if (carries) return moveLoop<false, true>(rule, fields, which, first, last, byOthers, constraints, beside);
  return moveLoop<false, false>(rule, fields, which, first, last, byOthers, constraints, beside);
}

}  // namespace HWY_NAMESPACE
}  // namespace ps
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ps {
HWY_EXPORT(SolveConstraints);
HWY_EXPORT(ApplyMoves);

void solveConstraints(const ConstraintRule& rule, const ConstraintFields& fields, const HalfSpaces& walls,
                      const uint32_t* which, size_t first, size_t last, const DensitySums* sums, const float* squares,
                      DensityConstraint* constraints, api::Float4* multipliers) {
  HWY_DYNAMIC_DISPATCH(SolveConstraints)
  (rule, fields, walls, which, first, last, sums, squares, constraints, multipliers);
}
api::Double3 applyMoves(const MoveRule& rule, const MoveFields& fields, const uint32_t* which, size_t first,
                        size_t last, const api::Float4* byOthers, const DensityConstraint* constraints,
                        const api::Float4* beside) {
  return HWY_DYNAMIC_DISPATCH(ApplyMoves)(rule, fields, which, first, last, byOthers, constraints, beside);
}
}  // namespace ps
#endif
