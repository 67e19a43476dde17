// SPDX-License-Identifier: Apache-2.0
#include "rigidmodel.h"

#include "joining.h"
#include "rigidbody.h"
#include "rigidpieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace ps::constraint {
namespace {

using api::ConstraintContext;
using api::Float4;
using api::GroupBatch;
using api::Motion;
using api::NeighbourView;
using api::ParticleView;

/// Passes of the midpoint rule: each gains a factor of about (w dt)^2. What turns by more than this, in rad, does so in
/// several steps, as many as the last one at most.
constexpr int kMidpointPasses = 4;
constexpr double kLargestTurn = 0.1;
constexpr int kMostTurns = 32;

/// New particles between two words on how far the search for them has come: some milliseconds of work.
constexpr size_t kToldMembers = size_t{1} << 12;

constexpr api::ParameterDeclaration kParameters[] = {
    {"least_members", "Smallest piece", "n", "", api::ParameterKind::Integer, api::Scale::Linear, 4, 4, 64, 1, 1000, "",
     1, 0, "", "Structure",
     "Pieces of fewer particles are no bodies of their own: when a body melts apart they roll as single grains.",
     "4 keeps every splinter, 30 lets crumbs go", "the smallest piece that fills a volume has 4 particles"},
};

constexpr api::FieldType kFloat = api::FieldType::Float32;
constexpr api::FieldDeclaration kValues[] = {
    {"centre_x", "m", "Centre of mass, x", kFloat},
    {"centre_y", "m", "Centre of mass, y", kFloat},
    {"centre_z", "m", "Centre of mass, z", kFloat},
    {"rotation_x", "", "Rotation from the undeformed shape, unit quaternion, x", kFloat},
    {"rotation_y", "", "Rotation, y", kFloat},
    {"rotation_z", "", "Rotation, z", kFloat},
    {"rotation_w", "", "Rotation, w", kFloat},
    {"scale", "", "Size against the undeformed shape", kFloat},
    {"velocity_x", "m/s", "Velocity of the centre, x", kFloat},
    {"velocity_y", "m/s", "Velocity of the centre, y", kFloat},
    {"velocity_z", "m/s", "Velocity of the centre, z", kFloat},
    {"spin_x", "rad/s", "Angular velocity, x", kFloat},
    {"spin_y", "rad/s", "Angular velocity, y", kFloat},
    {"spin_z", "rad/s", "Angular velocity, z", kFloat},
};
constexpr api::FieldDeclaration kMemberValues[] = {
    {"rest_x", "m", "Place in the undeformed shape, x", kFloat},
    {"rest_y", "m", "Place in the undeformed shape, y", kFloat},
    {"rest_z", "m", "Place in the undeformed shape, z", kFloat},
    {"rest_volume", "m³", "Rest volume when it joined", kFloat},
};

constexpr api::FieldDeclaration kFields[] = {
    kJoiningFields[0],
    kJoiningFields[1],
    {kTouchField, "s", "How long the particle has touched another rigid body that it may join", kFloat},
};

/// From predict() until the substep is over: one thread leads through it, and each that does has its own.
thread_local RigidRests t_rests;

Vector centreOf(const Float4* points, const RigidBody& body) {
  Vector sum;
  for (size_t k = body.first(); k < body.last(); ++k) sum += body.mass(k) * vectorOf(points[body.particle(k)]);
  return 1 / body.mass() * sum;
}

/// Absorbs what happened to the members' positions into the pose, and the pose's change into the velocities. What
/// turned it was an impulse on the body as it stood before: the angular momentum goes on, not the angular velocity.
void absorb(RigidBody& body, const api::MovableParticles& particles, double dt) {
  if (body.held()) return body.placeMembers(particles.position);
  const RigidBody::Fit fit = body.fit(particles.position);
  if (!fit.moved) return;
  const Quaternion before = body.rotation(), after = body.rotationOf(fit);
  const RigidBody::Inertia inertia = body.restInertia();
  const Vector angular =
      RigidBody::turned(inertia.matrix, before, body.spin() + 1 / dt * logarithm(after * conjugate(before)));
  body.setMotion(body.velocity() + 1 / dt * fit.shift, RigidBody::turned(inertia.inverse, after, angular));
  body.setPose(body.centre() + fit.shift, after);
  body.placeMembers(particles.position);
}

/// Orientation after dt without forces: the angular momentum stays, while the inertia turns with the body. Midpoint
/// rule; its error of energy goes with the square of the angle of a step.
Quaternion turnedFreely(const Matrix& inverse, Quaternion from, Vector angular, double dt) {
  const Vector start = RigidBody::turned(inverse, from, angular);
  const double angle = dt * std::sqrt(dot(start, start));
  const int steps = angle < kMostTurns * kLargestTurn ? 1 + static_cast<int>(angle / kLargestTurn) : kMostTurns;
  const double h = dt / steps;
  for (int step = 0; step < steps; ++step) {
    Vector spin = RigidBody::turned(inverse, from, angular);
    for (int pass = 0; pass < kMidpointPasses; ++pass)
      spin = RigidBody::turned(inverse, exponential(0.5 * h * spin) * from, angular);
    from = exponential(h * spin) * from;
  }
  return from;
}

}  // namespace

