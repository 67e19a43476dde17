// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/matterflow.h"

#include "core/simulation/compile.h"
#include "core/simulation/lattice.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// Nearer to another particle nothing is born or let go: less than a spacing, as the jet may slow down below the mouth.
constexpr double kClearance = 0.8;  // spacings

double numberOf(const Emitter& emitter, const char* key) {
  return ps::numberOf(emitter.parameters, emitterParameters(), key);
}

/// s between two times in which an emitter pours.
double openBetween(const Emitter& emitter, double from, double to) {
  if (!(numberOf(emitter, "speed") > 0)) return 0;
  return std::max(0.0, std::min(to, numberOf(emitter, "stop")) - std::max(from, numberOf(emitter, "start")));
}

bool isFree(const ParticleStore& store, size_t i) { return store.velocity()[i].w > 0; }
bool isHeld(const ParticleStore& store, size_t i) {
  return !isFree(store, i) && store.motion()[i] != api::Motion::Static;
}

double massOf(const ParticleStore& store, std::span<const uint32_t> ids) {
  double mass = 0;
  for (const uint32_t id : ids) mass += double{store.mass()[store.indexOf(id)]};
  return mass;
}

/// Whether a particle could stand here as far as walls go.
bool clearOfWalls(const std::vector<Wall>& walls, const api::Double3& p, double spacing) {
  return std::all_of(walls.begin(), walls.end(), [&](const Wall& wall) {
    return wall.normal.x * p.x + wall.normal.y * p.y + wall.normal.z * p.z - wall.offset >= 0.5 * spacing;
  });
}

}  // namespace

/// One emitter's turn.
struct MatterFlow::Job {
  Solver& solver;
  const Project& project;
  std::span<const BakedMaterial> materials;
  const Emitter& emitter;
  double spacing, most;
  const Birth& birth;

  Spawn layer(double offset) const { return compileLayer(project, materials, emitter, spacing, offset); }
};

