// SPDX-License-Identifier: Apache-2.0
#include "core/solver/fluid/gasforces.h"

#include "core/base/parallel.h"
#include "core/math/thesis.h"
#include "core/solver/fluid/gaslaws.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace ps {
namespace {

constexpr double kMolarMassUnknown = 0.0289647;  ///< kg/mol, of matter that does not say: that of air
constexpr double kDragCoefficient = 0.5;         ///< of a sphere at the Reynolds numbers of puffs of steam

}  // namespace

void GasForces::configure(const SolverSettings& solver, const ThermalSettings& thermal,
                          std::span<const BakedMaterial> materials) {
  m_solver = solver;
  m_thermal = thermal;
  m_materials = materials;
  m_molarMass.clear();
  for (const BakedMaterial& material : materials) {
    const double molarMass = material.scalar(propertyIndex("molar_mass"));
    m_molarMass.push_back(molarMass > 0 ? molarMass : kMolarMassUnknown);
  }
}

double GasForces::vapourDensity(uint32_t material, double temperature) const {
  return idealGasDensity(m_thermal.ambientPressure, m_molarMass[material], temperature);
}

double GasForces::airDensity() const { return ps::airDensity(m_thermal.ambientPressure, m_thermal.ambientTemperature); }

float GasForces::filled(const ParticleStore& store, const api::NeighbourView& lists, size_t i, bool withLiquid) const {
  const Kernel kernel(m_solver.kernel, m_solver.spacing * m_solver.supportRatio);
  const api::Float4 xi = store.position()[i];
  double around = 0;
  for (uint32_t k = lists.begin[i]; k < lists.last[i]; ++k) {
    const uint32_t j = lists.index[k];
    if (withLiquid && store.motion()[j] != api::Motion::Liquid) continue;
    const api::Float4 d = store.separation(i, j);
    const double dx = d.x, dy = d.y, dz = d.z;
    around += double{store.position()[j].w} * kernel.value(std::sqrt(dx * dx + dy * dy + dz * dz));
  }
  const double own = double{xi.w} * kernel.value(0);
  return static_cast<float>(std::min(1.0, around / std::max(0.2, 1 - own)));
}

void GasForces::measure(const ParticleStore& store, const Neighbours& neighbours) {
  m_filled.resize(store.size());
  const api::NeighbourView lists = neighbours.view();
  const auto body = [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      const bool vapour = store.gasFraction()[i] > 0;
      m_filled[i] = vapour || m_solver.airDrag > 0 ? filled(store, lists, i, vapour) : 0.0f;
    }
  };
  forChunks(store.size(), grain::kParticles, body);
}

GasForces::Pull GasForces::pullOf(const ParticleStore& store, size_t i) const {
  const double f = store.gasFraction()[i];
  // Particles born since the last measurement count as being in the open.
  const double open = 1 - (i < m_filled.size() ? double{m_filled[i]} : 0);
  if (f > 0) {
    const double ratio = airDensity() / vapourDensity(store.material()[i], store.temperature()[i]);
    const double lift = 1 - open + open * parcelLift(ratio, m_solver.addedMass);
    const double drag = m_solver.gasDrag > 0 ? f * open * dragRate(ratio, kDragCoefficient, m_solver.gasDrag) : 0;
    return {(1 - f) - f * lift, drag};
  }
  const double volume = store.position()[i].w, diameter = std::cbrt(6 * volume / std::numbers::pi);
  const double ratio = airDensity() * volume / double{store.mass()[i]};
  return {1 - open * ratio, open * dragRate(ratio, m_solver.airDrag, diameter)};
}

void GasForces::apply(ParticleStore& store, size_t first, size_t last, double dt) const {
  const api::Double3 g = m_solver.gravity, u = m_solver.wind;
  const double strength = std::sqrt(g.x * g.x + g.y * g.y + g.z * g.z);
  const bool thesis = m_solver.gasModel == GasModel::Thesis, inAir = m_solver.airDrag > 0;
  for (size_t i = first; i < last; ++i) {
    api::Float4& v = store.velocity()[i];
    if (!(v.w > 0)) continue;
    Pull pull{1, 0};
    if (thesis && store.gasFraction()[i] > 0) {
      if (strength > 0) pull.weight = -thesisGravity(store.gasFraction()[i]) / strength;
    } else if (inAir || store.gasFraction()[i] > 0) {
      pull = pullOf(store, i);
    }
    const double x = double{v.x} - u.x, y = double{v.y} - u.y, z = double{v.z} - u.z;
    const double slow = pull.drag > 0 ? 1 / (1 + pull.drag * std::sqrt(x * x + y * y + z * z) * dt) : 1;
    v.x = static_cast<float>(u.x + (x + dt * pull.weight * g.x) * slow);
    v.y = static_cast<float>(u.y + (y + dt * pull.weight * g.y) * slow);
    v.z = static_cast<float>(u.z + (z + dt * pull.weight * g.z) * slow);
  }
}

}  // namespace ps
