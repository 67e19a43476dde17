// SPDX-License-Identifier: Apache-2.0
// A cluster has some dozen members: what a pass has read of them is kept for the next one.
#include "clusterkernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clusterkernels.cpp"
#include "hwy/foreach_target.h"  // before highway.h
#include "hwy/highway.h"
#include "memberlanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ps::constraint {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Scratch = ClusterScratch;

/// Columns of a scratch, as pointers that stay in registers.
struct Columns {
  float* first;
  size_t stride;
  HWY_INLINE explicit Columns(const ClusterScratch& scratch)
      : first(scratch.column(0)), stride(static_cast<size_t>(scratch.column(1) - first)) {}
  HWY_INLINE V3 load3(size_t c, size_t at) const {
    const D d;
    const DF df;
    const float* from = first + c * stride + at;
    return {hn::PromoteTo(d, hn::LoadU(df, from)), hn::PromoteTo(d, hn::LoadU(df, from + stride)),
            hn::PromoteTo(d, hn::LoadU(df, from + 2 * stride))};
  }
  HWY_INLINE void store3(const Floats4& v, size_t c, size_t at) const {
    const DF df;
    float* to = first + c * stride + at;
    hn::StoreU(v.x, df, to), hn::StoreU(v.y, df, to + stride), hn::StoreU(v.z, df, to + 2 * stride);
  }
  HWY_INLINE hn::Vec<DF> w(size_t at) const { return hn::LoadU(DF(), first + Scratch::kW * stride + at); }
  HWY_INLINE void storeW(hn::Vec<DF> w, size_t at) const { hn::StoreU(w, DF(), first + Scratch::kW * stride + at); }
};

HWY_INLINE V3 promoted(const Floats4& v) {
  const D d;
  return {hn::PromoteTo(d, v.x), hn::PromoteTo(d, v.y), hn::PromoteTo(d, v.z)};
}

/// visit(part, few, particles) for all members, `part` by part of eight virtual lanes. Beyond the last one stands the
/// first.
template <class Visit>
HWY_INLINE void forMembers(const ClusterMembers& members, const Visit& visit) {
  const size_t whole = members.count / kVirtualLanes * kVirtualLanes;
  for (size_t at = 0; at < whole; at += kVirtualLanes) {
    for (size_t part = 0; part < kParts; ++part)
      visit(part, Whole{at + part * kLanes}, members.particles + at + part * kLanes);
  }
  if (whole == members.count) return;
  alignas(32) uint32_t last[kVirtualLanes];
  for (size_t k = 0; k < kVirtualLanes; ++k) last[k] = members.particles[whole + k < members.count ? whole + k : 0];
  for (size_t part = 0; part < kParts; ++part)
    visit(part, Few(whole + part * kLanes, members.count), last + part * kLanes);
}

/// Leaves two sums in their lanes.
HWY_INLINE void keepSums(const Lanes& a, const Lanes& b, double& toA, double& toB) {
  alignas(16) double both[2];
  a.sumsWith(b, both);
  toA = both[0], toB = both[1];
}
HWY_INLINE void keepSums(const SecondLanes& from, std::array<ClusterLanes, 6>& to, size_t k) {
  keepSums(from.xx, from.yy, to[0][k], to[1][k]);
  keepSums(from.zz, from.xy, to[2][k], to[3][k]);
  keepSums(from.xz, from.yz, to[4][k], to[5][k]);
}
HWY_INLINE void keepSums(const Lanes3& a, const Lanes3& b, ClusterVectors& toA, ClusterVectors& toB, size_t k) {
  keepSums(a.x, b.x, toA[0][k], toB[0][k]);
  keepSums(a.y, b.y, toA[1][k], toB[1][k]);
  keepSums(a.z, b.z, toA[2][k], toB[2][k]);
}

HWY_INLINE Vector placeOf(const api::ParticleView& p, uint32_t i) {
  const api::Float4& x = p.position[i];
  return {x.x, x.y, x.z};
}
HWY_INLINE Vector keepOrigin(const api::ParticleView& p, const ClusterMembers& members, ClusterSums& out, size_t k) {
  const Vector origin = placeOf(p, members.particles[0]);
  out.origin[0][k] = origin.x, out.origin[1][k] = origin.y, out.origin[2][k] = origin.z;
  return origin;
}

void FindWays(const api::ParticleView& p, const uint32_t* members, size_t count, const std::array<float*, 3>& way) {
  const DF df;
  for (size_t at = 0; at + kLanes <= count; at += kLanes) {
    const Floats4 x = gatherFloats(p.position, members + at), from = gatherFloats(p.previous, members + at);
    hn::StoreU(hn::Sub(x.x, from.x), df, way[0] + at);
    hn::StoreU(hn::Sub(x.y, from.y), df, way[1] + at);
    hn::StoreU(hn::Sub(x.z, from.z), df, way[2] + at);
  }
  for (size_t k = count / kLanes * kLanes; k < count; ++k) {
    const api::Float4 &x = p.position[members[k]], &from = p.previous[members[k]];
    way[0][k] = x.x - from.x, way[1][k] = x.y - from.y, way[2][k] = x.z - from.z;
  }
}

