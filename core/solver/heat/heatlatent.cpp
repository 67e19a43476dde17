// SPDX-License-Identifier: Apache-2.0
// The parts of HeatStage that concern vapour: film condensation on cold walls and nucleation, once a frame.
#include "core/base/parallel.h"
#include "core/solver/heat/heat.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace ps {
namespace {

/// Largest share of a particle's remaining vapour that a film takes in one frame.
constexpr double kFilmShare = 0.3;
/// Reach of a condensing surface in spacings.
constexpr double kFilmReach = 1.2;

/// J/kg between liquid (or solid, where it sublimes) and vapour at the boiling point of the scene's pressure.
double latentHeatOf(const api::Caloric& c) {
  const double fromLiquid =
      c.latentHeatVaporization - (c.heatCapacityLiquid - c.heatCapacityGas) * (c.boilingPoint - c.boilingPoint0);
  if (!c.sublimes) return std::max(0.0, fromLiquid);
  const double liquidAboveSolid =
      c.latentHeatFusion + (c.heatCapacityLiquid - c.heatCapacitySolid) * (c.meltingPoint - c.meltingPoint0);
  return std::max(0.0, fromLiquid + liquidAboveSolid);
}

}  // namespace

bool HeatStage::boils(const ParticleStore& store, size_t i) const {
  return store.gasFraction()[i] > 0 && store.gasFraction()[i] < 1;
}

double HeatStage::latentContent(const ParticleStore& store, size_t i) const {
  return double{store.mass()[i]} * latentHeatOf(m_materials[store.material()[i]].caloric());
}

void HeatStage::collectFrameHeat(ParticleStore& store, const api::ParticleView& view, double frame) {
  const size_t n = store.size();
  std::fill(m_watts.begin(), m_watts.begin() + static_cast<std::ptrdiff_t>(n), 0.0);
  std::fill(m_frameJoules.begin(), m_frameJoules.begin() + static_cast<std::ptrdiff_t>(n), 0.0);
  m_sources.addTo(store, view, context(), m_watts);
  m_bodyHeating.measure(store);
  const auto sources = [&](size_t first, size_t last) {
    m_bodyHeating.addTo(store, first, last, m_watts);
    if (m_bodyHeating.fluxes()) m_bodyFlux.addTo(store, m_pairs, first, last, m_watts);
    if (!m_boiling) return;
    for (size_t i = first; i < last; ++i) filmHeat(store, i, frame, m_partials[first / grain::kNeighbours]);
    countBoiling(store, first, last);
  };
  forChunks(n, grain::kNeighbours, sources);
  if (!m_boiling || !(m_settings.nucleation > 0)) return;
  const auto bubbles = [&](size_t first, size_t last) { nucleate(store, first, last); };
  forChunks(n, grain::kNeighbours, bubbles);
}

/// Vapour close to a wall below the boiling point condenses with the wall's film coefficient, Q = h A (T_w - T):
/// conduction through steam alone, some 3 W/(m2 K), would take minutes. At most kFilmShare of what is left in one
/// frame, so that a particle never falls through the plateau.
void HeatStage::filmHeat(const ParticleStore& store, size_t i, double frame, Partial& partial) {
  const double gas = store.gasFraction()[i];
  if (gas < 0.02) return;
  const api::Caloric& c = m_materials[store.material()[i]].caloric();
  const double dx = m_solver.spacing, t = store.temperature()[i];
  const api::Float4 x = store.position()[i];
  double joules = 0;
  for (const Wall& wall : m_surroundings.walls()) {
    const bool cold = wall.heat == WallHeat::FixedTemperature && wall.temperature < c.boilingPoint;
    if (!cold) continue;
    if (heightOver(wall, x) < kFilmReach * dx)
      joules += wall.filmCoefficient * dx * dx * (wall.temperature - t) * frame;
  }
  if (!(joules < 0)) return;
  const double superheat = double{store.mass()[i]} * c.heatCapacityGas * std::max(0.0, t - c.boilingPoint);
  joules = std::max(joules, -kFilmShare * (gas * latentContent(store, i) + superheat));
  m_frameJoules[i] += joules;
  partial.walls += joules;
  partial.exchanged -= joules;
}

void HeatStage::countBoiling(const ParticleStore& store, size_t first, size_t last) {
  for (size_t i = first; i < last; ++i) {
    uint32_t count = 0;
    if (boils(store, i)) {
      for (uint32_t k = m_pairs.begin[i]; k < m_pairs.same[i]; ++k) count += boils(store, m_pairs.partner[k]);
    }
    m_boilingPartners[i] = count;
  }
}

/// Between boiling neighbours latent heat moves to the richer one, so that few whole bubbles rise instead of many half
/// boiled particles hanging still. Each pair moves the smaller of the poorer one's content times nucleation and the
/// richer one's room, each divided by the number of its partners: both sides compute the same number from the same
/// snapshot, nobody can be overdrawn, and no order of pairs matters. The richest of a neighbourhood may fill up in one
/// frame. Ids break ties.
void HeatStage::nucleate(const ParticleStore& store, size_t first, size_t last) {
  const float* gas = store.gasFraction();
  const uint32_t* id = store.id();
  for (size_t i = first; i < last; ++i) {
    if (m_boilingPartners[i] == 0) continue;
    double joules = 0;
    for (uint32_t k = m_pairs.begin[i]; k < m_pairs.same[i]; ++k) {
      const uint32_t j = m_pairs.partner[k];
      if (m_boilingPartners[j] == 0) continue;
      const bool richer = gas[i] > gas[j] || (gas[i] == gas[j] && id[i] < id[j]);
      const size_t rich = richer ? i : j, poor = richer ? j : i;
      const double content =
          m_settings.nucleation * double{gas[poor]} * latentContent(store, poor) / m_boilingPartners[poor];
      const double room = (1 - double{gas[rich]}) * latentContent(store, rich) / m_boilingPartners[rich];
      const double moved = std::min(content, room);
      joules += richer ? moved : -moved;
    }
    m_frameJoules[i] += joules;
  }
}

}  // namespace ps