RigidModel::RigidModel()
    : Described({"Rigid",
                 "Holds a solid together as one rigid body that keeps its momentum and its spin (prediction with the "
                 "gyroscopic term; contact absorbed by shape matching, Mueller et al. 2005 and 2016). Liquid pushes "
                 "it, it floats, and where it melts it falls into the pieces that are left. What freezes beside it "
                 "becomes part of it, and pieces that freeze or sinter together for half a second become one. It never "
                 "bends and never breaks by force: for matter too stiff for bonds, such as ice, stone and metal.",
                 api::listOf(kParameters)}) {}

const void* RigidModel::extension(const char* name) const noexcept {
  return std::string_view(name) == api::kGroupPoses ? static_cast<const api::GroupPoses*>(this) : nullptr;
}

bool RigidModel::traits(api::GroupTraits* out) const noexcept {
  return api::fill(out, {.rigid = 1,
                         .values = api::listOf(kValues),
                         .memberValues = api::listOf(kMemberValues),
                         .fields = api::listOf(kFields)});
}

void RigidModel::build(const ConstraintContext& context, const ParticleView& p, const NeighbourView& lists,
                       api::Span<const uint32_t> members, const GroupBatch& all, api::GroupSink& sink) const {
  constexpr size_t kNone = ~size_t{0};
  std::vector<size_t> groupOf(p.count, kNone);
  for (size_t g = 0; g < all.count; ++g) {
    for (size_t k = all.begin[g]; k < all.begin[g + 1]; ++k) groupOf[all.particles[k]] = g;
  }
  const Joining joining(context, p);
  for (const uint32_t i : members) joining.setKeeper(i, Keeper::Rigid);
  // New matter hangs together with its own and with what is there already of the same body; old bodies stay whole.
  std::vector<uint8_t> isNew(p.count, 0);
  for (const uint32_t i : members) isNew[i] = p.motion[i] == Motion::Solid && groupOf[i] == kNone ? 1 : 0;
  DisjointSets sets(p.count);
  for (size_t g = 0; g < all.count; ++g) {
    for (size_t k = all.begin[g]; k < all.begin[g + 1]; ++k) sets.unite(all.particles[all.begin[g]], all.particles[k]);
  }
  const double reach2 = kRigidReach * kRigidReach * context.spacing * context.spacing;
  std::vector<uint8_t> grows(all.count, 0);
  for (size_t k = 0; k < members.size; ++k) {
    if (k % kToldMembers == kToldMembers - 1) sink.advance(kToldMembers);
    const uint32_t i = members.data[k];
    if (isNew[i] == 0) continue;
    for (uint32_t q = lists.begin[i]; q < lists.last[i]; ++q) {
      const uint32_t j = lists.index[q];
      if (p.body[j] != p.body[i] || (isNew[j] == 0 && groupOf[j] == kNone)) continue;
      const Vector d = vectorOf(p.position[i]) - vectorOf(p.position[j]);
      if (!(dot(d, d) < reach2)) continue;
      sets.unite(i, j);
      if (groupOf[j] != kNone) grows[groupOf[j]] = 1;
    }
  }
  for (const std::vector<size_t>& set : sets.sets()) {
    if (set.size() < leastMembers(context.parameters)) continue;
    const bool touched = std::any_of(set.begin(), set.end(), [&](size_t i) { return isNew[i] != 0; });
    if (!touched) continue;
    // The undeformed shape is what stands here now: offsets from the first particle, so that they stay small.
    NewRigidGroup group;
    const Vector origin = vectorOf(p.position[set[0]]);
    for (const size_t i : set) {
      group.add(static_cast<uint32_t>(i), vectorOf(p.position[i]) - origin, p.position[i].w);
    }
    group.emit(centreOf(p, group.particles), {}, 1, sink);
  }
  for (size_t g = 0; g < all.count; ++g) {
    if (grows[g] != 0) sink.remove(g);
  }
}

