// SPDX-License-Identifier: Apache-2.0
// The part of HeatStage that asks the thermal model for states and energies.
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/solver/heat/heat.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace ps {
api::ThermalContext HeatStage::context() const {
  api::ThermalContext context{};
  context.pressure = m_settings.ambientPressure;
  context.ambientTemperature = airTemperature();
  context.parameters = {m_parameters.data(), m_parameters.size()};
  context.materials = {m_materialViews.data(), m_materialViews.size()};
  context.supportRadius = m_solver.spacing * m_solver.supportRatio;
  context.time = m_time;
  context.thermalTime = m_thermalTime;
  return context;
}

bool HeatStage::initialise(ParticleStore& store, size_t first, size_t last, std::span<const double> temperature,
                           std::span<const api::Phase> phase) {
  if (!works() || last <= first) return true;
  return guarded([&] {
    if (m_modelChanged && first > 0) adopt(store);
    m_modelChanged = false;
    startState(store, first, last, temperature, phase);
  });
}

void HeatStage::startState(ParticleStore& store, size_t first, size_t last, std::span<const double> temperature,
                           std::span<const api::Phase> phase) {
  const auto fields = m_model->fields();
  for (size_t k = 0; k < fields.count; ++k) {
    const api::FieldDeclaration f = fields.at(k);
    store.declare(f.name, f.type, f.unit, f.help);
  }
  m_newTemperature.resize(store.size());
  m_newPhase.resize(store.size());
  std::copy(temperature.begin(), temperature.end(), m_newTemperature.begin() + static_cast<std::ptrdiff_t>(first));
  std::copy(phase.begin(), phase.end(), m_newPhase.begin() + static_cast<std::ptrdiff_t>(first));
  m_model->initialise(context(), store.view(), first, last, m_newTemperature.data(), m_newPhase.data());
  deriveRange(store, first, last);
}

/// Another model than the one that wrote the state: starts it from temperature and phase. What it makes of the same
/// temperatures may differ in energy (on a plateau it cannot know how far the other one was): that is a source.
void HeatStage::adopt(ParticleStore& store) {
  m_modelChanged = false;
  const double before = m_lastEnergy;
  const bool known = m_lastCount > 0 && m_lastCount == store.size();
  const size_t n = store.size();
  if (n == 0) return;
  const auto fields = m_model->fields();
  for (size_t k = 0; k < fields.count; ++k) {
    const api::FieldDeclaration f = fields.at(k);
    store.declare(f.name, f.type, f.unit, f.help);
  }
  m_newTemperature.assign(store.temperature(), store.temperature() + n);
  m_model->initialise(context(), store.view(), 0, n, m_newTemperature.data(), store.phase());
  deriveRange(store, 0, n);
  if (known) book(energy(store) - before);
}

void HeatStage::deriveRange(ParticleStore& store, size_t first, size_t last) {
  const api::ThermalOutput output{store.temperature(), store.solidFraction(), store.liquidFraction(),
                                  store.gasFraction()};
  const CalleeScope callee(m_modelName.c_str());
  m_model->derive(context(), store.view(), first, last, output);
}

void HeatStage::derive(ParticleStore& store) {
  guarded([&] {
    if (m_modelChanged) return adopt(store);
    const bool known = m_lastCount > 0 && m_lastCount == store.size();
    const double before = m_lastEnergy;
    const auto body = [&](size_t first, size_t last) { deriveRange(store, first, last); };
    parallelFor(store.size(), grain::kNeighbours, std::cref(body));
    if (!known) return;
    if (const double change = energy(store) - before; change != 0) book(change);
  });
}

double HeatStage::energy(const ParticleStore& store) const {
  if ((m_modelChanged || m_putAside) && m_lastCount == store.size()) return m_lastEnergy;  // as it was left
  if (!works() || m_modelChanged || store.size() == 0) return 0;
  m_energies.resize(store.size());
  const api::ThermalContext where = context();
  const api::ParticleView view = store.view();
  const auto body = [&](size_t first, size_t last) {
    const CalleeScope callee(m_modelName.c_str());
    m_model->energy(where, view, first, last, m_energies.data());
    for (size_t i = first; i < last; ++i) {
      if (!std::isfinite(m_energies[i])) throw Error("its energy is not a finite number");
    }
  };
  if (!guarded([&] { parallelFor(store.size(), grain::kNeighbours, std::cref(body)); })) return m_lastEnergy;
  double sum = 0;
  for (size_t first = 0; first < store.size(); first += grain::kNeighbours) {
    double chunk = 0;
    for (size_t i = first; i < std::min(store.size(), first + grain::kNeighbours); ++i) chunk += m_energies[i];
    sum += chunk;
  }
  m_lastEnergy = sum;
  m_lastCount = store.size();
  return sum;
}

std::span<const double> HeatStage::energies(const ParticleStore& store) const {
  if (!works() || m_modelChanged) return {};
  energy(store);
  if (!works()) return {};
  return {m_energies.data(), store.size()};
}

}  // namespace ps
