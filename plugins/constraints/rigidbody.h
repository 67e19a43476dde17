// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "rigidkernels.h"
#include "rigidmodel.h"
#include "rigidrest.h"
#include "rotation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace ps::constraint {

/// Particles of a rigid body hang together across the axial and face-diagonal steps of a cubic lattice, 1 and 1.414
/// spacings.
constexpr double kRigidReach = 1.5;
/// Field: s, how long a member has touched another body that it may join.
inline constexpr const char* kTouchField = "rigid.touch";
/// What it says of members that undo has put back, until the next frame.
inline constexpr float kReturned = 1e9f;

/// m, of the member at place k of the batch, in the undeformed frame.
inline Vector restPlaceOf(const api::GroupBatch& batch, size_t k) {
  const auto of = [&](RigidModel::MemberValue v) { return batch.memberValues[v][k]; };
  return {of(RigidModel::kRestX), of(RigidModel::kRestY), of(RigidModel::kRestZ)};
}

/// One group and its pose, which lives in the group's values, in single precision: what is computed from it is the same
/// whenever it is computed, so that a body that nothing has touched is found to be exactly where it was put.
class RigidBody {
 public:
  RigidBody(const api::ParticleView& p, const api::GroupBatch& batch, size_t g, const api::Threads* threads)
      : RigidBody(p, batch, g, threads, nullptr) {}
  /// As it is predicted: what rests is noted.
  RigidBody(const api::ParticleView& p, const api::GroupBatch& batch, size_t g, const api::Threads* threads,
            RigidRests& rests)
      : RigidBody(p, batch, g, threads, &rests.note(p, membersOf(batch, g, threads))) {}
  /// Later in the substep.
  RigidBody(const api::ParticleView& p, const api::GroupBatch& batch, size_t g, const api::Threads* threads,
            const RigidRests& rests)
      : RigidBody(p, batch, g, threads, rests.find(membersOf(batch, g, threads))) {}

  size_t first() const { return m_first; }
  size_t last() const { return m_last; }
  uint32_t particle(size_t k) const { return m_batch.particles[k]; }
  double mass(size_t k) const { return m_p.mass[particle(k)]; }
  Vector rest(size_t k) const { return restPlaceOf(m_batch, k) - m_pose.restCentre; }
  double mass() const { return m_mass; }
  /// One of its members is held, and so is all that is one body with it.
  bool held() const { return m_held; }
  RigidMembers members() const { return membersOf(m_batch, m_group, m_threads); }
  const RigidPose& pose() const { return m_pose; }
  Vector centre() const { return m_pose.centre; }
  Vector velocity() const { return valueVector(RigidModel::kVelocityX); }
  Vector spin() const { return valueVector(RigidModel::kSpinX); }
  Quaternion rotation() const { return m_rotation; }
  bool hasPose() const { return std::isfinite(m_pose.centre.x + m_pose.centre.y + m_pose.centre.z); }
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

  /// From the centre to where a place in the undeformed frame is in the pose.
  Vector armOf(Vector restPlace) const { return m_pose.turned * (restPlace - m_pose.restCentre); }
  Vector restCentre() const { return m_pose.restCentre; }
  double scale() const { return m_scale; }
  /// Where in the undeformed frame a place in the world is.
  Vector restOf(Vector place) const {
    return m_pose.restCentre + 1 / (m_scale * m_scale) * transposedTimes(m_pose.turned, place - m_pose.centre);
  }
  /// Rounded as they are stored.
  void placeMembers(api::Float4* position) const { constraint::placeMembers(members(), m_pose, position); }

  /// How far points have left the pose.
  struct Fit {
    bool moved = false;
    Vector shift;    ///< of the centre
    Matrix moments;  ///< sum of m x rest^T about the new centre
  };
  Fit fit(const api::Float4* points) const {
    const RigidOffset offset = offsetOf(m_p, members(), m_pose, points);
    return {offset.moved, 1 / m_mass * offset.shift, offset.moments};
  }
  Quaternion rotationOf(const Fit& fit) const { return constraint::rotationOf(fit.moments, m_rotation); }

  /// Inertia in the undeformed frame, kg m2; applied in the world's by turned().
  struct Inertia {
    Matrix matrix, inverse;
  };
  /// Places are stored in single precision: below 1e-5 of their distance from the origin there is no shape, as in a
  /// body of one grain, only rounding, which must not be taken for an inertia.
  Inertia restInertia() const {
    const RigidSpread spread = m_rest ? m_rest->spread : spreadOf(m_p, members(), m_pose.restCentre);
    const double scale2 = m_scale * m_scale;
    const double trace = spread.second.row[0].x + spread.second.row[1].y + spread.second.row[2].z;
    Inertia inertia;
    for (size_t row = 0; row < 3; ++row) inertia.matrix.row[row] = -scale2 * spread.second.row[row];
    inertia.matrix.row[0].x += scale2 * trace, inertia.matrix.row[1].y += scale2 * trace;
    inertia.matrix.row[2].z += scale2 * trace;
    inertia.inverse = pseudoInverse(inertia.matrix, 1e-10 * scale2 * m_mass * spread.farthest2);
    return inertia;
  }
  /// A matrix of the undeformed frame times a vector of the world's, at an orientation: I w or I^-1 L.
  static Vector turned(const Matrix& rest, Quaternion rotation, Vector vector) {
    const Matrix r = matrixOf(rotation);
    return r * (rest * transposedTimes(r, vector));
  }