template <bool kRubs>
HWY_FLATTEN HWY_INLINE void sumOne(const api::ParticleView& p, const ClusterMembers& members, Scratch& scratch,
                                   ClusterSums& out, size_t k) {
  const Columns columns(scratch);
  const V3 origin = all(keepOrigin(p, members, out, k));
  Lanes3 place, shift, turning, moments[3];
  SecondLanes second;
  forMembers(members, [&](size_t part, auto few, const uint32_t* of) HWY_ATTR {
    const V m = loadFloats(members.mass, few);
    const Floats4 at = gatherFloats(p.position, of);
    columns.store3(at, Scratch::kX, few.first), columns.storeW(at.w, few.first);
    const V3 absolute = promoted(at), x = absolute - origin, weighted = m * x, r = loadFloats3(members.rest, few);
    place.add(part, weighted);
    moments[0].add(part, weighted.x * r), moments[1].add(part, weighted.y * r), moments[2].add(part, weighted.z * r);
    if constexpr (kRubs) {
      const Floats4 from = gatherFloats(p.previous, of);
      columns.store3(from, Scratch::kPreviousX, few.first);
      const V3 carried = m * (absolute - promoted(from));
      shift.add(part, carried);
      turning.add(part, cross(x, carried));
      second.add(part, weighted, x);
    }
  });
  keepSums(place, moments[0], out.place, out.moments[0], k);
  keepSums(moments[1], moments[2], out.moments[1], out.moments[2], k);
  if constexpr (kRubs) keepSums(shift, turning, out.shift, out.turning, k), keepSums(second, out.second, k);
}

void SumMembers(const api::ParticleView& p, const ClusterMembers* members, size_t count, bool rubs,
                ClusterScratches& scratch, ClusterSums& out) {
  for (size_t k = 0; k < count; ++k)
    rubs ? sumOne<true>(p, members[k], scratch[k], out, k) : sumOne<false>(p, members[k], scratch[k], out, k);
}

/// 0 for those that cannot move, 1 for others.
HWY_INLINE V mobility(const api::ParticleView& p, const uint32_t* of) {
  alignas(64) double free[kLanes];
  for (size_t k = 0; k < kLanes; ++k) free[k] = p.velocity[of[k]].w > 0 ? 1 : 0;
  return hn::Load(D(), free);
}

template <bool kRubs>
HWY_FLATTEN HWY_INLINE void pullOne(const api::MovableParticles& particles, const ClusterMembers& members,
                                    const ClusterPull& pull, const Scratch& scratch) {
  const D d;
  const Columns columns(scratch);
  const V3 offset = all(pull.offset), centre = all(pull.centre);
  const V3 row0 = all(pull.turned.row[0]), row1 = all(pull.turned.row[1]), row2 = all(pull.turned.row[2]);
  const V3 shift = all(pull.shift), turning = all(pull.turning);
  const V friction = hn::Set(d, pull.friction), softness = hn::Set(d, pull.softness);
  const V share = hn::Set(d, -1 / (1 + pull.friction + pull.softness));
  forMembers(members, [&](size_t, auto few, const uint32_t* of) HWY_ATTR {
    const size_t at = few.first;
    const V3 x = columns.load3(Scratch::kX, at), r = loadFloats3(members.rest, few);
    V3 error = x - offset - V3{dot(row0, r), dot(row1, r), dot(row2, r)};
    if constexpr (kRubs) {
      const V3 way = x - columns.load3(Scratch::kPreviousX, at);
      error = error + friction * (way - shift - cross(turning, x - centre));
    }
    const V3 before = loadFloats3(members.displacement, few);
    // The multiplier of a vector constraint of inverse mass 1/m and compliance 1/(kappa m), times the former.
    V3 step = share * (error + softness * before);
    const V3 after = before + step;
    storeFloats(after.x, members.displacement[0], few);
    storeFloats(after.y, members.displacement[1], few);
    storeFloats(after.z, members.displacement[2], few);
    if (members.held) step = mobility(particles, of) * step;
    scatter(x + step, columns.w(at), particles.position, of, few);
  });
}

void PullMembers(const api::MovableParticles& particles, const ClusterMembers* members, size_t count,
                 const ClusterPull* pull, ClusterScratches& scratch) {
  for (size_t k = 0; k < count; ++k) {
    if (pull[k].softness < 0) continue;
    pull[k].friction > 0 ? pullOne<true>(particles, members[k], pull[k], scratch[k])
                         : pullOne<false>(particles, members[k], pull[k], scratch[k]);
  }
}