void MatterFlow::drain(Solver& solver, const Project& project) {
  const ParticleStore& store = solver.particles();
  std::vector<uint32_t> ids;
  for (const Sink& sink : project.sinks) {
    if (!toggleOf(sink.parameters, sinkParameters(), "open")) continue;
    const Region box{sink.minimum, sink.maximum};
    for (size_t i = 0; i < store.size(); ++i) {
      const api::Double3 p = store.wrappedPosition(i);
      if (isFree(store, i) && box.contains({p.x, p.y, p.z})) ids.push_back(store.id()[i]);
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

void MatterFlow::takeBack(Solver& solver, std::span<const uint32_t> ids) {
  if (ids.empty()) return;
  const double before = solver.heatLedger().sources;
  m_given.count -= ids.size();
  m_given.mass -= massOf(solver.particles(), ids);
  solver.remove(ids);
  m_given.energy += solver.heatLedger().sources - before;
}

void MatterFlow::takeBack(Solver& solver, Pipe& pipe) {
  std::vector<uint32_t> ids;
  for (const Layer& layer : pipe.layers) {
    std::copy_if(layer.begin(), layer.end(), std::back_inserter(ids), [](uint32_t id) { return id != kNone; });
  }
  pipe.layers.clear();
  takeBack(solver, ids);
}

void MatterFlow::steer(Solver& solver, const Project& project, double dt) {
  bool changed = false;
  for (auto at = m_pipes.begin(); at != m_pipes.end();) {
    const auto emitter = std::find_if(project.emitters.begin(), project.emitters.end(),
                                      [&](const Emitter& e) { return e.id == at->first; });
    const bool gone = emitter == project.emitters.end();
    Pipe& pipe = at->second;
    if (gone || pipe.point != emitter->point || pipe.direction != emitter->direction ||
        pipe.diameter != numberOf(*emitter, "diameter") ||
        !(openBetween(*emitter, solver.time(), solver.time() + dt) > 0)) {
      changed = changed || !pipe.layers.empty();
      takeBack(solver, pipe);
      at = gone ? m_pipes.erase(at) : std::next(at);
      continue;
    }
    const Vec3& d = emitter->direction;
    const double rate = numberOf(*emitter, "speed") / std::hypot(d[0], d[1], d[2]);
    const ParticleStore& store = solver.particles();
    for (const Layer& layer : pipe.layers) {
      for (const uint32_t id : layer) {
        if (id == kNone) continue;
        store.velocity()[store.indexOf(id)] = {static_cast<float>(rate * d[0]), static_cast<float>(rate * d[1]),
                                               static_cast<float>(rate * d[2]), 0};
      }
    }
    ++at;
  }
  if (changed) settle(solver);
}

/// Gives birth to the particles of a layer at these of its places.
std::vector<uint32_t> MatterFlow::born(const Job& job, Spawn spawn, const std::vector<size_t>& places) {
  if (places.empty()) return {};
  std::vector<api::Double3> position;
  for (const size_t k : places) position.push_back(spawn.position[k]);
  spawn.position = std::move(position);
  spawn.velocity.resize(places.size());  // all the same
  const double before = job.solver.heatLedger().sources;
  const std::vector<uint32_t> ids = job.birth(std::move(spawn), job.emitter);
  m_given.count += ids.size();
  m_given.mass += massOf(job.solver.particles(), ids);
  m_given.energy += job.solver.heatLedger().sources - before;
  return ids;
}

/// The next layer leaves: what is held of it is let go, the rest is born.
void MatterFlow::cross(const Job& job, Pipe& pipe, double offset, double& living) {
  Spawn spawn = job.layer(offset);
  Layer held(spawn.position.size(), kNone);
  if (!pipe.layers.empty()) {
    held = std::move(pipe.layers.front());
    pipe.layers.pop_front();
  }
  const ParticleStore& store = job.solver.particles();
  TakenPlaces taken(kClearance * job.spacing, store.size(), store.period());
  for (size_t i = 0; i < store.size(); ++i) {
    if (!isHeld(store, i)) taken.add(store.wrappedPosition(i));
  }
  std::vector<size_t> fresh;
  std::vector<uint32_t> leaving, staying;
  for (size_t k = 0; k < held.size(); ++k) {
    if (!taken.isFree(spawn.position[k])) {
      if (held[k] != kNone) staying.push_back(held[k]);
    } else if (held[k] != kNone) {
      leaving.push_back(held[k]);
    } else {
      fresh.push_back(k);
    }
  }
  // What was due while the scene was at its fill is not made up for.
  if (living + static_cast<double>(leaving.size() + fresh.size()) > job.most) {
    staying.insert(staying.end(), leaving.begin(), leaving.end());
    leaving.clear();
    fresh.clear();
  }
  takeBack(job.solver, staying);
  job.solver.release(leaving);
  living += static_cast<double>(leaving.size() + born(job, std::move(spawn), fresh).size());
}

/// Adds what the pipe lacks behind the mouth. In a wall or in what stands fixed nothing is held: those support the jet.
void MatterFlow::fill(const Job& job, Pipe& pipe) {
  const ParticleStore& store = job.solver.particles();
  const auto depth =
      static_cast<size_t>(std::ceil(ps::numberOf(job.project.solver.parameters, solverParameters(), "support_ratio")));
  const std::vector<Wall> walls = compileWalls(job.project);
  while (pipe.layers.size() < depth) {
    Spawn spawn = job.layer(pipe.travelled - static_cast<double>(pipe.layers.size() + 1) * job.spacing);
    spawn.held = true;
    TakenPlaces taken(kClearance * job.spacing, store.size(), store.period());
    for (size_t i = 0; i < store.size(); ++i) taken.add(store.wrappedPosition(i));
    std::vector<size_t> places;
    for (size_t k = 0; k < spawn.position.size(); ++k) {
      if (taken.isFree(spawn.position[k]) && clearOfWalls(walls, spawn.position[k], job.spacing)) places.push_back(k);
    }
    Layer layer(spawn.position.size(), kNone);
    const std::vector<uint32_t> ids = born(job, std::move(spawn), places);
    for (size_t k = 0; k < ids.size(); ++k) layer[places[k]] = ids[k];
    pipe.layers.push_back(std::move(layer));
  }
}

/// Renews what depends on who is held.
void MatterFlow::settle(const Solver& solver) {
  const ParticleStore& store = solver.particles();
  m_total.held = {};
  for (const auto& [emitter, pipe] : m_pipes) {
    if (pipe.layers.empty()) continue;
    const std::span<const double> energies = solver.thermalEnergies();
    for (const Layer& layer : pipe.layers) {
      for (const uint32_t id : layer) {
        if (id == kNone) continue;
        const size_t i = store.indexOf(id);
        ++m_total.held.count;
        m_total.held.mass += double{store.mass()[i]};
        if (!energies.empty()) m_total.held.energy += energies[i];
      }
    }
  }
  m_total.poured = {m_given.count - m_total.held.count, m_given.mass - m_total.held.mass,
                    m_given.energy - m_total.held.energy};
}

bool MatterFlow::holds(uint32_t id) const {
  return std::any_of(m_pipes.begin(), m_pipes.end(), [&](const auto& entry) {
    const std::deque<Layer>& layers = entry.second.layers;
    return std::any_of(layers.begin(), layers.end(),
                       [&](const Layer& layer) { return std::find(layer.begin(), layer.end(), id) != layer.end(); });
  });
}

void MatterFlow::pour(Solver& solver, const Project& project, std::span<const BakedMaterial> materials, double spacing,
                      double dt, const std::function<uint32_t(const Emitter&)>& bodyOf, const Birth& birth) {
  for (const Emitter& emitter : project.emitters) {
    const double open = openBetween(emitter, solver.time() - dt, solver.time());
    if (!(open > 0)) continue;
    const Job job{solver, project, materials, emitter, spacing, numberOf(emitter, "most"), birth};
    Pipe& pipe = m_pipes.try_emplace(emitter.id, Pipe{spacing, {}, {}, {}, 0}).first->second;  // the first at once
    pipe.point = emitter.point, pipe.direction = emitter.direction;
    pipe.diameter = numberOf(emitter, "diameter");
    const ParticleStore& store = solver.particles();
    double living = 0;
    for (size_t i = 0; i < store.size(); ++i) {
      if (store.body()[i] == bodyOf(emitter) && isFree(store, i)) ++living;
    }
    pipe.travelled += numberOf(emitter, "speed") * open;
    for (; pipe.travelled >= spacing; pipe.travelled -= spacing) cross(job, pipe, pipe.travelled - spacing, living);
    fill(job, pipe);
  }
  settle(solver);
}

}  // namespace ps