void RigidModel::predict(const ConstraintContext& context, const api::MovableParticles& particles,
                         const GroupBatch& batch) const {
  const ParticleView& p = particles;
  for (size_t g = 0; g < batch.count; ++g) {
    RigidBody body(p, batch, g, m_threads, t_rests);
    // A frame that went wrong leaves no pose; edits, a bound or a frame taken back may have moved members since it was
    // written.
    if (!body.hasPose()) body.setPose(centreOf(p.previous, body), {});
    if (const RigidBody::Fit fit = body.fit(p.previous); fit.moved) {
      body.setPose(body.centre() + fit.shift, body.rotationOf(fit));
    }
    if (context.substep == 0) body.refreshScale();
    if (body.held()) {
      body.setMotion({}, {});
      body.placeMembers(particles.position);
      continue;
    }
    const RigidMomentum momentum = momentumOf(p, body.members(), body.centre(), p.previous);
    const Vector velocity = 1 / body.mass() * momentum.linear;
    const Matrix inverse = body.restInertia().inverse;
    const Quaternion to = turnedFreely(inverse, body.rotation(), momentum.angular, context.dt);
    body.setMotion(velocity, RigidBody::turned(inverse, to, momentum.angular));
    body.setPose(body.centre() + context.dt * velocity, to);
    body.placeMembers(particles.position);
  }
}

void RigidModel::project(const ConstraintContext& context, const api::MovableParticles& particles,
                         const GroupBatch& batch) const {
  const ParticleView& p = particles;
  for (size_t g = 0; g < batch.count; ++g) {
    RigidBody body(p, batch, g, m_threads, std::as_const(t_rests));
    absorb(body, particles, context.dt);
  }
}

void RigidModel::deriveVelocities(const ConstraintContext& context, const api::MovableParticles& particles,
                                  const GroupBatch& batch) const {
  const ParticleView& p = particles;
  const float rate = static_cast<float>(1 / context.dt);
  for (size_t g = 0; g < batch.count; ++g) {
    RigidBody body(p, batch, g, m_threads, std::as_const(t_rests));
    // What viscosity gave: the velocity without the way of the substep, which was computed just so.
    const RigidMomentum momentum = extraMomentumOf(p, body.members(), body.centre(), rate);
    absorb(body, particles, context.dt);
    if (body.held()) {
      setVelocities(body.members(), body.pose(), {}, {}, particles.velocity);
      continue;
    }
    const Vector velocity = body.velocity() + 1 / body.mass() * momentum.linear;
    const Vector spin = body.spin() + RigidBody::turned(body.restInertia().inverse, body.rotation(), momentum.angular);
    body.setMotion(velocity, spin);
    setVelocities(body.members(), body.pose(), velocity, spin, particles.velocity);
  }
}

