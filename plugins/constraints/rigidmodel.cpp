// SPDX-License-Identifier: Apache-2.0
#include "rigidmodel.h"

#include "rigidpieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace ps::constraint {
namespace {

using api::ConstraintContext;
using api::Float4;
using api::GroupBatch;
using api::Motion;
using api::NeighbourView;
using api::ParticleView;

/// Particles hang together across the axial and face-diagonal steps of a cubic lattice, 1 and 1.414 spacings.
constexpr double kReach = 1.5;
/// Passes of the midpoint rule: each gains a factor of about (w dt)^2.
constexpr int kMidpointPasses = 4;

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

Vector vectorOf(const Float4& v) { return {v.x, v.y, v.z}; }
void setVector(Float4& to, Vector from) {
  to.x = static_cast<float>(from.x), to.y = static_cast<float>(from.y), to.z = static_cast<float>(from.z);
}

/// One group and its pose, which lives in the group's values, in single precision: what is computed from it is the same
/// whenever it is computed, so that a body that nothing has touched is found to be exactly where it was put.
class Body {
 public:
  Body(const ParticleView& p, const GroupBatch& batch, size_t g)
      : m_p(p), m_batch(batch), m_group(g), m_first(batch.begin[g]), m_last(batch.begin[g + 1]) {
    for (size_t k = m_first; k < m_last; ++k) {
      const double m = mass(k);
      m_mass += m;
      m_restCentre += m * restPlace(k);
    }
    m_restCentre = 1 / m_mass * m_restCentre;
    load();
  }

  size_t first() const { return m_first; }
  size_t last() const { return m_last; }
  uint32_t particle(size_t k) const { return m_batch.particles[k]; }
  double mass(size_t k) const { return m_p.mass[particle(k)]; }
  Vector rest(size_t k) const { return restPlace(k) - m_restCentre; }
  double mass() const { return m_mass; }
  Vector centre() const { return m_centre; }
  Vector velocity() const { return valueVector(RigidModel::kVelocityX); }
  Vector spin() const { return valueVector(RigidModel::kSpinX); }
  Quaternion rotation() const { return m_rotation; }
  bool hasPose() const { return std::isfinite(m_centre.x + m_centre.y + m_centre.z); }
  void setMotion(Vector velocity, Vector spin) {
    setValues(RigidModel::kVelocityX, velocity);
    setValues(RigidModel::kSpinX, spin);
  }
  void setPose(Vector centre, Quaternion rotation) {
    setValues(RigidModel::kCentreX, centre);
    setValues(RigidModel::kRotationX, {rotation.x, rotation.y, rotation.z});
    value(RigidModel::kRotationW) = static_cast<float>(rotation.w);
    load();
  }
  /// Rest volumes now against those of the undeformed shape.
  void refreshScale() {
    double now = 0, then = 0;
    for (size_t k = m_first; k < m_last; ++k) {
      now += double{m_p.position[particle(k)].w};
      then += double{m_batch.memberValues[RigidModel::kRestVolume][k]};
    }
    value(RigidModel::kScale) = then > 0 ? static_cast<float>(cubeRoot(now / then)) : 1.0f;
    load();
  }

  /// From the centre to a member's place in the pose.
  Vector arm(size_t k) const { return m_scaledRotation * rest(k); }
  /// The same of any place in the undeformed frame.
  Vector armOf(Vector restPlace) const { return m_scaledRotation * (restPlace - m_restCentre); }
  Vector restCentre() const { return m_restCentre; }
  /// A member's place, rounded as it is stored.
  Float4 place(size_t k) const {
    Float4 at{0, 0, 0, m_p.position[particle(k)].w};
    setVector(at, m_centre + arm(k));
    return at;
  }
  void placeMembers() const {
    for (size_t k = m_first; k < m_last; ++k) m_p.position[particle(k)] = place(k);
  }

  /// How far points have left the pose.
  struct Fit {
    bool moved = false;
    Vector shift;    ///< of the centre
    Matrix moments;  ///< sum of m x rest^T about the new centre
  };
  Fit fit(const Float4* points) const {
    Fit result;
    for (size_t k = m_first; k < m_last; ++k) {
      const Float4 at = place(k), is = points[particle(k)];
      const Vector off{double{is.x} - double{at.x}, double{is.y} - double{at.y}, double{is.z} - double{at.z}};
      result.moved = result.moved || off.x != 0 || off.y != 0 || off.z != 0;
      result.shift += mass(k) * off;
      addOuter(result.moments, mass(k), arm(k) + off, rest(k));
    }
    result.shift = 1 / m_mass * result.shift;
    return result;
  }
  Quaternion rotationOf(const Fit& fit) const { return constraint::rotationOf(fit.moments, m_rotation); }

