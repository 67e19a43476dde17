// SPDX-License-Identifier: Apache-2.0
// The part of HeatStage that asks the thermal model for states and energies.
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/solver/heat/heat.h"
#include "core/solver/heat/phasestage.h"

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
    if (first > 0 && !isUpToDate()) bringUpToDate(store);
    startState(store, first, last, temperature, phase);
    m_modelChanged = false;
    noteCurves();
  });
}

bool HeatStage::initialise(ParticleStore& store, std::span<const uint32_t> indices) {
  if (!works() || indices.empty()) return true;
  return guarded([&] {
    const CalleeScope callee(m_modelName.c_str());
    for (size_t from = 0, to = 0; from < indices.size(); from = to) {
      while (to < indices.size() && indices[to] == indices[from] + (to - from)) ++to;
      const size_t first = indices[from], last = first + (to - from);
      m_model->initialise(context(), store.view(), first, last, store.temperature(), store.phase());
      deriveRange(store, first, last);
    }
  });
}

void HeatStage::startFields(ParticleStore& store) const {
  const auto fields = m_model->fields();
  for (size_t k = 0; k < fields.count; ++k) {
    const api::FieldDeclaration f = fields.at(k);
    store.declare(f.name, f.type, f.unit, f.help);
  }
}

void HeatStage::startState(ParticleStore& store, size_t first, size_t last, std::span<const double> temperature,
                           std::span<const api::Phase> phase) {
  startFields(store);
  m_newTemperature.resize(store.size());
  m_newPhase.resize(store.size());
  std::copy(temperature.begin(), temperature.end(), m_newTemperature.begin() + static_cast<std::ptrdiff_t>(first));
  std::copy(phase.begin(), phase.end(), m_newPhase.begin() + static_cast<std::ptrdiff_t>(first));
  inSlices(first, last, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) setShares(store, i, m_newPhase[i]);
    m_model->initialise(context(), store.view(), begin, end, m_newTemperature.data(), m_newPhase.data());
    deriveRange(store, begin, end);
  });
}

bool HeatStage::isUpToDate() const {
  for (uint32_t k = 0; k < m_materials.size(); ++k) {
    if (countsAnew(k)) return false;
  }
  return !m_modelChanged;
}

bool HeatStage::countsAnew(uint32_t material) const {
  if (m_modelChanged) return true;
  return material < m_curves.size() && !(m_curves[material] == EnthalpyCurves(m_materials[material].caloric()));
}

void HeatStage::noteCurves() {
  m_curves.clear();
  for (const BakedMaterial& material : m_materials) m_curves.emplace_back(material.caloric());
}

/// Starts the state of matter anew that another model, or other curves of its material, have counted so far, from its
/// temperature and shares.
void HeatStage::countAnew(ParticleStore& store) {
  startFields(store);
  std::vector<uint8_t> anew;
  for (uint32_t k = 0; k < m_materials.size(); ++k) anew.push_back(countsAnew(k) ? 1 : 0);
  const api::ThermalContext where = context();
  const api::ParticleView view = store.view();
  const uint32_t* material = store.material();
  const size_t n = store.size();
  for (size_t first = 0, last = 0; first < n; first = last) {
    const uint8_t wanted = anew[material[first]];
    while (last < n && anew[material[last]] == wanted) ++last;
    if (wanted) m_model->initialise(where, view, first, last, store.temperature(), store.phase());
  }
}

/// What the same matter amounts to may be another energy from now on: that is a source.
void HeatStage::bringUpToDate(ParticleStore& store) {
  const double before = m_lastEnergy;
  const bool known = m_lastCount > 0 && m_lastCount == store.size();
  if (store.size() > 0 && !isUpToDate()) countAnew(store);
  m_modelChanged = false;
  noteCurves();
  const auto body = [&](size_t first, size_t last) { deriveRange(store, first, last); };
  forChunks(store.size(), grain::kNeighbours, body);
  if (!known) return;
  if (const double change = energy(store) - before; change != 0) book(change);
}

void HeatStage::deriveRange(ParticleStore& store, size_t first, size_t last) {
  const api::ThermalOutput output{store.temperature(), store.solidFraction(), store.liquidFraction(),
                                  store.gasFraction()};
  const CalleeScope callee(m_modelName.c_str());
  m_model->derive(context(), store.view(), first, last, output);
}

void HeatStage::derive(ParticleStore& store) {
  guarded([&] { bringUpToDate(store); });
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
  if (!guarded([&] { forChunks(store.size(), grain::kNeighbours, body); })) return m_lastEnergy;
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
