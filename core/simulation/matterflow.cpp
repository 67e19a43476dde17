// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/matterflow.h"

#include "core/scene/turnedbox.h"
#include "core/simulation/compile.h"
#include "core/simulation/lattice.h"
#include "core/simulation/mouth.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ps {
namespace {

/// Nearer to another particle nothing is born: less than a spacing, as the jet may slow down below the mouth.
constexpr double kClearance = 0.8;  // spacings
/// Nearer to another particle nothing is let go. What is held presses what stands in its way aside, as a pump does;
/// where it cannot, in a vessel that is full, it is taken back, and new matter stands ready.
constexpr double kPressed = 0.5;  // spacings
/// Particles that are near to a place of a mouth, as a guess for the length of tables.
constexpr size_t kNearEach = 4;

/// Of the distance between two layers: one that is so little within reach need not be there.
constexpr double kHardlyReached = 0.25;

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
  return std::all_of(walls.begin(), walls.end(),
                     [&](const Wall& wall) { return heightOver(wall, p) >= 0.5 * spacing; });
}

}  // namespace

/// One emitter's turn.
struct MatterFlow::Job {
  Solver& solver;
  const Project& project;
  std::span<const BakedMaterial> materials;
  const Emitter& emitter;
  double spacing, pitch, most;  ///< m, from a layer to the next, particles
  const Birth& birth;

  Spawn layer(double offset) const { return compileLayer(project, materials, emitter, spacing, offset); }
};

void MatterFlow::drain(Solver& solver, const Project& project) {
  const ParticleStore& store = solver.particles();
  std::vector<uint32_t> ids;
  for (const Sink& sink : project.sinks) {
    if (!toggleOf(sink.parameters, sinkParameters(), "open")) continue;
    const TurnedBox box(sink);
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

void MatterFlow::takeBack(Solver& solver, Layer ids) {
  std::erase(ids, kNone);
  if (ids.empty()) return;
  const double before = solver.heatLedger().sources;
  m_born.count -= ids.size();
  m_born.mass -= massOf(solver.particles(), ids);
  solver.remove(ids);
  m_born.energy += solver.heatLedger().sources - before;
}

void MatterFlow::empty(Solver& solver, Pipe& pipe) {
  for (const Layer& layer : pipe.layers) takeBack(solver, layer);
  pipe.layers.clear();
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
      empty(solver, pipe);
      pipe.last.clear();
      at = gone ? m_pipes.erase(at) : std::next(at);
      continue;
    }
    const api::Float4 velocity = float4Of(numberOf(*emitter, "speed") * emitter->direction.normalized(), 0);
    ParticleStore& store = solver.particles();
    for (const Layer& layer : pipe.layers) {
      for (const uint32_t id : layer) {
        if (id == kNone) continue;
        store.velocity()[store.indexOf(id)] = velocity;
      }
    }
    ++at;
  }
  if (changed) settle(solver);
}

/// Gives birth to the particles of a layer at these of its places, and notes their ids there.
void MatterFlow::born(const Job& job, const Spawn& layer, const std::vector<size_t>& places, Layer& ids) {
  if (places.empty()) return;
  Spawn spawn = layer;
  spawn.position.clear();
  spawn.velocity.clear();
  for (const size_t k : places) {
    spawn.position.push_back(layer.position[k]);
    spawn.velocity.push_back(layer.velocity[k]);
  }
  const double before = job.solver.heatLedger().sources;
  const std::vector<uint32_t> fresh = job.birth(std::move(spawn), job.emitter);
  for (size_t k = 0; k < fresh.size(); ++k) ids[places[k]] = fresh[k];
  m_born.count += fresh.size();
  m_born.mass += massOf(job.solver.particles(), fresh);
  m_born.energy += job.solver.heatLedger().sources - before;
}

/// The next layer as it is by now, `offset` m down the jet. It crossed the mouth within the frame, but nothing has
/// drawn it along since: it gets its share of what has become of the layer before it, in line between that one and the
/// mouth. Otherwise a jet that runs away from its mouth would open wherever a layer comes a frame later than others.
Spawn MatterFlow::crossed(const Job& job, const Pipe& pipe, double offset) const {
  Spawn spawn = job.layer(offset);
  const Spawn before = job.layer(offset + job.pitch);
  const ParticleStore& store = job.solver.particles();
  const double share = offset / (offset + job.pitch);
  for (size_t k = 0; k < pipe.last.size(); ++k) {
    const size_t i = store.indexOf(pipe.last[k]);
    if (i >= store.size()) continue;
    const api::Float4 &p = store.position()[i], &v = store.velocity()[i];
    api::Double3 &x = spawn.position[k], &u = spawn.velocity[k];
    const api::Double3& from = before.position[k];
    float dx = static_cast<float>(p.x - from.x), dy = static_cast<float>(p.y - from.y),
          dz = static_cast<float>(p.z - from.z);
    store.period().shorten(dx, dy, dz);
    if (std::hypot(dx, dy, dz) > job.spacing) continue;  // it has gone its own way
    x.x += share * dx, x.y += share * dy, x.z += share * dz;
    u.x += share * (v.x - u.x), u.y += share * (v.y - u.y), u.z += share * (v.z - u.z);
  }
  return spawn;
}

