// SPDX-License-Identifier: Apache-2.0
// Pairwise exponential heat exchange, for frames that would need more explicit substeps than HeatStage affords. Every
// pair relaxes exactly as two bodies in contact would, E = C (1 - exp(-G dt/C)) (T_j - T_i) with 1/C = 1/C_i + 1/C_j,
// in list order with half the step and then backwards with the other half. E never exceeds what brings the two to one
// temperature, so any step is stable, and what one gains the other loses, so that energy is kept. The price is
// accuracy: about 0.5 % of the melted mass at 20 times the Gershgorin limit. Order matters, so this runs on one thread.
#include "core/base/callee.h"
#include "core/base/parallel.h"
#include "core/solver/heat/heat.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace ps {
namespace {

/// 1 - exp(-x) for x >= 0 from basic operations alone, to 1e-12: the C library's exp may differ between machines.
double decay(double x) {
  if (!(x < 40)) return 1;
  int doublings = 0;
  for (; x > 0.125; x *= 0.5) ++doublings;
  const double y = -x;
  double e = y * (1 + y / 2 * (1 + y / 3 * (1 + y / 4 * (1 + y / 5 * (1 + y / 6 * (1 + y / 7 * (1 + y / 8)))))));
  for (; doublings > 0; --doublings) e = e * (e + 2);  // expm1(2y) = expm1(y) (expm1(y) + 2)
  return -e;
}

/// Latent heat in J/kg of melting at the scene's pressure.
double meltingHeatOf(const api::Caloric& c) {
  return std::max(
      0.0, c.latentHeatFusion + (c.heatCapacityLiquid - c.heatCapacitySolid) * (c.meltingPoint - c.meltingPoint0));
}

}  // namespace

double HeatStage::latentHeat(const ParticleStore& store, size_t i) const {
  if (!works()) return 0;
  const api::Caloric& c = m_materials[store.material()[i]].caloric();
  const double melted = c.melts && !c.sublimes ? 1 - double{store.solidFraction()[i]} : 0;
  return double{store.mass()[i]} * melted * meltingHeatOf(c) + double{store.gasFraction()[i]} * latentContent(store, i);
}

HeatBody HeatStage::heatBody(const ParticleStore& store, size_t i) const {
  const api::Caloric& c = m_materials[store.material()[i]].caloric();
  const double mass = store.mass()[i], t = store.temperature()[i];
  const double s = store.solidFraction()[i], l = store.liquidFraction()[i], g = store.gasFraction()[i];
  double capacity = s * c.heatCapacitySolid + l * c.heatCapacityLiquid + g * c.heatCapacityGas;
  HeatBody body;
  body.temperature = t;
  if (isHeld(store, i)) return body;  // of endless capacity
  if (c.melts && !c.sublimes && c.liquidus > c.solidus) {
    if (s > 0 && l > 0) capacity += meltingHeatOf(c) / (c.liquidus - c.solidus);
  } else if (c.melts && !c.sublimes && t == c.meltingPoint) {
    body.latentUp = s * mass * meltingHeatOf(c);
    body.latentDown = l * mass * meltingHeatOf(c);
  }
  if (t == c.boilingPoint) {
    body.latentUp += (1 - g) * latentContent(store, i);
    body.latentDown += g * latentContent(store, i);
  }
  body.inverseCapacity = mass > 0 && capacity > 0 ? 1 / (mass * capacity) : 0;
  return body;
}

/// Partner k of particle i, once per pair: the one with the lower index asks.
void HeatStage::relaxPair(size_t i, uint32_t k, bool sameMaterial, double time) {
  const uint32_t j = m_pairs.partner[k];
  if (j < i) return;
  double conductance = double{m_pairs.conductance[k]};
  if (sameMaterial) {  // Kirchhoff: the mean conductivity between the two temperatures of the snapshot
    const double gap = m_now.temperature[j] - m_now.temperature[i];
    conductance *= std::abs(gap) > 1e-9 ? (m_now.potential[j] - m_now.potential[i]) / gap
                                        : 0.5 * (double{m_pairs.conductivity[i]} + double{m_pairs.conductivity[j]});
  }
  relaxBodies(i, j, conductance, time);
}

