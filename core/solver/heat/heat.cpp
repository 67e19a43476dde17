// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heat/heat.h"

#include "core/base/callee.h"
#include "core/base/parallelarrays.h"
#include "core/base/room.h"
#include "core/matter/stablephase.h"
#include "core/solver/heat/phasestage.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace ps {
namespace {

/// K: smaller differences are the rounding of temperatures.
constexpr double kSameTemperature = 1e-9;

/// Largest k/c in kg/(m s) of the phases that a particle consists of: how fast it answers to a conductance.
double fastestPhase(const BakedMaterial& material, double t, double solid, double liquid, double gas) {
  const api::Caloric& c = material.caloric();
  double fastest = 0;
  if (solid > 0) fastest = material.conductivity(t, 1, 0, 0) / c.heatCapacitySolid;
  if (liquid > 0) fastest = std::max(fastest, material.conductivity(t, 0, 1, 0) / c.heatCapacityLiquid);
  if (gas > 0) fastest = std::max(fastest, material.conductivity(t, 0, 0, 1) / c.heatCapacityGas);
  return fastest;
}

/// Smallest heat capacity of the phases present, J/(kg K).
double smallestCapacity(const api::Caloric& c, double solid, double liquid, double gas) {
  double smallest = 1e30;
  if (solid > 0) smallest = c.heatCapacitySolid;
  if (liquid > 0) smallest = std::min(smallest, c.heatCapacityLiquid);
  if (gas > 0) smallest = std::min(smallest, c.heatCapacityGas);
  return smallest;
}

}  // namespace

void HeatStage::configure(const ThermalSettings& settings, const SolverSettings& solver, std::vector<Wall> walls,
                          const Bounds& bounds, std::span<const BakedMaterial> materials,
                          const api::ThermalPlugin* model, std::vector<double> modelParameters) {
  // What was reached for another lapse says nothing of this one, until a frame has tried.
  if (settings.timeScale != m_settings.timeScale) m_delivered = settings.timeScale;
  m_settings = settings;
  if (!(settings.airHeatCapacity > 0)) m_ledger.airWarming = 0;  // endless air keeps its temperature
  m_solver = solver;
  m_materials = materials;
  m_surroundings.configure(settings, solver, std::move(walls), bounds, materials);
  m_materialViews.clear();
  for (const BakedMaterial& material : materials) m_materialViews.push_back(&material);
  if (model != m_model) {
    m_modelChanged = true;
    m_putAside = false;
  }
  m_model = model;
  m_parameters = std::move(modelParameters);
}

void HeatStage::snapshotRange(const ParticleStore& store, HeatInstant& instant, size_t first, size_t last) const {
  const uint32_t* material = store.material();
  const double* temperature = store.temperature();
  for (size_t i = first; i < last; ++i) {
    instant.temperature[i] = temperature[i];
    instant.potential[i] = m_materials[material[i]].kirchhoff(temperature[i]);
  }
}

/// Everything that stays the same during a frame: pairs, what lies around, the stable step.
void HeatStage::prepare(ParticleStore& store, const Neighbours& neighbours, uint64_t frame, PairRoom* room) {
  const size_t n = store.size();
  m_partials.resize(chunkCount(n, grain::kNeighbours));
  for (auto* list : {&m_joules, &m_frameJoules, &m_watts, &m_fixedConductance}) list->resize(n);
  m_now.resize(n);
  m_next.resize(n);
  m_boilingPartners.resize(n);
  m_insulated.clear();
  if (m_bodyHeating.insulates()) {
    m_insulated.resize(n);
    forChunks(n, grain::kNumbers, [&](size_t first, size_t last) {
      for (size_t i = first; i < last; ++i) m_insulated[i] = m_bodyHeating.isInsulated(store, i) ? 1 : 0;
    });
  }
  m_convection.clear();
  if (m_bodyHeating.convects()) {
    m_convection.resize(n);
    forChunks(n, grain::kNumbers, [&](size_t first, size_t last) {
      for (size_t i = first; i < last; ++i) m_convection[i] = static_cast<float>(m_bodyHeating.convectionAt(store, i));
    });
  }
  m_pairs.build(store, neighbours.view(), m_materials,
                {m_solver.spacing * m_solver.supportRatio, m_solver.spacing, m_solver.kernel,
                 m_settings.momentCorrection, m_settings.contactConductance, m_insulated, m_convection},
                room);
  if (m_bodyHeating.fluxes()) m_bodyFlux.measure(store, m_pairs, m_bodyHeating, m_solver);
  m_surroundings.measure(store, neighbours.view(), m_pairs, frame);
  m_surroundings.setAir(airTemperature());
  const auto body = [&](size_t first, size_t last) {
    Partial& partial = m_partials[first / grain::kNeighbours];
    partial = {};
    snapshotRange(store, m_now, first, last);
    sumConductances(store, first, last, partial);
    partial.fastest = fastestRate(store, m_now, first, last);
  };
  forChunks(n, grain::kNeighbours, body);
  m_boiling = false;
  for (const Partial& partial : m_partials) m_boiling = m_boiling || partial.boiling > 0;
  findLimit();
}