  /// Inverse of the inertia in the undeformed frame; applied in the world's by inverseInertia().
  Matrix restInverseInertia() const {
    Matrix inertia;
    const double scale2 = m_scale * m_scale;
    for (size_t k = m_first; k < m_last; ++k) {
      const Vector r = rest(k);
      const double m = scale2 * mass(k), r2 = dot(r, r);
      addOuter(inertia, -m, r, r);
      inertia.row[0].x += m * r2, inertia.row[1].y += m * r2, inertia.row[2].z += m * r2;
    }
    return pseudoInverse(inertia);
  }
  /// I^-1 L at an orientation.
  static Vector turned(const Matrix& restInverse, Quaternion rotation, Vector momentum) {
    const Matrix r = matrixOf(rotation);
    return r * (restInverse * transposedTimes(r, momentum));
  }

 private:
  float& value(RigidModel::Value v) const { return m_batch.values[v][m_group]; }
  Vector valueVector(size_t x) const {
    return {m_batch.values[x][m_group], m_batch.values[x + 1][m_group], m_batch.values[x + 2][m_group]};
  }
  void setValues(size_t x, Vector v) const {
    m_batch.values[x][m_group] = static_cast<float>(v.x);
    m_batch.values[x + 1][m_group] = static_cast<float>(v.y);
    m_batch.values[x + 2][m_group] = static_cast<float>(v.z);
  }
  Vector restPlace(size_t k) const {
    return {m_batch.memberValues[RigidModel::kRestX][k], m_batch.memberValues[RigidModel::kRestY][k],
            m_batch.memberValues[RigidModel::kRestZ][k]};
  }
  void load() {
    m_centre = valueVector(RigidModel::kCentreX);
    const Vector q = valueVector(RigidModel::kRotationX);
    m_rotation = normalised({q.x, q.y, q.z, value(RigidModel::kRotationW)});
    m_scale = value(RigidModel::kScale);
    m_scaledRotation = matrixOf(m_rotation);
    for (Vector& row : m_scaledRotation.row) row = m_scale * row;
  }

  const ParticleView& m_p;
  const GroupBatch& m_batch;
  size_t m_group, m_first, m_last;
  double m_mass = 0, m_scale = 1;
  Vector m_restCentre, m_centre;
  Quaternion m_rotation;
  Matrix m_scaledRotation;
};

/// Linear momentum, and angular momentum about the centre of mass, of members at `points`.
struct Momentum {
  Vector linear, angular;
};
template <class Velocity>
Momentum momentumOf(const Body& body, const Float4* points, Velocity&& velocityOf) {
  Momentum sum;
  for (size_t k = body.first(); k < body.last(); ++k) {
    const uint32_t i = body.particle(k);
    const Vector impulse = body.mass(k) * velocityOf(i);
    sum.linear += impulse;
    sum.angular += cross(vectorOf(points[i]) - body.centre(), impulse);
  }
  return sum;
}

Vector centreOf(const Float4* points, const Body& body) {
  Vector sum;
  for (size_t k = body.first(); k < body.last(); ++k) sum += body.mass(k) * vectorOf(points[body.particle(k)]);
  return 1 / body.mass() * sum;
}

/// Absorbs what happened to the members' positions into the pose, and the pose's change into the velocities.
void absorb(Body& body, const ParticleView& p, double dt) {
  const Body::Fit fit = body.fit(p.position);
  if (!fit.moved) return;
  const Quaternion before = body.rotation(), after = body.rotationOf(fit);
  body.setMotion(body.velocity() + 1 / dt * fit.shift, body.spin() + 1 / dt * logarithm(after * conjugate(before)));
  body.setPose(body.centre() + fit.shift, after);
  body.placeMembers();
}

/// A new group of `members`, given by their places in the undeformed frame.
struct NewGroup {
  std::vector<uint32_t> particles;
  std::vector<float> memberValues;
  void add(uint32_t particle, Vector rest, float volume) {
    particles.push_back(particle);
    for (const double c : {rest.x, rest.y, rest.z}) memberValues.push_back(static_cast<float>(c));
    memberValues.push_back(volume);
  }
  void emit(Vector centre, Quaternion q, float scale, api::GroupSink& sink) const {
    std::array<float, RigidModel::kValueCount> values{};
    const double pose[] = {centre.x, centre.y, centre.z, q.x, q.y, q.z, q.w};
    for (size_t v = 0; v < std::size(pose); ++v) values[v] = static_cast<float>(pose[v]);
    values[RigidModel::kScale] = scale;
    sink.add(particles.data(), particles.size(), values.data(), memberValues.data());
  }
};

size_t leastMembers(api::Span<const double> parameters) {
  return static_cast<size_t>(std::max(1.0, parameters[RigidModel::kLeastMembers]));
}

/// Centre of mass of particles where they are now.
Vector centreOf(const ParticleView& p, const std::vector<uint32_t>& particles) {
  Vector sum;
  double mass = 0;
  for (const uint32_t i : particles) {
    sum += double{p.mass[i]} * vectorOf(p.position[i]);
    mass += double{p.mass[i]};
  }
  return 1 / mass * sum;
}

}  // namespace