HWY_FLATTEN HWY_INLINE void sumTurn(const api::ParticleView& p, const ClusterMembers& members, Scratch& scratch,
                                    ClusterTurns& out, size_t k) {
  const Columns columns(scratch);
  const V3 origin = all(keepOrigin(p, members, out.sums, k));
  Lanes moved, none;
  Lanes3 place, lost;
  SecondLanes second;
  forMembers(members, [&](size_t part, auto few, const uint32_t* of) HWY_ATTR {
    const V m = loadFloats(members.mass, few);
    const Floats4 at = gatherFloats(p.position, of);
    columns.store3(at, Scratch::kX, few.first);
    const V3 x = promoted(at) - origin, weighted = m * x;
    const V3 pull = loadFloats3(members.displacement, few), way = loadFloats3(members.way, few);
    place.add(part, weighted);
    second.add(part, weighted, x);
    moved.add(part, dot(pull, pull));
    lost.add(part, cross(m * way - weighted, pull));
  });
  keepSums(place, lost, out.sums.place, out.lost, k);
  keepSums(second, out.sums.second, k);
  double unused = 0;
  keepSums(moved, none, out.moved[k], unused);
}

void SumTurns(const api::ParticleView& p, const ClusterMembers* members, size_t count, ClusterScratches& scratch,
              ClusterTurns& out) {
  for (size_t k = 0; k < count; ++k) sumTurn(p, members[k], scratch[k], out, k);
}

HWY_FLATTEN void TurnMembers(const api::MovableParticles& particles, const ClusterMembers& members, Vector centre,
                             Vector spin, const Scratch& scratch) {
  const Columns columns(scratch);
  const V3 middle = all(centre), turning = all(spin);
  forMembers(members, [&](size_t, auto few, const uint32_t* of) HWY_ATTR {
    const V3 arm = columns.load3(Scratch::kX, few.first) - middle;
    const Floats4 velocity = gatherFloats(particles.velocity, of);
    scatter(promoted(velocity) + cross(turning, arm), velocity.w, particles.velocity, of, few);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace ps::constraint
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ps::constraint {
namespace {

HWY_EXPORT(FindWays);
HWY_EXPORT(SumMembers);
HWY_EXPORT(PullMembers);
HWY_EXPORT(SumTurns);
HWY_EXPORT(TurnMembers);

}  // namespace

void ClusterScratch::begin(size_t members) {
  m_stride = (members + kPadding - 1) / kPadding * kPadding;
  if (m_stride > kFew) m_many.resize(kColumns * m_stride);
  m_columns = m_stride > kFew ? m_many.data() : m_few.data();
}

void findWays(const api::ParticleView& particles, const uint32_t* members, size_t count,
              const std::array<float*, 3>& way) {
  HWY_DYNAMIC_DISPATCH(FindWays)(particles, members, count, way);
}

Matrix inertiaOf(const ClusterSums& sums, size_t k, double mass) {
  const Vector c = 1 / mass * laneOf(sums.place, k);
  const auto at = [&](size_t n) { return sums.second[n][k]; };
  Matrix spread{{Vector{at(0), at(3), at(4)}, Vector{at(3), at(1), at(5)}, Vector{at(4), at(5), at(2)}}};
  addOuter(spread, -mass, c, c);
  const double trace = spread.row[0].x + spread.row[1].y + spread.row[2].z;
  for (Vector& row : spread.row) row = -1 * row;
  spread.row[0].x += trace, spread.row[1].y += trace, spread.row[2].z += trace;
  return spread;
}

void sumMembers(const api::ParticleView& particles, const ClusterMembers* members, size_t count, bool rubs,
                ClusterScratches& scratch, ClusterSums& out) {
  for (size_t k = 0; k < count; ++k) scratch[k].begin(members[k].count);
  HWY_DYNAMIC_DISPATCH(SumMembers)(particles, members, count, rubs, scratch, out);
}

void pullMembers(const api::MovableParticles& particles, const ClusterMembers* members, size_t count,
                 const ClusterPull* pull, ClusterScratches& scratch) {
  HWY_DYNAMIC_DISPATCH(PullMembers)(particles, members, count, pull, scratch);
}

void sumTurns(const api::ParticleView& particles, const ClusterMembers* members, size_t count,
              ClusterScratches& scratch, ClusterTurns& out) {
  for (size_t k = 0; k < count; ++k) scratch[k].begin(members[k].count);
  HWY_DYNAMIC_DISPATCH(SumTurns)(particles, members, count, scratch, out);
}

void turnMembers(const api::MovableParticles& particles, const ClusterMembers& members, Vector centre, Vector spin,
                 const ClusterScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(TurnMembers)(particles, members, centre, spin, scratch);
}

}  // namespace ps::constraint
#endif
