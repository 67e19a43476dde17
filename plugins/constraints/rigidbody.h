// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "rigidmodel.h"
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

/// One group and its pose, which lives in the group's values, in single precision: what is computed from it is the same
/// whenever it is computed, so that a body that nothing has touched is found to be exactly where it was put.
class RigidBody {
 public:
  RigidBody(const api::ParticleView& p, const api::GroupBatch& batch, size_t g)
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
  double scale() const { return m_scale; }
  /// Where in the undeformed frame a place in the world is.
  Vector restOf(Vector place) const {
    return m_restCentre + 1 / (m_scale * m_scale) * transposedTimes(m_scaledRotation, place - m_centre);
  }
  /// A member's place, rounded as it is stored.
  api::Float4 place(size_t k) const {
    api::Float4 at{0, 0, 0, m_p.position[particle(k)].w};
    setVector(at, m_centre + arm(k));
    return at;
  }
  void placeMembers(api::Float4* position) const {
    for (size_t k = m_first; k < m_last; ++k) position[particle(k)] = place(k);
  }

  /// How far points have left the pose.
  struct Fit {
    bool moved = false;
    Vector shift;    ///< of the centre
    Matrix moments;  ///< sum of m x rest^T about the new centre
  };
  Fit fit(const api::Float4* points) const {
    Fit result;
    for (size_t k = m_first; k < m_last; ++k) {
      const api::Float4 at = place(k), is = points[particle(k)];
      const Vector off{double{is.x} - double{at.x}, double{is.y} - double{at.y}, double{is.z} - double{at.z}};
      result.moved = result.moved || off.x != 0 || off.y != 0 || off.z != 0;
      result.shift += mass(k) * off;
      addOuter(result.moments, mass(k), arm(k) + off, rest(k));
    }
    result.shift = 1 / m_mass * result.shift;
    return result;
  }
  Quaternion rotationOf(const Fit& fit) const { return constraint::rotationOf(fit.moments, m_rotation); }

  /// Inertia in the undeformed frame, kg m2; applied in the world's by turned().
  Matrix restInertia() const {
    Matrix inertia;
    const double scale2 = m_scale * m_scale;
    for (size_t k = m_first; k < m_last; ++k) {
      const Vector r = rest(k);
      const double m = scale2 * mass(k), r2 = dot(r, r);
      addOuter(inertia, -m, r, r);
      inertia.row[0].x += m * r2, inertia.row[1].y += m * r2, inertia.row[2].z += m * r2;
    }
    return inertia;
  }
  /// Its inverse. Places are stored in single precision: below 1e-5 of their distance from the origin there is no
  /// shape, as in a body of one grain, only rounding, which must not be taken for an inertia.
  Matrix inverseOf(const Matrix& restInertia) const {
    double farthest2 = 0;
    for (size_t k = m_first; k < m_last; ++k) farthest2 = std::max(farthest2, dot(restPlace(k), restPlace(k)));
    return pseudoInverse(restInertia, 1e-10 * m_scale * m_scale * m_mass * farthest2);
  }
  Matrix restInverseInertia() const { return inverseOf(restInertia()); }
  /// A matrix of the undeformed frame times a vector of the world's, at an orientation: I w or I^-1 L.
  static Vector turned(const Matrix& rest, Quaternion rotation, Vector vector) {
    const Matrix r = matrixOf(rotation);
    return r * (rest * transposedTimes(r, vector));
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

  const api::ParticleView& m_p;
  const api::GroupBatch& m_batch;
  size_t m_group, m_first, m_last;
  double m_mass = 0, m_scale = 1;
  Vector m_restCentre, m_centre;
  Quaternion m_rotation;
  Matrix m_scaledRotation;
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
