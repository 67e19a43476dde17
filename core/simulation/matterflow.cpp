// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/matterflow.h"

#include "core/simulation/compile.h"
#include "core/simulation/lattice.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// Nearer to another particle nothing is born: less than a spacing, as the jet may slow down below the mouth.
constexpr double kClearance = 0.8;  // spacings

double massOf(const ParticleStore& store, std::span<const uint32_t> ids) {
  double mass = 0;
  for (const uint32_t id : ids) mass += double{store.mass()[store.indexOf(id)]};
  return mass;
}

}  // namespace

void MatterFlow::drain(Solver& solver, const Project& project) {
  const ParticleStore& store = solver.particles();
  std::vector<uint32_t> ids;
  for (const Sink& sink : project.sinks) {
    if (!toggleOf(sink.parameters, sinkParameters(), "open")) continue;
    const Region box{sink.minimum, sink.maximum};
    for (size_t i = 0; i < store.size(); ++i) {
      const api::Double3 p = store.wrappedPosition(i);
      if (store.motion()[i] != api::Motion::Static && box.contains({p.x, p.y, p.z})) ids.push_back(store.id()[i]);
    }
  }
  if (ids.empty()) return;
  std::sort(ids.begin(), ids.end());  // two sinks may overlap
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  const double before = solver.heatLedger().sources;
  m_total.drained.mass += massOf(store, ids);
  m_total.drained.count += ids.size();
  solver.remove(ids);
  m_total.drained.energy += before - solver.heatLedger().sources;
}

void MatterFlow::pour(Solver& solver, const Project& project, std::span<const BakedMaterial> materials, double spacing,
                      double dt, const std::function<uint32_t(const Emitter&)>& bodyOf, const Birth& birth) {
  for (const Emitter& emitter : project.emitters) {
    const auto number = [&](const char* key) { return numberOf(emitter.parameters, emitterParameters(), key); };
    const double end = std::min(solver.time(), number("stop")), begin = std::max(solver.time() - dt, number("start"));
    if (!(end > begin) || !(number("speed") > 0)) continue;
    double& travelled = m_travelled.try_emplace(emitter.id, spacing).first->second;  // the first layer at once
    travelled += number("speed") * (end - begin);
    // What was due while the scene was at its fill is not made up for.
    const ParticleStore& store = solver.particles();
    const auto living = static_cast<double>(std::count(store.body(), store.body() + store.size(), bodyOf(emitter)));
    for (; travelled >= spacing; travelled -= spacing) {
      Spawn spawn = compileLayer(project, materials, emitter, spacing, travelled - spacing);
      spawn.position = freePositions(store, spawn.position, kClearance * spacing);
      spawn.velocity.resize(spawn.position.size());  // all the same
      if (spawn.position.empty() || living + double(spawn.position.size()) > number("most")) continue;
      const double before = solver.heatLedger().sources;
      const size_t first = store.size(), count = spawn.position.size();
      birth(std::move(spawn), emitter);
      for (size_t i = first; i < store.size(); ++i) m_total.poured.mass += double{store.mass()[i]};
      m_total.poured.count += count;
      m_total.poured.energy += solver.heatLedger().sources - before;
    }
  }
}

}  // namespace ps