void HeatStage::relaxBodies(size_t i, size_t j, double conductance, double time) {
  HeatBody &a = m_bodies[i], &b = m_bodies[j];
  const double difference = b.temperature - a.temperature;
  if (difference == 0) return;
  const double inverse = a.inverseAgainst(difference) + b.inverseAgainst(-difference);
  if (!(inverse > 0)) return;
  const double joules = decay(conductance * time * inverse) / inverse * difference;
  a.addHeat(joules);
  b.addHeat(-joules);
  m_joules[i] += joules;
  m_joules[j] -= joules;
}

/// Against something of `inverseCapacity`, in K/J, 0 where it keeps its temperature; returns the joules.
double HeatStage::relaxToward(size_t i, double conductance, double target, double inverseCapacity, double time) {
  HeatBody& body = m_bodies[i];
  const double difference = target - body.temperature;
  if (difference == 0 || !(conductance > 0)) return 0;
  const double inverse = body.inverseAgainst(difference) + inverseCapacity;
  if (!(inverse > 0)) return 0;
  const double joules = decay(conductance * time * inverse) / inverse * difference;
  body.addHeat(joules);
  m_joules[i] += joules;
  return joules;
}

void HeatStage::relaxSurroundings(const ParticleStore& store, size_t i, double time) {
  const double lump = m_settings.airHeatCapacity > 0 ? 1 / m_settings.airHeatCapacity : 0;
  m_surroundings.forEach(store, i, m_now, [&](HeatSurroundings::Kind kind, double conductance, double target) {
    const bool air = kind == HeatSurroundings::Kind::Air;
    const double joules = relaxToward(i, conductance, target, air ? lump : 0, time);
    book(m_partials[0], kind, joules);
    if (air) takeFromAir(joules);
  });
}

void HeatStage::relaxSights(size_t i, double time) {
  m_surroundings.forEachInSight(i, m_now, [&](uint32_t j, double conductance) {
    if (j > i) relaxBodies(i, j, conductance, time);
  });
}

void HeatStage::sweep(ParticleStore& store, const api::ParticleView& view, double step, bool firstStep) {
  const size_t n = store.size();
  const double half = 0.5 * step;
  m_bodies.resize(n);
  for (size_t i = 0; i < n; ++i) m_bodies[i] = heatBody(store, i);
  std::fill(m_joules.begin(), m_joules.begin() + static_cast<std::ptrdiff_t>(n), 0.0);
  for (size_t i = 0; i < n; ++i) {
    relaxSurroundings(store, i, half);
    for (uint32_t k = m_pairs.begin[i]; k < m_pairs.same[i]; ++k) relaxPair(i, k, true, half);
    for (uint32_t k = m_pairs.other[i]; k < m_pairs.end[i]; ++k) relaxPair(i, k, false, half);
    relaxSights(i, half);
  }
  for (size_t i = n; i-- > 0;) {
    relaxSights(i, half);
    for (uint32_t k = m_pairs.end[i]; k-- > m_pairs.other[i];) relaxPair(i, k, false, half);
    for (uint32_t k = m_pairs.same[i]; k-- > m_pairs.begin[i];) relaxPair(i, k, true, half);
    relaxSurroundings(store, i, half);
  }
  const api::ThermalContext where = context();
  const auto apply = [&](size_t first, size_t last) {
    addFrameHeat(store, step, firstStep, first, last, m_partials[first / grain::kNeighbours]);
    const CalleeScope callee(m_modelName.c_str());
    m_model->addHeat(where, view, first, last, m_joules.data(), step);
    deriveRange(store, first, last);
    snapshotRange(store, m_now, first, last);
  };
  forChunks(n, grain::kNeighbours, apply);
}

}  // namespace ps
