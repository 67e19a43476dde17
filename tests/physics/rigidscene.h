// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "mechanicsscene.h"
#include "rigidmodel.h"

/// Rigid bodies and what to measure on them.
namespace rigid {

struct Vec {
  double x = 0, y = 0, z = 0;
};
inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(double s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double length(Vec a) { return std::sqrt(dot(a, a)); }
inline Vec vecOf(const ps::api::Float4& v) { return {v.x, v.y, v.z}; }

/// Sums over the particles of one body, or of all for kAll.
inline constexpr uint32_t kAll = ~0u;
struct Sums {
  double mass = 0, energy = 0;    ///< kg, J
  Vec centre, momentum, angular;  ///< m, kg m/s, kg m2/s about the centre
  size_t count = 0;
  double inertia[3][3] = {};  ///< kg m2
};

template <class Chosen>
Sums sumsOver(const ps::Solver& solver, Chosen&& chosen) {
  const ps::ParticleStore& p = solver.particles();
  Sums s;
  for (size_t i = 0; i < p.size(); ++i) {
    if (!chosen(i)) continue;
    const double m = p.mass()[i];
    s.mass += m;
    s.centre = s.centre + m * vecOf(p.position()[i]);
    s.momentum = s.momentum + m * vecOf(p.velocity()[i]);
    s.energy += 0.5 * m * dot(vecOf(p.velocity()[i]), vecOf(p.velocity()[i]));
    ++s.count;
  }
  s.centre = (1 / s.mass) * s.centre;
  for (size_t i = 0; i < p.size(); ++i) {
    if (!chosen(i)) continue;
    const double m = p.mass()[i];
    const Vec r = vecOf(p.position()[i]) - s.centre;
    s.angular = s.angular + m * cross(r, vecOf(p.velocity()[i]));
    const double c[3] = {r.x, r.y, r.z};
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) s.inertia[a][b] += m * ((a == b ? dot(r, r) : 0) - c[a] * c[b]);
    }
  }
  return s;
}
inline Sums sumsOf(const ps::Solver& solver, uint32_t body = kAll) {
  return sumsOver(solver, [&](size_t i) { return body == kAll || solver.particles().body()[i] == body; });
}

/// Velocities of a rigid motion about the centre of the points.
inline std::vector<ps::api::Double3> turning(const std::vector<ps::api::Double3>& points, Vec velocity, Vec spin) {
  Vec centre;
  for (const auto& p : points) centre = centre + (1.0 / static_cast<double>(points.size())) * Vec{p.x, p.y, p.z};
  std::vector<ps::api::Double3> result;
  for (const auto& p : points) {
    const Vec v = velocity + cross(spin, Vec{p.x, p.y, p.z} - centre);
    result.push_back({v.x, v.y, v.z});
  }
  return result;
}

/// Largest change of a distance to the first particle of the body since `before` was taken, in m.
inline std::vector<double> distances(const ps::Solver& solver, uint32_t body) {
  const ps::ParticleStore& p = solver.particles();
  std::vector<std::pair<uint32_t, Vec>> members;
  for (size_t i = 0; i < p.size(); ++i) {
    if (p.body()[i] == body) members.push_back({p.id()[i], vecOf(p.position()[i])});
  }
  std::sort(members.begin(), members.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<double> result;
  result.reserve(members.size());
  for (const auto& m : members) result.push_back(length(m.second - members[0].second));
  return result;
}
inline double greatestChange(const std::vector<double>& before, const std::vector<double>& now) {
  double most = before.size() == now.size() ? 0 : 1e30;
  for (size_t k = 0; most < 1e30 && k < now.size(); ++k) most = std::max(most, std::abs(now[k] - before[k]));
  return most;
}

inline std::vector<double> rigidParameters() { return {4}; }

}  // namespace rigid
