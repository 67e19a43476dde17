// SPDX-License-Identifier: Apache-2.0
// A rigid body has up to some ten thousand members: passes read them anew, and keep sums alone.
#include "rigidkernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rigidkernels.cpp"
#include "hwy/foreach_target.h"  // before highway.h
#include "hwy/highway.h"
#include "memberlanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ps::constraint {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Indices of members in a vector; beyond the last one the first, which then counts without mass.
struct Indices {
  const uint32_t* id;
  uint32_t tile[kLanes];
  HWY_INLINE Indices(const RigidMembers& members, Few few) : id(members.particles + few.first) {
    if (few.count == kLanes) return;
    for (size_t k = 0; k < kLanes; ++k) tile[k] = k < few.count ? id[k] : members.particles[0];
    id = tile;
  }
  /// 0 beyond the last member.
  HWY_INLINE V massOf(const api::ParticleView& p, Few few) const {
    const D d;
    const DF df;
    const auto index = hn::LoadU(hn::RebindToSigned<DF>(), reinterpret_cast<const int32_t*>(id));
    const V mass = hn::PromoteTo(d, hn::GatherIndex(df, p.mass, index));
    return few.count == kLanes ? mass : hn::IfThenElseZero(hn::FirstN(d, few.count), mass);
  }
};

/// visit(part, few, indices) for all members, `part` by part of eight virtual lanes.
template <class Visit>
HWY_INLINE void forMembers(const RigidMembers& members, const Visit& visit) {
  for (size_t at = 0; at < members.count; at += kVirtualLanes) {
    for (size_t part = 0; part < kParts; ++part) {
      const Few few(at + part * kLanes, members.count);
      if (few.count > 0) visit(part, few, Indices(members, few));
    }
  }
}

/// A pose in registers.
struct PoseLanes {
  V3 centre, restCentre, row0, row1, row2;
  HWY_INLINE explicit PoseLanes(const RigidPose& pose)
      : centre(all(pose.centre)),
        restCentre(all(pose.restCentre)),
        row0(all(pose.turned.row[0])),
        row1(all(pose.turned.row[1])),
        row2(all(pose.turned.row[2])) {}
  HWY_INLINE V3 armOf(V3 rest) const { return {dot(row0, rest), dot(row1, rest), dot(row2, rest)}; }
};

HWY_INLINE V3 rounded(V3 v) {
  const D d;
  const DF df;
  return {hn::PromoteTo(d, hn::DemoteTo(df, v.x)), hn::PromoteTo(d, hn::DemoteTo(df, v.y)),
          hn::PromoteTo(d, hn::DemoteTo(df, v.z))};
}

void Mass(const api::ParticleView& p, const RigidMembers& members, RigidMass& out) {
  const D d;
  Lanes mass;
  Lanes3 moment;
  V lightest = hn::Set(d, out.lightest);
  forMembers(members, [&](size_t part, Few few, const Indices& of) HWY_ATTR {
    const V m = of.massOf(p, few);
    mass.add(part, m);
    moment.add(part, m * loadFloats3(members.rest, few));
    lightest = hn::Min(lightest, gather(p.velocity, of.id).w);
  });
  double lane[kLanes];
  hn::StoreU(lightest, d, lane);
  out = {mass.sum(), *std::min_element(lane, lane + kLanes), moment.sum()};
}

void Offset(const api::ParticleView& p, const RigidMembers& members, const RigidPose& pose, const api::Float4* points,
            RigidOffset& out) {
  const D d;
  const PoseLanes lanes(pose);
  Lanes moved;
  Lanes3 shift, moments[3];
  forMembers(members, [&](size_t part, Few few, const Indices& of) HWY_ATTR {
    const V m = of.massOf(p, few);
    const V3 rest = loadFloats3(members.rest, few) - lanes.restCentre, arm = lanes.armOf(rest);
    const V3 off = gather(points, of.id).xyz - rounded(lanes.centre + arm);
    auto away = hn::Or(hn::Or(hn::Ne(off.x, hn::Zero(d)), hn::Ne(off.y, hn::Zero(d))), hn::Ne(off.z, hn::Zero(d)));
    if (few.count < kLanes) away = hn::And(away, hn::FirstN(d, few.count));
    moved.add(part, hn::IfThenElseZero(away, hn::Set(d, 1)));
    shift.add(part, m * off);
    const V3 weighted = m * (arm + off);
    moments[0].add(part, weighted.x * rest), moments[1].add(part, weighted.y * rest);
    moments[2].add(part, weighted.z * rest);
  });
  out.moved = moved.sum() > 0;
  out.shift = shift.sum();
  for (size_t row = 0; row < 3; ++row) out.moments.row[row] = moments[row].sum();
}