const char* RigidModel::label() const noexcept { return "Rigid"; }

const char* RigidModel::help() const noexcept {
  return "Holds a solid together as one rigid body that keeps its momentum and its spin (prediction with the "
         "gyroscopic "
         "term; contact absorbed by shape matching, Mueller et al. 2005 and 2016). Liquid pushes it, it floats, and "
         "where it melts it falls into the pieces that are left. It never bends and never breaks by force: for matter "
         "too stiff for bonds, such as ice, stone and metal.";
}

api::ParameterList RigidModel::parameters() const noexcept { return api::listOf(kParameters); }

api::ConstraintTraits RigidModel::traits() const noexcept {
  return {api::ConstraintTraits::Form::Group, 0, api::listOf(kValues), {}, api::listOf(kMemberValues), 1};
}

void RigidModel::buildGroups(const ConstraintContext& context, const ParticleView& p, const NeighbourView& lists,
                             api::Span<const uint32_t> members, const GroupBatch& all, api::GroupSink& sink) const {
  constexpr size_t kNone = ~size_t{0};
  std::vector<size_t> groupOf(p.count, kNone);
  for (size_t g = 0; g < all.count; ++g) {
    for (size_t k = all.begin[g]; k < all.begin[g + 1]; ++k) groupOf[all.particles[k]] = g;
  }
  // New matter hangs together with its own and with what is there already of the same body; old bodies stay whole.
  std::vector<uint8_t> isNew(p.count, 0);
  for (const uint32_t i : members) isNew[i] = p.motion[i] == Motion::Solid && groupOf[i] == kNone ? 1 : 0;
  DisjointSets sets(p.count);
  for (size_t g = 0; g < all.count; ++g) {
    for (size_t k = all.begin[g]; k < all.begin[g + 1]; ++k) sets.unite(all.particles[all.begin[g]], all.particles[k]);
  }
  const double reach2 = kReach * kReach * context.spacing * context.spacing;
  std::vector<uint8_t> grows(all.count, 0);
  for (const uint32_t i : members) {
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
    NewGroup group;
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

void RigidModel::predictGroups(const ConstraintContext& context, const ParticleView& p, const GroupBatch& batch) const {
  for (size_t g = 0; g < batch.count; ++g) {
    Body body(p, batch, g);
    // A frame that went wrong leaves no pose; edits, a bound or a frame taken back may have moved members since it was
    // written.
    if (!body.hasPose()) body.setPose(centreOf(p.previous, body), {});
    if (const Body::Fit fit = body.fit(p.previous); fit.moved) {
      body.setPose(body.centre() + fit.shift, body.rotationOf(fit));
    }
    if (context.substep == 0) body.refreshScale();
    const Momentum momentum = momentumOf(body, p.previous, [&](uint32_t i) { return vectorOf(p.velocity[i]); });
    const Vector velocity = 1 / body.mass() * momentum.linear;
    const Matrix inverse = body.restInverseInertia();
    const Quaternion from = body.rotation();
    Vector spin = Body::turned(inverse, from, momentum.angular);
    for (int pass = 0; pass < kMidpointPasses; ++pass) {
      spin = Body::turned(inverse, exponential(0.5 * context.dt * spin) * from, momentum.angular);
    }
    const Quaternion to = exponential(context.dt * spin) * from;
    body.setMotion(velocity, Body::turned(inverse, to, momentum.angular));
    body.setPose(body.centre() + context.dt * velocity, to);
    body.placeMembers();
  }
}

void RigidModel::projectGroups(const ConstraintContext& context, const ParticleView& p, const GroupBatch& batch) const {
  for (size_t g = 0; g < batch.count; ++g) {
    Body body(p, batch, g);
    absorb(body, p, context.dt);
  }
}

void RigidModel::deriveGroupVelocities(const ConstraintContext& context, const ParticleView& p,
                                       const GroupBatch& batch) const {
  const float rate = static_cast<float>(1 / context.dt);
  for (size_t g = 0; g < batch.count; ++g) {
    Body body(p, batch, g);
    // What viscosity gave: the velocity without the way of the substep, which was computed just so.
    const Momentum given = momentumOf(body, p.position, [&](uint32_t i) {
      const Float4 &x = p.position[i], &from = p.previous[i], &v = p.velocity[i];
      return Vector{double{v.x} - double{rate * (x.x - from.x)}, double{v.y} - double{rate * (x.y - from.y)},
                    double{v.z} - double{rate * (x.z - from.z)}};
    });
    absorb(body, p, context.dt);
    const Vector velocity = body.velocity() + 1 / body.mass() * given.linear;
    const Vector spin = body.spin() + Body::turned(body.restInverseInertia(), body.rotation(), given.angular);
    body.setMotion(velocity, spin);
    for (size_t k = body.first(); k < body.last(); ++k) {
      setVector(p.velocity[body.particle(k)], velocity + cross(spin, body.arm(k)));
    }
  }
}

void RigidModel::groupTopology(const ConstraintContext& context, const ParticleView& p, const NeighbourView&,
                               const GroupBatch& all, api::GroupSink& sink) const {
  for (size_t g = 0; g < all.count; ++g) {
    const Body body(p, all, g);
    const size_t least = leastMembers(context.parametersOf(p.body[body.particle(body.first())]));
    std::vector<size_t> kept;
    for (size_t k = body.first(); k < body.last(); ++k) {
      if (p.motion[body.particle(k)] == Motion::Solid) kept.push_back(k);
    }
    const size_t before = body.last() - body.first();
    if (kept.size() == before && all.changed[g] == 0) continue;
    std::vector<Vector> rest;
    rest.reserve(kept.size());
    for (const size_t k : kept) rest.push_back(body.rest(k));
    const std::vector<std::vector<size_t>> pieces = piecesOf(rest, kReach * context.spacing);
    const bool whole = pieces.size() == 1 && kept.size() == before;
    if (whole && before >= least) continue;
    sink.remove(g);
    // Members keep their velocities, and a body takes its momentum from them: none is lost by falling apart.
    for (const std::vector<size_t>& piece : pieces) {
      if (piece.size() < least) continue;
      NewGroup group;
      for (const size_t member : piece) {
        const size_t k = kept[member];
        const Vector place{all.memberValues[kRestX][k], all.memberValues[kRestY][k], all.memberValues[kRestZ][k]};
        group.add(body.particle(k), place, all.memberValues[kRestVolume][k]);
      }
      group.emit(centreOf(p, group.particles), body.rotation(), all.values[kScale][g], sink);
    }
  }
}

void RigidModel::restoreMembers(const ConstraintContext&, const ParticleView& p, const GroupBatch& all,
                                const uint8_t* returned) const {
  for (size_t g = 0; g < all.count; ++g) {
    const size_t first = all.begin[g], last = all.begin[g + 1];
    const size_t back = static_cast<size_t>(std::count(returned + first, returned + last, uint8_t{1}));
    if (back == 0 || back == last - first) continue;
    // The pose of those that stayed, as a group of their own.
    std::vector<uint32_t> particles;
    std::vector<std::vector<float>> memberValues(kMemberValueCount);
    for (size_t k = first; k < last; ++k) {
      if (returned[k] != 0) continue;
      particles.push_back(all.particles[k]);
      for (size_t v = 0; v < kMemberValueCount; ++v) memberValues[v].push_back(all.memberValues[v][k]);
    }
    std::vector<float> values(kValueCount);
    std::array<float*, kValueCount> valuePointers{};
    for (size_t v = 0; v < kValueCount; ++v) values[v] = all.values[v][g], valuePointers[v] = &values[v];
    std::array<float*, kMemberValueCount> memberPointers{};
    for (size_t v = 0; v < kMemberValueCount; ++v) memberPointers[v] = memberValues[v].data();
    const std::array<size_t, 2> begin{0, particles.size()};
    const uint8_t changed = 0;
    const GroupBatch rest{1, begin.data(), particles.data(), valuePointers.data(), memberPointers.data(), &changed};
    Body stayed(p, rest, 0);
    const Body::Fit fit = stayed.fit(p.position);
    stayed.setPose(stayed.centre() + fit.shift, stayed.rotationOf(fit));
    const Momentum momentum = momentumOf(stayed, p.position, [&](uint32_t i) { return vectorOf(p.velocity[i]); });
    const Vector velocity = 1 / stayed.mass() * momentum.linear;
    const Vector spin = Body::turned(stayed.restInverseInertia(), stayed.rotation(), momentum.angular);
    for (size_t k = first; k < last; ++k) {
      if (returned[k] == 0) continue;
      const Vector place{all.memberValues[kRestX][k], all.memberValues[kRestY][k], all.memberValues[kRestZ][k]};
      const Vector arm = stayed.armOf(place);
      setVector(p.position[all.particles[k]], stayed.centre() + arm);
      setVector(p.velocity[all.particles[k]], velocity + cross(spin, arm));
    }
    Body whole(p, all, g);
    whole.setPose(stayed.centre() + stayed.armOf(whole.restCentre()), stayed.rotation());
  }
}

}  // namespace ps::constraint