 private:
  RigidBody(const api::ParticleView& p, const api::GroupBatch& batch, size_t g, const api::Threads* threads,
            const RigidRest* rest)
      : m_p(p),
        m_batch(batch),
        m_threads(threads),
        m_group(g),
        m_first(batch.begin[g]),
        m_last(batch.begin[g + 1]),
        m_rest(rest) {
    const RigidMass sums = rest ? rest->mass : massOf(p, members());
    m_mass = sums.mass;
    m_held = sums.lightest == 0;
    m_pose.restCentre = 1 / m_mass * sums.moment;
    load();
  }
  static RigidMembers membersOf(const api::GroupBatch& batch, size_t g, const api::Threads* threads) {
    const size_t first = batch.begin[g];
    const auto of = [&](RigidModel::MemberValue v) { return batch.memberValues[v] + first; };
    return {batch.particles + first,
            batch.begin[g + 1] - first,
            {of(RigidModel::kRestX), of(RigidModel::kRestY), of(RigidModel::kRestZ)},
            threads};
  }
  float& value(RigidModel::Value v) const { return m_batch.values[v][m_group]; }
  Vector valueVector(size_t x) const {
    return {m_batch.values[x][m_group], m_batch.values[x + 1][m_group], m_batch.values[x + 2][m_group]};
  }
  void setValues(size_t x, Vector v) const {
    m_batch.values[x][m_group] = static_cast<float>(v.x);
    m_batch.values[x + 1][m_group] = static_cast<float>(v.y);
    m_batch.values[x + 2][m_group] = static_cast<float>(v.z);
  }
  void load() {
    m_pose.centre = valueVector(RigidModel::kCentreX);
    const Vector q = valueVector(RigidModel::kRotationX);
    m_rotation = normalised({q.x, q.y, q.z, value(RigidModel::kRotationW)});
    m_scale = value(RigidModel::kScale);
    m_pose.turned = matrixOf(m_rotation);
    for (Vector& row : m_pose.turned.row) row = m_scale * row;
  }

  const api::ParticleView& m_p;
  const api::GroupBatch& m_batch;
  const api::Threads* m_threads;
  size_t m_group, m_first, m_last;
  const RigidRest* m_rest;  ///< nullptr: not known
  double m_mass = 0, m_scale = 1;
  bool m_held = false;
  RigidPose m_pose;
  Quaternion m_rotation;
};

/// A new group of `members`, given by their places in the undeformed frame.
struct NewRigidGroup {
  std::vector<uint32_t> particles;
  std::vector<float> memberValues;
  void add(uint32_t particle, Vector rest, float volume) {
    particles.push_back(particle);
    for (const double c : {rest.x, rest.y, rest.z}) memberValues.push_back(static_cast<float>(c));
    memberValues.push_back(volume);
  }
  /// Room for so many, each of which is then set().
  void resize(size_t count) {
    particles.resize(count);
    memberValues.resize(count * RigidModel::kMemberValueCount);
  }
  void set(size_t n, uint32_t particle, Vector rest, float volume) {
    particles[n] = particle;
    float* values = memberValues.data() + n * RigidModel::kMemberValueCount;
    values[RigidModel::kRestX] = static_cast<float>(rest.x);
    values[RigidModel::kRestY] = static_cast<float>(rest.y);
    values[RigidModel::kRestZ] = static_cast<float>(rest.z);
    values[RigidModel::kRestVolume] = volume;
  }
  void emit(Vector centre, Quaternion q, float scale, api::GroupSink& sink) const {
    std::array<float, RigidModel::kValueCount> values{};
    const double pose[] = {centre.x, centre.y, centre.z, q.x, q.y, q.z, q.w};
    for (size_t v = 0; v < std::size(pose); ++v) values[v] = static_cast<float>(pose[v]);
    values[RigidModel::kScale] = scale;
    sink.add(particles.data(), particles.size(), values.data(), memberValues.data());
  }
};

inline size_t leastMembers(api::Span<const double> parameters) {
  return static_cast<size_t>(std::max(1.0, parameters[RigidModel::kLeastMembers]));
}

/// Centre of mass of particles where they are now.
inline Vector centreOf(const api::ParticleView& p, const std::vector<uint32_t>& particles) {
  Vector sum;
  double mass = 0;
  for (const uint32_t i : particles) {
    sum += double{p.mass[i]} * vectorOf(p.position[i]);
    mass += double{p.mass[i]};
  }
  return 1 / mass * sum;
}

}  // namespace ps::constraint