void Place(const RigidMembers& members, const RigidPose& pose, api::Float4* position) {
  const PoseLanes lanes(pose);
  forMembers(members, [&](size_t, Few few, const Indices& of) HWY_ATTR {
    const V3 rest = loadFloats3(members.rest, few) - lanes.restCentre;
    scatter(lanes.centre + lanes.armOf(rest), position, of.id, few);
  });
}

void Spread(const api::ParticleView& p, const RigidMembers& members, Vector restCentre, RigidSpread& out) {
  const D d;
  const V3 centre = all(restCentre);
  SecondLanes second;
  V farthest2 = hn::Zero(d);
  forMembers(members, [&](size_t part, Few few, const Indices& of) HWY_ATTR {
    const V m = of.massOf(p, few);
    const V3 place = loadFloats3(members.rest, few), r = place - centre;
    second.add(part, m * r, r);
    farthest2 = hn::Max(farthest2, dot(place, place));
  });
  out.second = second.sum();
  double lane[kLanes];
  hn::StoreU(farthest2, d, lane);
  out.farthest2 = *std::max_element(lane, lane + kLanes);
}

void Momentum(const api::ParticleView& p, const RigidMembers& members, Vector centre, const api::Float4* points,
              RigidMomentum& out) {
  const V3 middle = all(centre);
  Lanes3 linear, angular;
  forMembers(members, [&](size_t part, Few few, const Indices& of) HWY_ATTR {
    const V3 impulse = of.massOf(p, few) * gather(p.velocity, of.id).xyz;
    linear.add(part, impulse);
    angular.add(part, cross(gather(points, of.id).xyz - middle, impulse));
  });
  out = {linear.sum(), angular.sum()};
}

/// rate (x - from) in single precision, as velocities were computed from it.
HWY_INLINE V wayOf(V x, V from, float rate) {
  const DF df;
  const auto way = hn::Sub(hn::DemoteTo(df, x), hn::DemoteTo(df, from));
  return hn::PromoteTo(D(), hn::Mul(hn::Set(df, rate), way));
}

void ExtraMomentum(const api::ParticleView& p, const RigidMembers& members, Vector centre, float rate,
                   RigidMomentum& out) {
  const V3 middle = all(centre);
  Lanes3 linear, angular;
  forMembers(members, [&](size_t part, Few few, const Indices& of) HWY_ATTR {
    const V3 x = gather(p.position, of.id).xyz, from = gather(p.previous, of.id).xyz;
    const V3 way{wayOf(x.x, from.x, rate), wayOf(x.y, from.y, rate), wayOf(x.z, from.z, rate)};
    const V3 impulse = of.massOf(p, few) * (gather(p.velocity, of.id).xyz - way);
    linear.add(part, impulse);
    angular.add(part, cross(x - middle, impulse));
  });
  out = {linear.sum(), angular.sum()};
}

