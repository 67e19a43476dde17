// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "mechanicsscene.h"
#include "rigidmodel.h"

#include "core/math/vector.h"

#include <Eigen/Geometry>

/// Rigid bodies and what to measure on them.
namespace rigid {

using ps::Vector3;
using ps::vectorOf;

/// Sums over the particles of one body, or of all for kAll.
inline constexpr uint32_t kAll = ~0u;
struct Sums {
  double mass = 0, energy = 0;        ///< kg, J
  Vector3 centre, momentum, angular;  ///< m, kg m/s, kg m2/s about the centre
  size_t count = 0;
  ps::Matrix3 inertia;  ///< kg m2
};

template <class Chosen>
Sums sumsOver(const ps::Solver& solver, Chosen&& chosen) {
  const ps::ParticleStore& p = solver.particles();
  Sums s;
  for (size_t i = 0; i < p.size(); ++i) {
    if (!chosen(i)) continue;
    const double m = p.mass()[i];
    s.mass += m;
    s.centre += m * vectorOf(p.position()[i]);
    s.momentum += m * vectorOf(p.velocity()[i]);
    s.energy += 0.5 * m * vectorOf(p.velocity()[i]).squaredNorm();
    ++s.count;
  }
  s.centre /= s.mass;
  for (size_t i = 0; i < p.size(); ++i) {
    if (!chosen(i)) continue;
    const double m = p.mass()[i];
    const Vector3 r = vectorOf(p.position()[i]) - s.centre;
    s.angular += m * r.cross(vectorOf(p.velocity()[i]));
    s.inertia += m * (r.squaredNorm() * ps::Matrix3::Identity() - r * r.transpose());
  }
  return s;
}
inline Sums sumsOf(const ps::Solver& solver, uint32_t body = kAll) {
  return sumsOver(solver, [&](size_t i) { return body == kAll || solver.particles().body()[i] == body; });
}

/// Velocities of a rigid motion about the centre of the points.
inline std::vector<ps::api::Double3> turning(const std::vector<ps::api::Double3>& points, const Vector3& velocity,
                                             const Vector3& spin) {
  Vector3 centre;
  for (const auto& p : points) centre += vectorOf(p) / static_cast<double>(points.size());
  std::vector<ps::api::Double3> result;
  for (const auto& p : points) {
    const Vector3 arm = vectorOf(p) - centre;
    result.push_back(ps::double3Of(velocity + spin.cross(arm)));
  }
  return result;
}

/// Largest change of a distance to the first particle of the body since `before` was taken, in m.
inline std::vector<double> distances(const ps::Solver& solver, uint32_t body) {
  const ps::ParticleStore& p = solver.particles();
  std::vector<std::pair<uint32_t, Vector3>> members;
  for (size_t i = 0; i < p.size(); ++i) {
    if (p.body()[i] == body) members.push_back({p.id()[i], vectorOf(p.position()[i])});
  }
  std::sort(members.begin(), members.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<double> result;
  result.reserve(members.size());
  for (const auto& m : members) result.push_back((m.second - members[0].second).norm());
  return result;
}
inline double greatestChange(const std::vector<double>& before, const std::vector<double>& now) {
  double most = before.size() == now.size() ? 0 : 1e30;
  for (size_t k = 0; most < 1e30 && k < now.size(); ++k) most = std::max(most, std::abs(now[k] - before[k]));
  return most;
}

inline std::vector<double> rigidParameters() { return {4}; }

}  // namespace rigid