void RigidModel::restoreMembers(const ConstraintContext&, const api::MovableParticles& particles, const GroupBatch& all,
                                const uint8_t* returned) const {
  const ParticleView& p = particles;
  auto* touch = static_cast<float*>(p.fields->write(kTouchField, api::FieldType::Float32));
  for (size_t g = 0; g < all.count; ++g) {
    const size_t first = all.begin[g], last = all.begin[g + 1];
    const size_t back = static_cast<size_t>(std::count(returned + first, returned + last, uint8_t{1}));
    if (back == 0 || back == last - first) continue;
    // The pose of those that stayed, as a group of their own.
    std::vector<uint32_t> stayers;
    std::vector<std::vector<float>> memberValues(kMemberValueCount);
    for (size_t k = first; k < last; ++k) {
      if (returned[k] != 0) continue;
      stayers.push_back(all.particles[k]);
      for (size_t v = 0; v < kMemberValueCount; ++v) memberValues[v].push_back(all.memberValues[v][k]);
    }
    std::vector<float> values(kValueCount);
    std::array<float*, kValueCount> valuePointers{};
    for (size_t v = 0; v < kValueCount; ++v) values[v] = all.values[v][g], valuePointers[v] = &values[v];
    std::array<float*, kMemberValueCount> memberPointers{};
    for (size_t v = 0; v < kMemberValueCount; ++v) memberPointers[v] = memberValues[v].data();
    const std::array<size_t, 2> begin{0, stayers.size()};
    const uint8_t changed = 0;
    const GroupBatch rest{1, begin.data(), stayers.data(), valuePointers.data(), memberPointers.data(), &changed};
    RigidBody stayed(p, rest, 0, m_threads);
    const RigidBody::Fit fit = stayed.fit(p.position);
    stayed.setPose(stayed.centre() + fit.shift, stayed.rotationOf(fit));
    const RigidMomentum momentum = momentumOf(p, stayed.members(), stayed.centre(), p.position);
    const Vector velocity = 1 / stayed.mass() * momentum.linear;
    const Vector spin = RigidBody::turned(stayed.restInertia().inverse, stayed.rotation(), momentum.angular);
    for (size_t k = first; k < last; ++k) {
      if (returned[k] == 0) continue;
      touch[all.particles[k]] = kReturned;
      const Vector arm = stayed.armOf(restPlaceOf(all, k));
      setVector(particles.position[all.particles[k]], stayed.centre() + arm);
      setVector(particles.velocity[all.particles[k]], velocity + cross(spin, arm));
    }
    RigidBody whole(p, all, g, m_threads);
    whole.setPose(stayed.centre() + stayed.armOf(whole.restCentre()), stayed.rotation());
  }
}

void RigidModel::carry(const ConstraintContext&, const api::MovableParticles& particles, const GroupBatch& all,
                       const uint8_t* carried, const api::Carrying& carrying) const {
  const Quaternion turn{carrying.turn[0], carrying.turn[1], carrying.turn[2], carrying.turn[3]};
  const Matrix m = matrixOf(turn);
  const api::Double3 &shift = carrying.shift, &push = carrying.push;
  for (size_t g = 0; g < all.count; ++g) {
    if (carried[g] == 0) continue;
    RigidBody body(particles, all, g, m_threads);
    if (!body.hasPose()) continue;
    body.setMotion(m * body.velocity() + Vector{push.x, push.y, push.z}, m * body.spin());
    body.setPose(m * body.centre() + Vector{shift.x, shift.y, shift.z}, normalised(turn * body.rotation()));
    body.placeMembers(particles.position);
    setVelocities(body.members(), body.pose(), body.velocity(), body.spin(), particles.velocity);
  }
}

}  // namespace ps::constraint
