// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "clothmodel.h"
#include "clustermodel.h"
#include "rigidscene.h"
#include "ropemodel.h"

/// Cloth, ropes and soft blocks, and what to measure on them.
namespace soft {

using namespace mechanics;
using namespace rigid;

/// Dry matter that never melts, of a density and a Young's modulus.
inline ps::Material matter(double density, double modulus = 1e5) {
  ps::Material m = water(density, density);
  m.properties["melting_temperature"] = 2000.0;
  m.properties["youngs_modulus"] = modulus;
  return m;
}

/// A plugin's defaults, with some changed.
inline std::vector<double> parametersOf(const ps::api::ConstraintPlugin& plugin,
                                        const std::vector<std::pair<size_t, double>>& changes = {}) {
  std::vector<double> values;
  const ps::api::ParameterList list = plugin.parameters();
  for (size_t k = 0; k < list.count; ++k) values.push_back(list[k].defaultValue);
  for (const auto& [index, value] : changes) values.at(index) = value;
  return values;
}

/// nx x ny x nz points from a corner.
inline std::vector<ps::api::Double3> grid(int nx, int ny, int nz, double spacing, ps::api::Double3 corner) {
  std::vector<ps::api::Double3> points;
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        points.push_back({corner.x + x * spacing, corner.y + y * spacing, corner.z + z * spacing});
      }
    }
  }
  return points;
}

inline ps::Spawn solid(std::vector<ps::api::Double3> points, uint32_t set, uint32_t body = 0) {
  ps::Spawn spawn = ice(std::move(points), set, 293.15);
  spawn.body = body;
  return spawn;
}

/// Holds particles where they are.
template <class Chosen>
void pin(ps::Solver& solver, Chosen&& chosen) {
  ps::ParticleStore& p = solver.particles();
  for (size_t i = 0; i < p.size(); ++i) {
    if (!chosen(vectorOf(p.position()[i]))) continue;
    p.motion()[i] = ps::api::Motion::Static;
    p.velocity()[i] = {0, 0, 0, 0};
  }
}

/// Smallest distance between solid or static particles of two bodies, in m.
inline double gap(const ps::Solver& solver, uint32_t a, uint32_t b) {
  const ps::ParticleStore& p = solver.particles();
  double least = 1e30;
  for (size_t i = 0; i < p.size(); ++i) {
    for (size_t j = 0; p.body()[i] == a && j < p.size(); ++j) {
      if (p.body()[j] == b) least = std::min(least, (vectorOf(p.position()[i]) - vectorOf(p.position()[j])).norm());
    }
  }
  return least;
}

inline double lowest(const ps::Solver& solver, uint32_t body = 0) {
  const ps::ParticleStore& p = solver.particles();
  double y = 1e30;
  for (size_t i = 0; i < p.size(); ++i) {
    if (p.body()[i] == body) y = std::min(y, double{p.position()[i].y});
  }
  return y;
}

}  // namespace soft
