// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "bondmodel.h"
#include "core/base/parallel.h"
#include "core/solver/solver.h"
#include "enthalpymodel.h"

#include <QtGlobal>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

/// Small scenes and plugins for the tests of the solver.
namespace mechanics {

inline ps::Material water(double densitySolid = 917, double densityLiquid = 998) {
  ps::Material m{"water", "Water", {}, {}};
  m.properties = {{"density_solid", densitySolid}, {"density_liquid", densityLiquid},
                  {"heat_capacity_solid", 2100.0}, {"heat_capacity_liquid", 4186.0},
                  {"heat_capacity_gas", 2010.0},   {"conductivity_solid", 2.22},
                  {"conductivity_liquid", 0.598},  {"conductivity_gas", 0.0248},
                  {"melting_temperature", 273.15}, {"boiling_temperature", 373.124},
                  {"latent_heat_fusion", 333.6e3}, {"latent_heat_vaporization", 2256.5e3},
                  {"youngs_modulus", 9e9},         {"viscosity", 1e-3}};
  return m;
}

/// A tray: floor and four walls around a square of `width`.
inline std::vector<ps::Wall> tray(double width) {
  std::vector<ps::Wall> walls(5);
  const ps::api::Double3 normals[] = {{0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}};
  for (size_t k = 0; k < 5; ++k) {
    walls[k].normal = normals[k];
    walls[k].offset = k == 0 ? 0 : -width / 2;
  }
  return walls;
}

/// nx x ny x nz particles whose lowest layer rests on height `bottom`, around the y axis.
inline std::vector<ps::api::Double3> lattice(int nx, int ny, int nz, double spacing, double bottom) {
  std::vector<ps::api::Double3> points;
  for (int y = 0; y < ny; ++y) {
    for (int z = 0; z < nz; ++z) {
      for (int x = 0; x < nx; ++x) {
        points.push_back(
            {(x + 0.5 - nx / 2.0) * spacing, bottom + (y + 0.5) * spacing, (z + 0.5 - nz / 2.0) * spacing});
      }
    }
  }
  return points;
}

inline ps::Spawn ice(std::vector<ps::api::Double3> points, uint32_t set, double temperature = 263.15) {
  ps::Spawn spawn;
  spawn.position = std::move(points);
  spawn.phase = ps::api::Phase::Solid;
  spawn.temperature = temperature;
  spawn.constraintSets = {set};
  return spawn;
}

inline ps::Spawn liquid(std::vector<ps::api::Double3> points, double temperature = 293.15) {
  ps::Spawn spawn;
  spawn.position = std::move(points);
  spawn.phase = ps::api::Phase::Liquid;
  spawn.temperature = temperature;
  return spawn;
}

inline ps::Spawn fixedPoints(std::vector<ps::api::Double3> points) {
  ps::Spawn spawn = liquid(std::move(points), 263.15);
  spawn.phase = ps::api::Phase::Solid;
  spawn.fixed = true;
  return spawn;
}

inline std::vector<double> bondParameters() {
  std::vector<double> values;
  const ps::constraint::BondModel bonds;
  for (size_t i = 0; i < bonds.parameters().count; ++i) values.push_back(bonds.parameters()[i].defaultValue);
  return values;
}

struct Motion {
  double rms = 0, fastest = 0, top = -1e30, bottom = 1e30;  ///< m/s, m
};

inline Motion motionOf(const ps::Solver& solver, uint32_t body) {
  Motion result;
  const ps::ParticleStore& p = solver.particles();
  size_t count = 0;
  for (size_t i = 0; i < p.size(); ++i) {
    if (p.body()[i] != body || p.motion()[i] == ps::api::Motion::Static) continue;
    const ps::api::Float4 v = p.velocity()[i];
    const double v2 = double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z;
    result.rms += v2;
    result.fastest = std::max(result.fastest, std::sqrt(v2));
    result.top = std::max(result.top, double{p.position()[i].y});
    result.bottom = std::min(result.bottom, double{p.position()[i].y});
    ++count;
  }
  result.rms = std::sqrt(result.rms / static_cast<double>(std::max<size_t>(1, count)));
  return result;
}

inline ps::SolverSettings settingsOf(double spacing) {
  ps::SolverSettings settings;
  settings.spacing = spacing;
  return settings;
}

inline void prepare(ps::Solver& solver, const ps::SolverSettings& settings, const ps::Material& material = water()) {
  solver.setSettings(settings);
  solver.setMaterials({ps::BakedMaterial(material, 101325)});
  ps::Bounds bounds;
  bounds.minimum = {-3, -3, -3};
  bounds.maximum = {3, 3, 3};
  solver.setBounds(bounds);
}

/// Runs `frames`; false when a flag was raised.
inline bool run(ps::Solver& solver, int frames) {
  for (int f = 0; f < frames; ++f) {
    const ps::StepReport report = solver.step();
    if (report.flags == 0) continue;
    qWarning("frame %d: flags %u: %s", f, report.flags, report.message.c_str());
    return false;
  }
  return true;
}

/// What the test plugins share.
template <class Form>
class TestConstraint : public ps::api::Described<Form> {
 public:
  TestConstraint() : ps::api::Described<Form>({"test", "", {}}) {}
};

/// Adds and removes constraints every frame and counts batches in which a particle appears twice.
class ColourWatch final : public TestConstraint<ps::api::StructuralPlugin> {
 public:
  mutable std::atomic<int> clashes{0}, wrongIds{0}, seen{0};
  bool traits(ps::api::StructuralTraits* out) const noexcept override {
    static constexpr ps::api::FieldDeclaration kValues[] = {{"sum_of_ids", "", "", ps::api::FieldType::Float32}};
    return ps::api::fill(out, {.arity = 3, .values = ps::api::listOf(kValues)});
  }
  void build(const ps::api::ConstraintContext&, const ps::api::ParticleView& p, const ps::api::NeighbourView& lists,
             ps::api::Span<const uint32_t> members, ps::api::ConstraintSink& sink) const override {
    for (const uint32_t i : members) addAround(p, lists, i, sink);
  }
  void project(const ps::api::ConstraintContext&, const ps::api::MovableParticles& particles,
               const ps::api::ConstraintBatch& b) const override {
    const ps::api::ParticleView& p = particles;
    std::vector<uint8_t> used(p.count, 0);
    for (size_t k = 0; k < b.count; ++k) {
      float sum = 0;
      for (size_t a = 0; a < 3; ++a) {
        const uint32_t i = b.particles[3 * k + a];
        if (used[i]++ != 0) ++clashes;
        sum += static_cast<float>(p.id[i]);
      }
      if (sum != b.values[0][k]) ++wrongIds;
    }
    seen += static_cast<int>(b.count);
  }
  void topology(const ps::api::ConstraintContext&, const ps::api::ParticleView& p, const ps::api::NeighbourView& lists,
                const ps::api::ConstraintBatch& all, ps::api::ConstraintSink& sink) const override {
    for (size_t k = 0; k < all.count; k += 7) sink.remove(k);
    for (uint32_t i = 0; i < p.count; i += 5) addAround(p, lists, i, sink);
  }

 private:
  static void addAround(const ps::api::ParticleView& p, const ps::api::NeighbourView& lists, uint32_t i,
                        ps::api::ConstraintSink& sink) {
    for (uint32_t q = lists.begin[i]; q + 1 < lists.last[i] && q < lists.begin[i] + 6; q += 2) {
      const uint32_t three[3] = {i, lists.index[q], lists.index[q + 1]};
      const float sum = static_cast<float>(p.id[three[0]] + p.id[three[1]] + p.id[three[2]]);
      sink.add(three, &sum);
      sink.add(three, &sum);  // a duplicate, to be ignored
    }
  }
};

/// Neighbour form: every particle drifts by 1 mm per iteration along x.
class Drift final : public TestConstraint<ps::api::NeighbourPlugin> {
 public:
  bool traits(ps::api::NeighbourTraits* out) const noexcept override { return ps::api::fill(out, {}); }
  void gather(const ps::api::ConstraintContext&, const ps::api::ParticleView&, const ps::api::NeighbourView&,
              ps::api::Span<const uint32_t> members, ps::api::Float4* correction) const override {
    for (size_t k = 0; k < members.size; ++k) correction[k] = {0.001f, 0, 0, 0};
  }
};

}  // namespace mechanics
