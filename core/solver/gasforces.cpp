// SPDX-License-Identifier: Apache-2.0
#include "core/solver/gasforces.h"

#include "core/base/parallel.h"
#include "core/math/thesis.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace ps {
namespace {

constexpr size_t kGrain = 512;
constexpr double kGasConstant = 8.314462618;  ///< J/(mol K)
constexpr double kMolarMassAir = 0.0289647;   ///< kg/mol
constexpr double kDragCoefficient = 0.5;      ///< of a sphere at the Reynolds numbers of puffs of steam
constexpr double kColdest = 20;               ///< K, below which the ideal gas law is not asked

}  // namespace

void GasForces::configure(const SolverSettings& solver, const ThermalSettings& thermal,
                          std::span<const BakedMaterial> materials) {
  m_solver = solver;
  m_thermal = thermal;
  m_materials = materials;
  m_molarMass.clear();
  for (const BakedMaterial& material : materials) {
    const double molarMass = material.scalar(propertyIndex("molar_mass"));
    m_molarMass.push_back(molarMass > 0 ? molarMass : kMolarMassAir);
  }
}

double GasForces::vapourDensity(uint32_t material, double temperature) const {
  return m_thermal.ambientPressure * m_molarMass[material] / (kGasConstant * std::max(temperature, kColdest));
}

double GasForces::airDensity() const {
  return m_thermal.ambientPressure * kMolarMassAir / (kGasConstant * std::max(m_thermal.ambientTemperature, kColdest));
}

float GasForces::immersionOf(const ParticleStore& store, const api::NeighbourView& lists, size_t i) const {
  const Kernel kernel(m_solver.kernel, m_solver.spacing * m_solver.supportRatio);
  const api::Float4 xi = store.position()[i];
  double around = 0;
  for (uint32_t k = lists.begin[i]; k < lists.last[i]; ++k) {
    const uint32_t j = lists.index[k];
    if (store.motion()[j] != api::Motion::Liquid) continue;
    const api::Float4 xj = store.position()[j];
    const double dx = double{xi.x} - double{xj.x}, dy = double{xi.y} - double{xj.y}, dz = double{xi.z} - double{xj.z};
    around += double{xj.w} * kernel.value(std::sqrt(dx * dx + dy * dy + dz * dz));
  }
  const double own = double{xi.w} * kernel.value(0);
  return static_cast<float>(std::min(1.0, around / std::max(0.2, 1 - own)));
}

/// 0 in the open, 1 inside of matter.
float GasForces::coverOf(const ParticleStore& store, const api::NeighbourView& lists, size_t i) const {
  const Kernel kernel(m_solver.kernel, m_solver.spacing * m_solver.supportRatio);
  const api::Float4 xi = store.position()[i];
  double around = 0;
  for (uint32_t k = lists.begin[i]; k < lists.last[i]; ++k) {
    const api::Float4 xj = store.position()[lists.index[k]];
    const double dx = double{xi.x} - double{xj.x}, dy = double{xi.y} - double{xj.y}, dz = double{xi.z} - double{xj.z};
    around += double{xj.w} * kernel.value(std::sqrt(dx * dx + dy * dy + dz * dz));
  }
  return static_cast<float>(std::min(1.0, around / std::max(0.2, 1 - double{xi.w} * kernel.value(0))));
}

/// Drag 1/2 rho C_d A v^2 on a sphere of the particle's volume, by a step that cannot turn the velocity round; lift by
/// the weight of the air in its place.
GasForces::AirEffect GasForces::airOn(const ParticleStore& store, size_t i, double dt) const {
  const api::Float4 v = store.velocity()[i];
  const double volume = store.position()[i].w, open = 1 - (i < m_cover.size() ? m_cover[i] : 0.0f);
  const double radius = std::cbrt(0.75 * volume / std::numbers::pi), area = std::numbers::pi * radius * radius;
  const double air = airDensity(), perMass = double{v.w};
  const double speed = std::sqrt(double{v.x} * double{v.x} + double{v.y} * double{v.y} + double{v.z} * double{v.z});
  return {1 - open * air * volume * perMass,
          1 / (1 + open * 0.5 * air * m_solver.airDrag * area * perMass * speed * dt)};
}

void GasForces::measure(const ParticleStore& store, const Neighbours& neighbours) {
  m_immersion.resize(store.size());
  if (m_solver.airDrag > 0) m_cover.resize(store.size());
  const api::NeighbourView lists = neighbours.view();
  const auto body = [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      m_immersion[i] = store.gasFraction()[i] > 0 ? immersionOf(store, lists, i) : 0.0f;
      if (m_solver.airDrag > 0) m_cover[i] = coverOf(store, lists, i);
    }
  };
  parallelFor(store.size(), kGrain, std::cref(body));
}

void GasForces::apply(ParticleStore& store, size_t first, size_t last, double dt) const {
  const api::Double3 g = m_solver.gravity;
  const double air = airDensity();
  for (size_t i = first; i < last; ++i) {
    api::Float4& v = store.velocity()[i];
    if (!(v.w > 0)) continue;
    const double f = store.gasFraction()[i];
    double weight = 1, slow = 1;  // share of gravity that acts; factor of drag
    if (!(f > 0) && m_solver.airDrag > 0) {
      const AirEffect effect = airOn(store, i, dt);
      weight = effect.weight;
      slow = effect.slow;
    }
    if (f > 0 && m_solver.gasModel == GasModel::Thesis) {
      const double strength = std::sqrt(g.x * g.x + g.y * g.y + g.z * g.z);
      if (strength > 0) weight = -thesisGravity(f) / strength;
    } else if (f > 0) {
      // Particles born since the last measurement count as being in the open.
      const double phi = i < m_immersion.size() ? m_immersion[i] : 0;
      const double ratio = air / vapourDensity(store.material()[i], store.temperature()[i]);
      const double lift = phi + (1 - phi) * (ratio - 1) / (1 + m_solver.addedMass * ratio);
      weight = (1 - f) - f * lift;
      const double k = 0.75 * kDragCoefficient * ratio / m_solver.gasDrag;
      const double speed = std::sqrt(double{v.x} * double{v.x} + double{v.y} * double{v.y} + double{v.z} * double{v.z});
      if (m_solver.gasDrag > 0) slow = 1 / (1 + f * (1 - phi) * k * speed * dt);
    }
    v.x = static_cast<float>((double{v.x} + dt * weight * g.x) * slow);
    v.y = static_cast<float>((double{v.y} + dt * weight * g.y) * slow);
    v.z = static_cast<float>((double{v.z} + dt * weight * g.z) * slow);
  }
}

}  // namespace ps