void Velocities(const RigidMembers& members, const RigidPose& pose, Vector velocity, Vector spin, api::Float4* to) {
  const PoseLanes lanes(pose);
  const V3 common = all(velocity), turning = all(spin);
  forMembers(members, [&](size_t, Few few, const Indices& of) HWY_ATTR {
    const V3 rest = loadFloats3(members.rest, few) - lanes.restCentre;
    scatter(common + cross(turning, lanes.armOf(rest)), to, of.id, few);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace ps::constraint
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ps::constraint {
namespace {

/// Members of a chunk, at least, and chunks at most: some microseconds, and sums that fit the stack.
constexpr size_t kMembers = 1024, kChunks = 64;
constexpr double kMicrosecondsPerMember = 0.002;

size_t chunkOf(const RigidMembers& members) {
  return std::max(kMembers, (members.count / kChunks + kMembers) / kMembers * kMembers);
}
/// The members [first, last) of a body.
RigidMembers part(const RigidMembers& members, size_t first, size_t last) {
  return {members.particles + first,
          last - first,
          {members.rest[0] + first, members.rest[1] + first, members.rest[2] + first}};
}
template <class Call>
void forParts(const RigidMembers& members, const Call& call) {
  api::shareAmong(members.threads, members.count, chunkOf(members),
                  kMicrosecondsPerMember * static_cast<double>(members.count),
                  [&](size_t first, size_t last) { call(part(members, first, last)); });
}
/// The sum of what call(members, part of it) finds by chunks, in their order.
template <class Sum, class Call>
Sum sumOfParts(const RigidMembers& members, const Call& call) {
  Sum sum;
  if (members.count <= kMembers) {
    call(members, sum);
    return sum;
  }
  std::array<Sum, kChunks> sums;
  const size_t chunk = chunkOf(members);
  api::shareAmong(members.threads, members.count, chunk, kMicrosecondsPerMember * static_cast<double>(members.count),
                  [&](size_t first, size_t last) { call(part(members, first, last), sums[first / chunk]); });
  sum = sums[0];
  for (size_t k = 1; k * chunk < members.count; ++k) sum += sums[k];
  return sum;
}

HWY_EXPORT(Mass);
HWY_EXPORT(Offset);
HWY_EXPORT(Place);
HWY_EXPORT(Spread);
HWY_EXPORT(Momentum);
HWY_EXPORT(ExtraMomentum);
HWY_EXPORT(Velocities);
}  // namespace

RigidMass massOf(const api::ParticleView& particles, const RigidMembers& members) {
  return sumOfParts<RigidMass>(members, [&](const RigidMembers& some, RigidMass& mass) {
    HWY_DYNAMIC_DISPATCH(Mass)(particles, some, mass);
  });
}

RigidOffset offsetOf(const api::ParticleView& particles, const RigidMembers& members, const RigidPose& pose,
                     const api::Float4* points) {
  return sumOfParts<RigidOffset>(members, [&](const RigidMembers& some, RigidOffset& offset) {
    HWY_DYNAMIC_DISPATCH(Offset)(particles, some, pose, points, offset);
  });
}

void placeMembers(const RigidMembers& members, const RigidPose& pose, api::Float4* position) {
  forParts(members, [&](const RigidMembers& some) { HWY_DYNAMIC_DISPATCH(Place)(some, pose, position); });
}

RigidSpread spreadOf(const api::ParticleView& particles, const RigidMembers& members, Vector restCentre) {
  return sumOfParts<RigidSpread>(members, [&](const RigidMembers& some, RigidSpread& spread) {
    HWY_DYNAMIC_DISPATCH(Spread)(particles, some, restCentre, spread);
  });
}

RigidMomentum momentumOf(const api::ParticleView& particles, const RigidMembers& members, Vector centre,
                         const api::Float4* points) {
  return sumOfParts<RigidMomentum>(members, [&](const RigidMembers& some, RigidMomentum& momentum) {
    HWY_DYNAMIC_DISPATCH(Momentum)(particles, some, centre, points, momentum);
  });
}

RigidMomentum extraMomentumOf(const api::ParticleView& particles, const RigidMembers& members, Vector centre,
                              float rate) {
  return sumOfParts<RigidMomentum>(members, [&](const RigidMembers& some, RigidMomentum& momentum) {
    HWY_DYNAMIC_DISPATCH(ExtraMomentum)(particles, some, centre, rate, momentum);
  });
}

void setVelocities(const RigidMembers& members, const RigidPose& pose, Vector velocity, Vector spin, api::Float4* to) {
  forParts(members, [&](const RigidMembers& some) {
    HWY_DYNAMIC_DISPATCH(Velocities)(some, pose, velocity, spin, to);
  });
}

}  // namespace ps::constraint
#endif
