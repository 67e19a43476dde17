// SPDX-License-Identifier: Apache-2.0
// How a scene is made of a project.
#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/base/progress.h"
#include "core/plugin_host/registry.h"
#include "core/scene/shownname.h"
#include "core/simulation/compile.h"
#include "core/simulation/engineimpl.h"
#include "core/simulation/lattice.h"
#include "core/simulation/measure.h"
#include "core/simulation/rules.h"
#include "core/simulation/sceneneed.h"
#include "core/simulation/sceneproblem.h"
#include "core/simulation/truesurface.h"

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

namespace ps {
namespace {

/// Of a scene that is made, by the weights of its stages.
double workOf(const Project& project, const PluginRegistry& plugins) {
  double work = 0;
  for (const Body& body : project.bodies) {
    const auto tied = std::count_if(body.constraints.begin(), body.constraints.end(), [&](const BodyConstraint& c) {
      const auto form = plugins.constraintForm(c.plugin);
      return form && !std::holds_alternative<const api::NeighbourPlugin*>(*form);
    });
    const double each = 1 + kMakingWeight + (tied > 0 ? 1 : 0) + kTyingWeight * static_cast<double>(tied);
    work += each * particleCount(body, scaleOf(project).spacing);
  }
  return work;
}

/// Whether a probe sees what stood in its box at the start.
bool asksForStart(const Project& project) {
  return std::any_of(project.probes.begin(), project.probes.end(),
                     [](const Probe& probe) { return probe.region && probe.regionWhen != Probe::kNow; });
}

constexpr double kNowhere = 1e9;  ///< m, of a particle that has gone

}  // namespace

void Engine::Impl::build() {
  const double count = particleCount(project);
  requireRelations(project, plugins);
  requirePeriods(project);
  requireRoom(project, plugins, memoryNow());
  prepare(compileSettings(project).spacing, {});
  const bool regions = asksForStart(project);
  const Bounds bounds = compileBounds(project);
  OccupiedPlaces occupied(kOverlap * spacing, static_cast<size_t>(count),
                          Period(bounds.minimum, bounds.maximum, bounds.periodic));
  std::vector<std::pair<ColouredSpawn, const Body*>> spawns;
  if (t_progress) t_progress->expect(workOf(project, plugins));
  beginStage("Placing particles", count, 3 * count);
  for (const Body& body : project.bodies) {
    bodyIndex(body.id);  // of one without particles too
    size_t dropped = 0;
    for (ColouredSpawn& spawn : compileBody(project, plugins, tables.tables(), body)) {
      dropped += dropOccupied(spawn, occupied);
      spawns.emplace_back(std::move(spawn), &body);
    }
    if (dropped > 0) {
      log(LogLevel::Warning, "body '" + shownName(body) + "': left out " + std::to_string(dropped) +
                                 " particles whose places are taken; move it away from what it overlaps");
    }
  }
  // What is held in place first, wherever it stands in the list: a rope is tied to the posts that are there.
  std::stable_partition(spawns.begin(), spawns.end(), [](const auto& item) { return item.first.fixed; });
  std::vector<uint32_t> packed;
  for (auto& [spawn, body] : spawns) {
    for (size_t k = 0; regions && k < spawn.position.size(); ++k) {
      start.push_back({spawn.position[k].x, spawn.position[k].y, spawn.position[k].z});
    }
    advance(0);
    const bool isPacked = spawn.packed;
    const std::vector<uint32_t> ids = born(std::move(spawn), *body);
    if (isPacked) packed.insert(packed.end(), ids.begin(), ids.end());
    surfaces.note(solver->particles(), ids, *body, spacing);
    if (hasTrueSurface(*body)) noteTrueSurface(solver->particles(), ids, *body, spacing);
  }
  setShapes();
  solver->settle(packed);
  for (const Emitter& emitter : project.emitters) bodyIndex(emitter.id);
  recompile({{Owner::Body}});  // what is said of bodies goes by their indices
  bindTracks(solver->time());
}

void Engine::Impl::noteStart() {
  if (!start.empty() || solver->time() > 0 || !asksForStart(project)) return;
  const ParticleStore& store = solver->particles();
  for (size_t i = 0; i < store.size(); ++i) {
    const size_t id = store.id()[i];
    if (id >= start.size()) start.resize(id + 1, Vector3::Constant(kNowhere));
    start[id] = vectorOf(store.position()[i]);
  }
}

void Engine::Impl::nameProbes() {
  probeNames.clear();
  for (const Probe& probe : project.probes) probeNames.push_back(probeTitle(probe, fields));
  measured = std::make_shared<const std::vector<Probe>>(project.probes);
}

}  // namespace ps