void HeatStage::sumConductances(const ParticleStore& store, size_t first, size_t last, Partial& partial) {
  for (size_t i = first; i < last; ++i) {
    if (store.gasFraction()[i] > 0) ++partial.boiling;
    m_fixedConductance[i] = m_surroundings.fixedConductance(store, i) + m_pairs.otherTotal[i];
  }
}

bool HeatStage::advance(ParticleStore& store, const Neighbours& neighbours, double dt, uint64_t frame, PairRoom* room) {
  m_substeps = 0;
  m_swept = false;
  m_delivered = m_settings.timeScale;
  if (!works() || store.size() == 0) return true;
  return guarded([&] { exchange(store, neighbours, dt, frame, room); });
}

void HeatStage::exchange(ParticleStore& store, const Neighbours& neighbours, double dt, uint64_t frame,
                         PairRoom* room) {
  if (!isUpToDate()) bringUpToDate(store);
  double time = dt * m_settings.timeScale;
  if (!(time > 0)) return;
  if (m_bodyHeating.holds()) hold(store);
  const api::ParticleView view = store.view();
  const api::NeighbourView lists = neighbours.view();
  if (isBalanced(store, view, lists, time)) return passTime(store, view, time);
  prepare(store, neighbours, frame, room);
  askPairLaw(view, lists);
  collectFrameHeat(store, view, std::min(time, std::max(explicitTime(), sweepTime())));
  time -= takeExplicitSteps(store, view, lists, time);
  if (time > 0 && !m_pairLaw) time -= takeSweeps(store, view, time);
  if (time > 1e-9 * dt * m_settings.timeScale) m_delivered = m_settings.timeScale - time / dt;
  closeBooks();
}

/// Brings what is held to its temperature, in the phase that is stable there.
void HeatStage::hold(ParticleStore& store) {
  const auto strays = [&](size_t i) {
    const double held = m_bodyHeating.heldAt(store, i);
    return held > 0 && !(std::abs(store.temperature()[i] - held) < kSameTemperature);
  };
  const bool any = anyChunk(store.size(), grain::kNumbers, [&](size_t first, size_t last) {
    while (first < last && !strays(first)) ++first;
    return first < last;
  });
  if (!any) return;
  const double before = energy(store);
  m_newTemperature.resize(store.size());
  m_newPhase.resize(store.size());
  const api::ThermalContext where = context();
  const auto body = [&](size_t begin, size_t end) {
    const CalleeScope callee(m_modelName.c_str());
    for (size_t i = begin, last = begin; i < end; i = last + 1) {
      for (last = i; last < end && strays(last); ++last) {
        m_newTemperature[last] = m_bodyHeating.heldAt(store, last);
        m_newPhase[last] = stablePhase(m_materials[store.material()[last]].caloric(), m_newTemperature[last]);
        setShares(store, last, m_newPhase[last]);
      }
      if (last == i) continue;
      m_model->initialise(where, store.view(), i, last, m_newTemperature.data(), m_newPhase.data());
      deriveRange(store, i, last);
    }
  };
  forChunks(store.size(), grain::kNeighbours, body);
  const double given = energy(store) - before;
  m_ledger.heaters += given;
  m_ledger.exchanged += std::abs(given);
}

