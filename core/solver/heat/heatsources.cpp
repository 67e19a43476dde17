// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heat/heatsources.h"

#include "core/base/callee.h"
#include "core/base/error.h"
#include "core/base/parallelarrays.h"
#include "core/base/shorttext.h"

#include <algorithm>
#include <cmath>

namespace ps {

void BodyHeating::set(std::span<const BodyHeat> bodies) {
  m_bodies.assign(bodies.begin(), bodies.end());
  m_holds = std::any_of(bodies.begin(), bodies.end(), [](const BodyHeat& body) { return body.held > 0; });
  m_convects = std::any_of(bodies.begin(), bodies.end(),
                           [](const BodyHeat& body) { return body.held > 0 && body.convection > 0; });
  m_fluxes = std::any_of(bodies.begin(), bodies.end(), [](const BodyHeat& body) { return body.flux != 0; });
  m_insulates = std::any_of(bodies.begin(), bodies.end(), [](const BodyHeat& body) { return body.insulated; });
}

void BodyHeating::measure(const ParticleStore& store) {
  m_perMass.clear();
  if (std::all_of(m_bodies.begin(), m_bodies.end(), [](const BodyHeat& body) { return body.watts == 0; })) return;
  m_perMass.assign(m_bodies.size(), 0.0);
  for (size_t i = 0; i < store.size(); ++i) {
    if (store.body()[i] < m_perMass.size()) m_perMass[store.body()[i]] += double{store.mass()[i]};
  }
  for (size_t body = 0; body < m_bodies.size(); ++body) {
    m_perMass[body] = m_perMass[body] > 0 ? m_bodies[body].watts / m_perMass[body] : 0;
  }
}

void BodyHeating::addTo(const ParticleStore& store, size_t first, size_t last, std::span<double> watts) const {
  if (m_perMass.empty()) return;
  for (size_t i = first; i < last; ++i) {
    if (store.body()[i] < m_perMass.size()) watts[i] += m_perMass[store.body()[i]] * double{store.mass()[i]};
  }
}

void PluginHeating::set(std::vector<HeatSource> sources, ParticleStore& store) {
  m_sources = std::move(sources);
  for (const HeatSource& source : m_sources) {
    if (!isAside(source)) guarded(source, [&] { declareFields(source, store); });
  }
}

bool PluginHeating::isAside(const HeatSource& source) const {
  return std::find(m_aside.begin(), m_aside.end(), source.name) != m_aside.end();
}

/// False when it threw, and is put aside.
template <class Call>
bool PluginHeating::guarded(const HeatSource& source, Call&& call) {
  std::string problem;
  try {
    call();
    return true;
  } catch (const std::exception& e) {
    problem = shortText(e.what());
  } catch (...) {
    problem = "threw something that is no std::exception";
  }
  m_aside.push_back(source.name);
  m_faults.push_back({source.name, std::move(problem)});
  return false;
}

void PluginHeating::declareFields(const HeatSource& source, ParticleStore& store) {
  const CalleeScope callee(source.name.c_str());
  const api::List<api::FieldDeclaration> fields = source.plugin->fields();
  for (size_t k = 0; k < fields.count; ++k) {
    const api::FieldDeclaration f = fields.at(k);
    store.declare(f.name, f.type, f.unit, f.help);
  }
}

void PluginHeating::addTo(ParticleStore& store, const api::ParticleView& view, const api::ThermalContext& where,
                          std::span<double> watts) {
  for (const HeatSource& source : m_sources) {
    if (isAside(source) || !guarded(source, [&] { ask(source, store, view, where); })) continue;
    forChunks(store.size(), grain::kNeighbours, [&](size_t first, size_t last) {
      for (size_t i = first; i < last; ++i) watts[i] += m_watts[i];
    });
  }
}

void PluginHeating::putAside(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (std::find(m_aside.begin(), m_aside.end(), name) == m_aside.end()) m_aside.push_back(name);
  }
}

void PluginHeating::ask(const HeatSource& source, ParticleStore& store, const api::ParticleView& view,
                        api::ThermalContext where) {
  declareFields(source, store);  // a state that was restored may be of a scene without it
  where.parameters = {source.parameters.data(), source.parameters.size()};
  assignAll(m_watts, store.size(), 0.0);
  forChunks(store.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    const CalleeScope callee(source.name.c_str());
    source.plugin->addWatts(where, view, first, last, m_watts.data());
    for (size_t i = first; i < last; ++i) {
      if (!std::isfinite(m_watts[i])) throw Error("its heat is not a finite number");
    }
  });
}

}  // namespace ps