/// The next layer leaves: what is held of it is let go, the rest is born.
void MatterFlow::cross(const Job& job, Pipe& pipe, double offset, double& living) {
  const Spawn spawn = crossed(job, pipe, offset);
  Layer held(spawn.position.size(), kNone);
  if (!pipe.layers.empty()) {
    held = std::move(pipe.layers.front());
    pipe.layers.pop_front();
  }
  ParticleStore& store = job.solver.particles();
  const NearBox near(spawn.position, kClearance * job.spacing, store.period());
  OccupiedPlaces occupied(kClearance * job.spacing, kNearEach * spawn.position.size(), store.period()),
      pressed(kPressed * job.spacing, kNearEach * spawn.position.size(), store.period());
  for (size_t i = 0; i < store.size(); ++i) {
    if (isHeld(store, i) || !near.holds(store.position()[i])) continue;
    occupied.add(store.wrappedPosition(i));
    pressed.add(store.wrappedPosition(i));
  }
  std::vector<size_t> places;
  for (size_t k = 0; k < held.size(); ++k) {
    if ((held[k] == kNone ? occupied : pressed).isFree(spawn.position[k])) places.push_back(k);
  }
  // What was due while the scene was at its fill is not made up for.
  if (living + static_cast<double>(places.size()) > job.most) places.clear();
  Layer leaving(held.size(), kNone);
  std::vector<size_t> fresh;
  for (const size_t k : places) {
    leaving[k] = std::exchange(held[k], kNone);
    if (leaving[k] == kNone) {
      fresh.push_back(k);
      continue;
    }
    const size_t i = store.indexOf(leaving[k]);
    const api::Double3 &x = spawn.position[k], &v = spawn.velocity[k];
    store.position()[i] = {static_cast<float>(x.x), static_cast<float>(x.y), static_cast<float>(x.z),
                           store.position()[i].w};
    store.velocity()[i] = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0};
  }
  job.solver.release(leaving);
  takeBack(job.solver, held);
  born(job, spawn, fresh, leaving);
  living +=
      static_cast<double>(leaving.size() - static_cast<size_t>(std::count(leaving.begin(), leaving.end(), kNone)));
  pipe.last = std::move(leaving);
}

/// Adds what the pipe lacks behind the mouth. In a wall or in what stands fixed nothing is held: those support the jet.
void MatterFlow::fill(const Job& job, Pipe& pipe) {
  const ParticleStore& store = job.solver.particles();
  const double reach = job.spacing * ps::numberOf(job.project.solver.parameters, solverParameters(), "support_ratio");
  if (job.pitch > reach) return;  // drops feel nothing of each other
  const auto depth = static_cast<size_t>(std::ceil(reach / job.pitch - kHardlyReached));
  const std::vector<Wall> walls = compileWalls(job.project);
  while (pipe.layers.size() < depth) {
    Spawn spawn = job.layer(pipe.travelled - static_cast<double>(pipe.layers.size() + 1) * job.pitch);
    spawn.held = true;
    const NearBox near(spawn.position, kClearance * job.spacing, store.period());
    OccupiedPlaces occupied(kClearance * job.spacing, kNearEach * spawn.position.size(), store.period());
    for (size_t i = 0; i < store.size(); ++i) {
      if (near.holds(store.position()[i])) occupied.add(store.wrappedPosition(i));
    }
    std::vector<size_t> places;
    for (size_t k = 0; k < spawn.position.size(); ++k) {
      if (occupied.isFree(spawn.position[k]) && clearOfWalls(walls, spawn.position[k], job.spacing))
        places.push_back(k);
    }
    Layer layer(spawn.position.size(), kNone);
    born(job, spawn, places, layer);
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
  m_total.poured = {m_born.count - m_total.held.count, m_born.mass - m_total.held.mass,
                    m_born.energy - m_total.held.energy};
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
  m_limits.clear();
  for (const Emitter& emitter : project.emitters) {
    const double open = openBetween(emitter, solver.time() - dt, solver.time());
    if (!(open > 0)) continue;
    const Mouth mouth = mouthOf(numberOf(emitter, "diameter"), spacing);
    const double pitch = mouth.pitch;
    const Job job{solver, project, materials, emitter, spacing, pitch, numberOf(emitter, "most"), birth};
    Pipe& pipe = m_pipes.try_emplace(emitter.id, Pipe{pitch, {}, {}, {}, {}, 0}).first->second;  // the first at once
    pipe.point = emitter.point, pipe.direction = emitter.direction;
    pipe.diameter = numberOf(emitter, "diameter");
    const ParticleStore& store = solver.particles();
    const uint32_t body = bodyOf(emitter);
    double living = 0;
    for (size_t i = 0; i < store.size(); ++i) {
      if (store.body()[i] == body && isFree(store, i)) ++living;
    }
    const double speed = numberOf(emitter, "speed"), due = speed * open, most = kMostLayers * pitch;
    if (due > most) m_limits.push_back({emitter.id + ".speed", speed, speed * most / due, "m/s", -1});
    pipe.travelled = std::min(pipe.travelled + due, most);
    for (; pipe.travelled >= pitch; pipe.travelled -= pitch) cross(job, pipe, pipe.travelled - pitch, living);
    if (living + static_cast<double>(mouth.places.size()) > job.most)
      empty(solver, pipe);
    else
      fill(job, pipe);
  }
  settle(solver);
}

}  // namespace ps