/// Whether nothing warms or cools anything else, nor itself; vapour is never left alone, for the sake of nucleation.
bool HeatStage::isBalanced(ParticleStore& store, const api::ParticleView& view, const api::NeighbourView& lists,
                           double time) {
  if (m_bodyHeating.fluxes()) return false;
  const double *temperature = store.temperature(), *end = temperature + store.size();
  const auto [low, high] = std::minmax_element(temperature, end);
  m_surroundings.setAir(airTemperature());
  if (!(*high - *low < kSameTemperature) || !m_surroundings.isLike(*low, kSameTemperature)) return false;
  const float* gas = store.gasFraction();
  if (std::any_of(gas, gas + store.size(), [](float share) { return share > 0; })) return false;
  if (!m_pairLaw) askPairLaw(view, lists);  // a model that had one in the last frame has one
  if (m_pairLaw) return false;
  m_watts.resize(store.size());
  m_frameJoules.resize(store.size());
  m_boiling = false;
  collectFrameHeat(store, view, time);
  return std::all_of(m_watts.begin(), m_watts.end(), [](double watts) { return watts == 0; });
}

void HeatStage::passTime(ParticleStore& store, const api::ParticleView& view, double time) {
  assignAll(m_joules, store.size(), 0.0);
  const api::ThermalContext where = context();
  const auto body = [&](size_t first, size_t last) {
    const CalleeScope callee(m_modelName.c_str());
    m_model->addHeat(where, view, first, last, m_joules.data(), time);
    deriveRange(store, first, last);
  };
  forChunks(store.size(), grain::kNeighbours, body);
}

/// Thermal seconds that one frame's explicit steps can do, and its sweeps.
double HeatStage::explicitTime() const { return mostExplicit() * explicitShare() * m_limit; }
double HeatStage::sweepTime() const { return m_pairLaw ? 0 : kMaxSweeps * kSweepLength * m_limit; }

/// Of the stable step.
double HeatStage::explicitShare() const { return std::clamp(m_settings.cfl, 0.01, 5.0); }

int HeatStage::mostExplicit() const { return m_settings.steps == HeatSteps::Explicit ? kMostExplicit : kMaxExplicit; }

/// Returns the thermal seconds done: all, or none where kMaxExplicit stable steps would not do from the start. The
/// stable step is measured anew after each one, as freezing matter may conduct several times better than its liquid.
double HeatStage::takeExplicitSteps(ParticleStore& store, const api::ParticleView& view,
                                    const api::NeighbourView& lists, double time) {
  const double share = explicitShare();
  const int most = mostExplicit();
  if (time > explicitTime() && !m_pairLaw) return 0;
  double left = time;
  while (left > 0 && m_substeps < most) {
    const double steps = std::max(1.0, std::ceil(left / (share * m_limit)));
    const double step = left / steps;
    explicitStep(store, view, lists, step, m_substeps == 0);
    left = steps > 1 ? left - step : 0;
    ++m_substeps;
  }
  return time - left;
}

double HeatStage::takeSweeps(ParticleStore& store, const api::ParticleView& view, double time) {
  m_swept = true;
  const double done = std::min(time, sweepTime());
  const int sweeps = std::max(1, static_cast<int>(std::ceil(done / (kSweepLength * m_limit))));
  for (int k = 0; k < sweeps; ++k) {
    sweep(store, view, done / sweeps, m_substeps == 0);
    ++m_substeps;
  }
  return done;
}

void HeatStage::explicitStep(ParticleStore& store, const api::ParticleView& view, const api::NeighbourView& lists,
                             double step, bool firstStep) {
  const api::ThermalContext where = context();
  const double airBefore = airHeat();
  if (m_pairLaw && !firstStep) askPairLaw(view, lists);
  const auto body = [&](size_t first, size_t last) {
    Partial& partial = m_partials[first / grain::kNeighbours];
    gather(store, step, first, last, partial);
    if (m_pairLaw) gatherPairLaw(lists, step, first, last);
    addFrameHeat(store, step, firstStep, first, last, partial);
    const CalleeScope callee(m_modelName.c_str());
    m_model->addHeat(where, view, first, last, m_joules.data(), step);
    deriveRange(store, first, last);
    snapshotRange(store, m_next, first, last);
    partial.fastest = fastestRate(store, m_next, first, last);
  };
  forChunks(store.size(), grain::kNeighbours, body);
  std::swap(m_now, m_next);
  takeFromAir(airHeat() - airBefore);
  findLimit();
}

