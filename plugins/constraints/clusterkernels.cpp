// SPDX-License-Identifier: Apache-2.0
// Doubles, eight virtual lanes: one vector of AVX-512, two of AVX2, four of 16 bytes. Lanes beyond the last member have
// no mass. Particles are copied to a tile of 16-byte float4 and interleaved from there.
#include "clusterkernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clusterkernels.cpp"
#include "hwy/foreach_target.h"  // before highway.h
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
using Scratch = ClusterScratch;

/// One sum in eight virtual lanes.
struct Lanes {
  V part[kParts];
  HWY_INLINE Lanes() {
    for (V& v : part) v = hn::Zero(D());
  }
  HWY_INLINE void add(size_t p, V v) { part[p] = hn::Add(part[p], v); }
  /// Lanes k and k + 4, then k and k + 2, then the last two: the same tree for any width.
  HWY_INLINE double sum() const {
    alignas(64) double lane[kVirtualLanes];
    for (size_t p = 0; p < kParts; ++p) hn::Store(part[p], D(), lane + p * kLanes);
    return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
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

/// Columns of a scratch, as pointers that stay in registers.
struct Columns {
  double* first;
  size_t stride;
  const uint32_t* id;
  HWY_INLINE explicit Columns(const ClusterScratch& scratch)
      : first(scratch.column(0)), stride(static_cast<size_t>(scratch.column(1) - first)), id(scratch.particles()) {}
  HWY_INLINE V load(size_t c, size_t at) const { return hn::LoadU(D(), first + c * stride + at); }
  HWY_INLINE V3 load3(size_t c, size_t at) const { return {load(c, at), load(c + 1, at), load(c + 2, at)}; }
  HWY_INLINE void store(V v, size_t c, size_t at) const { hn::StoreU(v, D(), first + c * stride + at); }
  HWY_INLINE void store3(V3 v, size_t c, size_t at) const {
    store(v.x, c, at), store(v.y, c + 1, at), store(v.z, c + 2, at);
  }
};

HWY_INLINE V loadFloats(const float* from, Few few) {
  const DF df;
  if (few.count == kLanes) return hn::PromoteTo(D(), hn::LoadU(df, from + few.first));
  alignas(32) float tile[kLanes] = {};
  for (size_t k = 0; k < few.count; ++k) tile[k] = from[few.first + k];
  return hn::PromoteTo(D(), hn::Load(df, tile));
}
template <class Floats>
HWY_INLINE V3 loadFloats3(const Floats& from, Few few) {
  return {loadFloats(from[0], few), loadFloats(from[1], few), loadFloats(from[2], few)};
}
HWY_INLINE void storeFloats(V v, float* to, Few few) {
  const DF df;
  if (few.count == kLanes) return hn::StoreU(hn::DemoteTo(df, v), df, to + few.first);
  alignas(32) float tile[kLanes];
  hn::Store(hn::DemoteTo(df, v), df, tile);
  for (size_t k = 0; k < few.count; ++k) to[few.first + k] = tile[k];
}

struct V4 {
  V3 xyz;
  V w;
};
/// Two levels of interleaving make x, y, z, w of blocks of four particles.
HWY_INLINE V4 gather(const api::Float4* particles, const uint32_t* id) {
  const D d;
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
  return {{hn::PromoteTo(d, hn::BitCast(df, hn::InterleaveLower(dd, xy01, xy23))),
           hn::PromoteTo(d, hn::BitCast(df, hn::InterleaveUpper(dd, xy01, xy23))),
           hn::PromoteTo(d, hn::BitCast(df, hn::InterleaveLower(dd, zw01, zw23)))},
          hn::PromoteTo(d, hn::BitCast(df, hn::InterleaveUpper(dd, zw01, zw23)))};
#else
  const DF df;
  const auto xy = hn::InterleaveLower(d1, block(0), block(1)), zw = hn::InterleaveUpper(d1, block(0), block(1));
  return {{hn::PromoteTo(d, hn::LowerHalf(df, xy)), hn::PromoteTo(d, hn::UpperHalf(df, xy)),
           hn::PromoteTo(d, hn::LowerHalf(df, zw))},
          hn::PromoteTo(d, hn::UpperHalf(df, zw))};
#endif
}
/// Leaves their w as it is.
HWY_INLINE void scatter(V3 v, api::Float4* particles, const ClusterMembers& members, Few few) {
  const DF df;
  alignas(64) api::Float4 tile[kLanes];
  hn::StoreInterleaved4(hn::DemoteTo(df, v.x), hn::DemoteTo(df, v.y), hn::DemoteTo(df, v.z), hn::Zero(df), df,
                        &tile[0].x);
  for (size_t k = 0; k < few.count; ++k) {
    api::Float4& to = particles[members.particles[few.first + k]];
    to = {tile[k].x, tile[k].y, tile[k].z, to.w};
  }
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

template <bool kRubs>
void sum(const api::ParticleView& p, const ClusterMembers& members, Scratch& scratch, ClusterSums& out) {
  const Columns columns(scratch);
  const V3 origin = all(out.origin);
  Lanes mass;
  Lanes3 place, rest, shift, turning, moments[3];
  SecondLanes second;
  for (size_t at = 0; at < members.count; at += kVirtualLanes) {
    for (size_t part = 0; part < kParts; ++part) {
      const Few few(at + part * kLanes, members.count);
      const uint32_t* of = columns.id + few.first;
      const V m = columns.load(Scratch::kMass, few.first);
      const V3 absolute = gather(p.position, of).xyz, x = absolute - origin;
      const V3 r = loadFloats3(members.rest, few), weighted = m * x;
      columns.store(gather(p.velocity, of).w, Scratch::kInverseMass, few.first);
      columns.store3(x, Scratch::kX, few.first);
      columns.store3(r, Scratch::kRestX, few.first);
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
    }
  }
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
  for (size_t at = 0; at < members.count; at += kLanes) {
    const Few few(at, members.count);
    const V mass = columns.load(Scratch::kMass, at);
    const V inverseMass = columns.load(Scratch::kInverseMass, at);
    const V3 x = columns.load3(Scratch::kX, at), arm = x - centre;
    const V3 r = columns.load3(Scratch::kRestX, at) - restCentre;
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
    scatter(x + origin + inverseMass * step, particles.position, members, few);
  }
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
  for (size_t at = 0; at < members.count; at += kVirtualLanes) {
    for (size_t part = 0; part < kParts; ++part) {
      const Few few(at + part * kLanes, members.count);
      const uint32_t* of = columns.id + few.first;
      const V m = columns.load(Scratch::kMass, few.first);
      const V3 absolute = gather(p.position, of).xyz, x = absolute - origin, weighted = m * x;
      const V3 pull = loadFloats3(members.multiplier, few), way = loadFloats3(members.way, few);
      columns.store3(x, Scratch::kX, few.first);
      mass.add(part, m);
      place.add(part, weighted);
      second.add(part, weighted, x);
      moved.add(part, dot(pull, pull));
      lost.add(part, cross(way - absolute, pull));
    }
  }
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
  for (size_t at = 0; at < members.count; at += kLanes) {
    const Few few(at, members.count);
    const V3 arm = columns.load3(Scratch::kX, at) - middle;
    scatter(gather(particles.velocity, columns.id + at).xyz + cross(turning, arm), particles.velocity, members, few);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace ps::constraint
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ps::constraint {
namespace {

HWY_EXPORT(SumMembers);
HWY_EXPORT(PullMembers);
HWY_EXPORT(SumTurn);
HWY_EXPORT(TurnMembers);

Vector firstOf(const api::ParticleView& p, const ClusterMembers& members) {
  return vectorOf(p.position[members.particles[0]]);
}

}  // namespace

void ClusterScratch::begin(const api::ParticleView& particles, const ClusterMembers& members) {
  m_stride = (members.count + kPadding - 1) / kPadding * kPadding;
  if (m_stride > kFew) m_many.resize(kColumns * m_stride), m_manyParticles.resize(m_stride);
  m_columns = m_stride > kFew ? m_many.data() : m_few.data();
  m_particles = m_stride > kFew ? m_manyParticles.data() : m_fewParticles.data();
  double* mass = column(kMass);
  for (size_t k = 0; k < members.count; ++k) {
    m_particles[k] = members.particles[k];
    mass[k] = double{particles.mass[members.particles[k]]};
  }
  for (size_t k = members.count; k < m_stride; ++k) m_particles[k] = members.particles[0], mass[k] = 0;
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
  for (size_t k = 0; k < members.count && !turn.held; ++k) turn.held = particles.velocity[members.particles[k]].w == 0;
  HWY_DYNAMIC_DISPATCH(SumTurn)(particles, members, scratch, turn);
  return turn;
}

void turnMembers(const api::MovableParticles& particles, const ClusterMembers& members, Vector centre, Vector spin,
                 ClusterScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(TurnMembers)(particles, members, centre, spin, scratch);
}

}  // namespace ps::constraint
#endif
