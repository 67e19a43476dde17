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
  double* first;
  float* weights;
  size_t stride;
  HWY_INLINE explicit Columns(const ClusterScratch& scratch)
      : first(scratch.column(0)), weights(scratch.weight(0)), stride(static_cast<size_t>(scratch.column(1) - first)) {}
  HWY_INLINE V load(size_t c, size_t at) const { return hn::LoadU(D(), first + c * stride + at); }
  HWY_INLINE V3 load3(size_t c, size_t at) const { return {load(c, at), load(c + 1, at), load(c + 2, at)}; }
  HWY_INLINE void store3(V3 v, size_t c, size_t at) const {
    const D d;
    double* to = first + c * stride + at;
    hn::StoreU(v.x, d, to), hn::StoreU(v.y, d, to + stride), hn::StoreU(v.z, d, to + 2 * stride);
  }
  HWY_INLINE V weight(size_t c, size_t at) const {
    return hn::PromoteTo(D(), hn::LoadU(DF(), weights + c * stride + at));
  }
};

/// visit(part, few, particles) for all members, `part` by part of eight virtual lanes.
template <class Visit>
HWY_INLINE void forMembers(const ClusterMembers& members, const Scratch& scratch, const Visit& visit) {
  for (size_t at = 0; at < members.count; at += kVirtualLanes) {
    const uint32_t* of = scratch.particles(members, at);
    for (size_t part = 0; part < kParts; ++part) {
      const Few few(at + part * kLanes, members.count);
      visit(part, few, of + part * kLanes);
    }
  }
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
void sum(const api::ParticleView& p, const ClusterMembers& members, Scratch& scratch, ClusterSums& out) {
  const Columns columns(scratch);
  const V3 origin = all(out.origin);
  Lanes mass;
  Lanes3 place, rest, shift, turning, moments[3];
  SecondLanes second;
  forMembers(members, scratch, [&](size_t part, Few few, const uint32_t* of) HWY_ATTR {
    const V m = columns.weight(Scratch::kMass, few.first);
    const V3 absolute = gather(p.position, of).xyz, x = absolute - origin;
    const V3 r = loadFloats3(members.rest, few), weighted = m * x;
    columns.store3(x, Scratch::kX, few.first);
    mass.add(part, m);
    place.add(part, weighted);
    rest.add(part, m * r);
    moments[0].add(part, weighted.x * r), moments[1].add(part, weighted.y * r), moments[2].add(part, weighted.z * r);
    if constexpr (kRubs) {
      const V3 way = absolute - gather(p.previous, of).xyz, carried = m * way;
      columns.store3(way, Scratch::kWayX, few.first);
      shift.add(part, carried);
      turning.add(part, cross(x, carried));
      second.add(part, weighted, x);
    }
  });
  out.mass = mass.sum();
  out.place = place.sum();
  out.rest = rest.sum();
  for (size_t row = 0; row < 3; ++row) out.moments.row[row] = moments[row].sum();
  if constexpr (kRubs) out.shift = shift.sum(), out.turning = turning.sum(), out.second = second.sum();
}

void SumMembers(const api::ParticleView& p, const ClusterMembers& members, bool rubs, Scratch& scratch,
                ClusterSums& out) {
  rubs ? sum<true>(p, members, scratch, out) : sum<false>(p, members, scratch, out);
}

template <bool kRubs>
void pullAll(const api::MovableParticles& particles, const ClusterMembers& members, const ClusterPull& pull,
             Scratch& scratch, Vector from) {
  const D d;
  const Columns columns(scratch);
  const V3 origin = all(from), centre = all(pull.centre), restCentre = all(pull.restCentre);
  const V3 row0 = all(pull.turned.row[0]), row1 = all(pull.turned.row[1]), row2 = all(pull.turned.row[2]);
  const V3 shift = all(pull.shift), turning = all(pull.turning);
  const V friction = hn::Set(d, pull.friction), softness = hn::Set(d, pull.softness);
  const V share = hn::Set(d, -1 / (1 + pull.friction + pull.softness));
  forMembers(members, scratch, [&](size_t, Few few, const uint32_t* of) HWY_ATTR {
    const size_t at = few.first;
    const V mass = columns.weight(Scratch::kMass, at), inverseMass = columns.weight(Scratch::kInverseMass, at);
    const V3 x = columns.load3(Scratch::kX, at), arm = x - centre;
    const V3 r = loadFloats3(members.rest, few) - restCentre;
    V3 error = arm - V3{dot(row0, r), dot(row1, r), dot(row2, r)};
    if constexpr (kRubs) {
      const V3 change = columns.load3(Scratch::kWayX, at) - shift - cross(turning, arm);
      error = error + friction * change;
    }
    const V3 before = loadFloats3(members.multiplier, few);
    // The multiplier of a vector constraint of inverse mass 1/m and compliance 1/(kappa m).
    const V3 step = share * (mass * error + softness * before), after = before + step;
    storeFloats(after.x, members.multiplier[0], few);
    storeFloats(after.y, members.multiplier[1], few);
    storeFloats(after.z, members.multiplier[2], few);
    scatter(x + origin + inverseMass * step, particles.position, of, few);
  });
}

void PullMembers(const api::MovableParticles& particles, const ClusterMembers& members, const ClusterPull& pull,
                 Scratch& scratch, Vector origin) {
  pull.friction > 0 ? pullAll<true>(particles, members, pull, scratch, origin)
                    : pullAll<false>(particles, members, pull, scratch, origin);
}

void SumTurn(const api::ParticleView& p, const ClusterMembers& members, Scratch& scratch, ClusterTurn& out) {
  const Columns columns(scratch);
  const V3 origin = all(out.sums.origin);
  Lanes mass, moved;
  Lanes3 place, lost;
  SecondLanes second;
  forMembers(members, scratch, [&](size_t part, Few few, const uint32_t* of) HWY_ATTR {
    const V m = columns.weight(Scratch::kMass, few.first);
    const V3 absolute = gather(p.position, of).xyz, x = absolute - origin, weighted = m * x;
    const V3 pull = loadFloats3(members.multiplier, few), way = loadFloats3(members.way, few);
    columns.store3(x, Scratch::kX, few.first);
    mass.add(part, m);
    place.add(part, weighted);
    second.add(part, weighted, x);
    moved.add(part, dot(pull, pull));
    lost.add(part, cross(way - absolute, pull));
  });
  out.sums.mass = mass.sum();
  out.sums.place = place.sum();
  out.sums.second = second.sum();
  out.lost = lost.sum();
  out.moved = moved.sum() > 0;
}

void TurnMembers(const api::MovableParticles& particles, const ClusterMembers& members, Vector centre, Vector spin,
                 Scratch& scratch) {
  const Columns columns(scratch);
  const V3 middle = all(centre), turning = all(spin);
  forMembers(members, scratch, [&](size_t, Few few, const uint32_t* of) HWY_ATTR {
    const V3 arm = columns.load3(Scratch::kX, few.first) - middle;
    scatter(gather(particles.velocity, of).xyz + cross(turning, arm), particles.velocity, of, few);
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
HWY_EXPORT(SumTurn);
HWY_EXPORT(TurnMembers);

Vector firstOf(const api::ParticleView& p, const ClusterMembers& members) {
  return vectorOf(p.position[members.particles[0]]);
}

}  // namespace

void ClusterScratch::begin(const api::ParticleView& particles, const ClusterMembers& members) {
  const size_t count = members.count, whole = count / kPadding * kPadding;
  m_stride = (count + kPadding - 1) / kPadding * kPadding;
  if (m_stride > kFew) m_many.resize(kColumns * m_stride), m_manyWeights.resize(kWeights * m_stride);
  m_columns = m_stride > kFew ? m_many.data() : m_few.data();
  m_weights = m_stride > kFew ? m_manyWeights.data() : m_fewWeights.data();
  float *mass = weight(kMass), *inverseMass = weight(kInverseMass);
  for (size_t k = 0; k < count; ++k) {
    const uint32_t i = members.particles[k];
    mass[k] = particles.mass[i];
    inverseMass[k] = particles.velocity[i].w;
  }
  for (size_t k = count; k < m_stride; ++k) mass[k] = inverseMass[k] = 0;
  for (size_t k = whole; k < m_stride; ++k) m_last[k - whole] = members.particles[k < count ? k : 0];
}

void findWays(const api::ParticleView& particles, const uint32_t* members, size_t count,
              const std::array<float*, 3>& way) {
  HWY_DYNAMIC_DISPATCH(FindWays)(particles, members, count, way);
}

Matrix ClusterSums::inertia() const {
  const Vector c = centre();
  Matrix spread = second;
  addOuter(spread, -mass, c, c);
  const double trace = spread.row[0].x + spread.row[1].y + spread.row[2].z;
  for (Vector& row : spread.row) row = -1 * row;
  spread.row[0].x += trace, spread.row[1].y += trace, spread.row[2].z += trace;
  return spread;
}

ClusterSums sumsOf(const api::ParticleView& particles, const ClusterMembers& members, bool rubs,
                   ClusterScratch& scratch) {
  scratch.begin(particles, members);
  ClusterSums sums;
  sums.origin = firstOf(particles, members);
  HWY_DYNAMIC_DISPATCH(SumMembers)(particles, members, rubs, scratch, sums);
  return sums;
}

void pullMembers(const api::MovableParticles& particles, const ClusterMembers& members, const ClusterPull& pull,
                 ClusterScratch& scratch) {
  const Vector origin = firstOf(particles, members);
  HWY_DYNAMIC_DISPATCH(PullMembers)(particles, members, pull, scratch, origin);
}

ClusterTurn turnOf(const api::ParticleView& particles, const ClusterMembers& members, ClusterScratch& scratch) {
  scratch.begin(particles, members);
  ClusterTurn turn;
  turn.sums.origin = firstOf(particles, members);
  for (size_t k = 0; k < members.count; ++k)
    turn.held = turn.held || scratch.weight(ClusterScratch::kInverseMass)[k] == 0;
  HWY_DYNAMIC_DISPATCH(SumTurn)(particles, members, scratch, turn);
  return turn;
}

void turnMembers(const api::MovableParticles& particles, const ClusterMembers& members, Vector centre, Vector spin,
                 ClusterScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(TurnMembers)(particles, members, centre, spin, scratch);
}

}  // namespace ps::constraint
#endif