/// Largest sum of conductances over heat capacity of particles [first, last), 1/s: Gershgorin's bound. A wall beyond a
/// point of balance may take more than the particle's own phase conducts: a melt that insulates freezes at it.
double HeatStage::fastestRate(const ParticleStore& store, const HeatInstant& now, size_t first, size_t last) const {
  double fastest = 0;
  for (size_t i = first; i < last; ++i) {
    const double mass = store.mass()[i];
    if (!(mass > 0) || isHeld(store, i)) continue;
    const BakedMaterial& material = m_materials[store.material()[i]];
    const double s = store.solidFraction()[i], l = store.liquidFraction()[i], g = store.gasFraction()[i];
    const double ownPhase = fastestPhase(material, store.temperature()[i], s, l, g);
    const double smallest = smallestCapacity(material.caloric(), s, l, g);
    const double walls = std::max(m_surroundings.perConductivity(i) * ownPhase,
                                  m_surroundings.wallConductance(store, i, now) / smallest);
    double rate = m_pairs.sameTotal[i] * ownPhase + walls;
    if (m_fixedConductance[i] > 0) rate += m_fixedConductance[i] / smallest;
    fastest = std::max(fastest, rate / mass);
  }
  return fastest;
}

void HeatStage::findLimit() {
  double fastest = 0;
  for (const Partial& partial : m_partials) fastest = std::max(fastest, partial.fastest);
  fastest += m_pairRate;
  if (m_settings.airHeatCapacity > 0)
    fastest = std::max(fastest, m_surroundings.airConductance() / m_settings.airHeatCapacity);
  m_limit = fastest > 0 ? 1 / fastest : 1e30;
}

/// J that air has given in this frame so far.
double HeatStage::airHeat() const {
  double joules = 0;
  for (const Partial& partial : m_partials) joules += partial.air;
  return joules;
}

/// A lump of air cools by what it gives.
void HeatStage::takeFromAir(double joules) {
  if (!(m_settings.airHeatCapacity > 0)) return;
  m_ledger.airWarming -= joules / m_settings.airHeatCapacity;
  m_surroundings.setAir(airTemperature());
}

void HeatStage::book(HeatBooks& books, HeatSurroundings::Kind kind, double joules) {
  (kind == HeatSurroundings::Kind::Wall  ? books.walls
   : kind == HeatSurroundings::Kind::Air ? books.air
                                         : books.radiation) += joules;
  books.exchanged += std::abs(joules);
}

/// Heat from neighbours and what lies around during `step` s of thermal time, from the snapshot alone.
void HeatStage::gather(const ParticleStore& store, double step, size_t first, size_t last, Partial& partial) {
  const double* potential = m_now.potential.data();
  const double* temperature = m_now.temperature.data();
  const uint32_t* partner = m_pairs.partner.data();
  const float* conductance = m_pairs.conductance.data();
  for (size_t i = first; i < last; ++i) {
    const double t = temperature[i];
    double watts = 0;
    if (!m_pairLaw) {
      const double here = potential[i];
      double sum[4] = {0, 0, 0, 0};  // four chains keep the adder busy; their order is fixed
      uint32_t k = m_pairs.begin[i];
      const uint32_t same = m_pairs.same[i];
      for (; k + 4 <= same; k += 4) {
        for (uint32_t c = 0; c < 4; ++c) sum[c] += double{conductance[k + c]} * (potential[partner[k + c]] - here);
      }
      for (; k < same; ++k) sum[0] += double{conductance[k]} * (potential[partner[k]] - here);
      for (k = m_pairs.other[i]; k < m_pairs.end[i]; ++k) {
        sum[1] += double{conductance[k]} * (temperature[partner[k]] - t);
      }
      watts = (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }
    m_surroundings.forEachInSight(i, m_now, [&](uint32_t j, double g) { watts += g * (temperature[j] - t); });
    double around = 0;
    m_surroundings.forEach(store, i, m_now, [&](HeatSurroundings::Kind kind, double g, double target) {
      const double joules = step * g * (target - t);
      around += joules;
      book(partial, kind, joules);
    });
    m_joules[i] = step * watts + around;
  }
}

void HeatStage::askPairLaw(const api::ParticleView& view, const api::NeighbourView& lists) {
  const size_t n = view.count, probe = std::min(n, grain::kNeighbours);
  // Most models have none, and need no room for all.
  makeRoomFor(m_pairWatts, m_pairLaw ? lists.slots : *std::max_element(lists.end, lists.end + probe));
  const api::ThermalContext where = context();
  m_pairLaw = m_model->pairFlux(where, view, lists, 0, probe, m_pairWatts.data());
  m_pairRate = 0;
  if (!m_pairLaw) return;
  if (m_pairWatts.size() < lists.slots) {  // the first time that one is met
    makeRoomFor(m_pairWatts, lists.slots);
    m_model->pairFlux(where, view, lists, 0, probe, m_pairWatts.data());
  }
  const auto* rates = static_cast<const api::PairRates*>(m_model->extension(api::kPairRates));
  m_lawRates.assign(chunkCount(n, grain::kNeighbours), 0.0);
  const auto body = [&](size_t first, size_t last) {
    const CalleeScope callee(m_modelName.c_str());
    if (first >= probe) m_model->pairFlux(where, view, lists, first, last, m_pairWatts.data());
    if (rates) m_lawRates[first / grain::kNeighbours] = rates->fastestPairRate(where, view, lists, first, last);
  };
  forChunks(n, grain::kNeighbours, body);
  m_pairRate = *std::max_element(m_lawRates.begin(), m_lawRates.end());
  findLimit();
}

void HeatStage::gatherPairLaw(const api::NeighbourView& lists, double step, size_t first, size_t last) {
  for (size_t i = first; i < last; ++i) {
    if (m_pairs.isInsulated(i)) continue;
    double watts = 0;
    for (uint32_t k = lists.begin[i]; k < lists.last[i]; ++k) {
      if (!m_pairs.isInsulated(lists.index[k])) watts += m_pairWatts[k];
    }
    m_joules[i] += step * watts;
  }
}

/// J that can surely be taken from particle i before it is as cold as kColdest, whatever it passes on the way.
double HeatStage::aboveColdest(const ParticleStore& store, size_t i) const {
  const api::Caloric& c = m_materials[store.material()[i]].caloric();
  const double capacity =
      double{store.mass()[i]} * std::min({c.heatCapacitySolid, c.heatCapacityLiquid, c.heatCapacityGas});
  return capacity * (store.temperature()[i] - kColdest);
}

/// The share that can be had of what walls and sources want to take from particle i in this step, in J below 0: down to
/// kColdest, after what it gives away by itself.
double HeatStage::shareToTake(const ParticleStore& store, size_t i, double joules) const {
  const double there = aboveColdest(store, i) + std::min(0.0, m_joules[i]);
  return std::clamp(there / -joules, 0.0, 1.0);
}

/// What comes once a frame (film, nucleation), walls of given flux and sources.
void HeatStage::addFrameHeat(const ParticleStore& store, double step, bool firstStep, size_t first, size_t last,
                             Partial& partial) {
  for (size_t i = first; i < last; ++i) {
    double source = m_watts[i] * step, flux = m_surroundings.watts(i) * step;
    if (const double taken = std::min(source, 0.0) + std::min(flux, 0.0); taken < 0) {
      const double share = shareToTake(store, i, taken);
      if (source < 0) source *= share;
      if (flux < 0) flux *= share;
    }
    partial.heaters += source;
    partial.exchanged += std::abs(source);
    if (flux != 0) book(partial, HeatSurroundings::Kind::Wall, flux);
    m_joules[i] += source + flux + (firstStep ? m_frameJoules[i] : 0);
    if (!isHeld(store, i)) continue;
    partial.heaters -= m_joules[i];
    partial.exchanged += std::abs(m_joules[i]);
    m_joules[i] = 0;
  }
}

void HeatStage::closeBooks() {
  for (const Partial& partial : m_partials) {
    m_ledger.walls += partial.walls;
    m_ledger.air += partial.air;
    m_ledger.radiation += partial.radiation;
    m_ledger.heaters += partial.heaters;
    m_ledger.exchanged += partial.exchanged;
  }
}

}  // namespace ps
