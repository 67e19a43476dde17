// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/engine.h"

#include "core/base/error.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/compile.h"
#include "core/simulation/lattice.h"
#include "core/simulation/measure.h"

#include <algorithm>
#include <atomic>

namespace ps {
namespace {

/// Builds are counted over the whole process, so that snapshots of two engines never pass for the same run.
uint64_t nextRevision() {
  static std::atomic<uint64_t> count{0};
  return ++count;
}

}  // namespace

struct Engine::Impl {
  Impl(const Project& source, PluginRegistry& registry) : project(source), plugins(registry) {}

  void build();
  void recompile(const std::string& owner);
  void recompileAll();
  void bakeMaterials();
  void setThermal();
  uint32_t constraintSet(const std::string& plugin, const ParameterSet& parameters);
  std::vector<uint32_t> born(Spawn spawn, const Body& body);

  Project project;
  PluginRegistry& plugins;
  std::unique_ptr<Solver> solver;
  std::vector<BakedMaterial> materials;
  std::map<std::string, uint32_t> constraintSets;  // one per plugin: structure may join matter of any two bodies
  std::vector<std::array<float, 3>> colours;
  std::shared_ptr<const std::vector<std::string>> bodyIds;
  std::vector<std::string> probeNames;
  StepReport lastReport;
  uint64_t revision = 0;
  double spacing = 0;  ///< of the particles that live; the project's acts at the next reset
};

void Engine::Impl::bakeMaterials() {
  const double pressure = compileThermal(project).ambientPressure;
  std::vector<BakedMaterial> baked;
  colours.clear();
  for (const Material& material : compileMaterials(project, plugins)) {
    baked.emplace_back(material, pressure);
    std::array<float, 3> colour{};
    for (size_t c = 0; c < 3; ++c) {
      constexpr const char* kKeys[] = {"color_red", "color_green", "color_blue"};
      colour[c] = static_cast<float>(baked.back().property(kKeys[c], 293.15));
    }
    colours.push_back(colour);
  }
  materials = baked;
  solver->setMaterials(std::move(baked));
}

void Engine::Impl::setThermal() {
  const api::ThermalPlugin* model = plugins.thermal(project.solver.thermalModel);
  if (!model && !project.solver.thermalModel.empty() && plugins.has(project.solver.thermalModel)) {
    throw InputError("solver: '" + project.solver.thermalModel + "' is not a thermal model");
  }
  std::vector<double> parameters;
  if (model) parameters = numbersOf(project.solver.thermalParameters, model->parameters());
  solver->setThermal(compileThermal(project), model, std::move(parameters));
}

uint32_t Engine::Impl::constraintSet(const std::string& id, const ParameterSet& parameters) {
  if (const auto found = constraintSets.find(id); found != constraintSets.end()) return found->second;
  const api::ConstraintPlugin* plugin = plugins.constraint(id);
  const uint32_t set = solver->addConstraintSet(plugin, id, numbersOf(parameters, plugin->parameters()));
  constraintSets.emplace(id, set);
  return set;
}

std::vector<uint32_t> Engine::Impl::born(Spawn spawn, const Body& body) {
  if (!spawn.fixed) {
    for (const BodyConstraint& c : body.constraints) {
      if (plugins.constraint(c.plugin)) spawn.constraintSets.push_back(constraintSet(c.plugin, c.parameters));
    }
  }
  return solver->spawn(spawn);
}

void Engine::Impl::build() {
  solver = std::make_unique<Solver>();
  constraintSets.clear();
  lastReport = {};
  revision = nextRevision();
  spacing = compileSettings(project).spacing;
  solver->setSettings(compileSettings(project));
  solver->setBounds(compileBounds(project));
  solver->setWalls(compileWalls(project));
  bakeMaterials();
  setThermal();
  std::vector<std::string> ids;
  for (size_t b = 0; b < project.bodies.size(); ++b) {
    for (Spawn& spawn : compileBody(project, plugins, materials, b)) born(std::move(spawn), project.bodies[b]);
    ids.push_back(project.bodies[b].id);
  }
  bodyIds = std::make_shared<const std::vector<std::string>>(std::move(ids));
  probeNames.clear();
  for (const Probe& probe : project.probes) probeNames.push_back(probeTitle(probe));
}

void Engine::Impl::recompile(const std::string& owner) {
  if (owner == "material") bakeMaterials();
  if (owner == "wall") solver->setWalls(compileWalls(project));
  if (owner == "solver") {
    SolverSettings settings = compileSettings(project);
    settings.spacing = spacing;
    solver->setSettings(settings);
  }
  if (owner == "environment") bakeMaterials();  // pressure moves melting and boiling points
  if (owner == "environment" || owner == "solver" || owner == "thermal") setThermal();
  if (owner == "constraint") {
    for (const Body& body : project.bodies) {
      for (const BodyConstraint& c : body.constraints) {
        const auto set = constraintSets.find(c.plugin);
        const api::ConstraintPlugin* plugin = plugins.constraint(c.plugin);
        if (set == constraintSets.end() || !plugin) continue;
        solver->setConstraintParameters(set->second, numbersOf(c.parameters, plugin->parameters()));
      }
    }
  }
}

void Engine::Impl::recompileAll() {
  solver->setBounds(compileBounds(project));
  for (const char* owner : {"wall", "solver", "environment", "constraint"}) recompile(owner);
}

Engine::Engine(const Project& project, PluginRegistry& plugins) : m(std::make_unique<Impl>(project, plugins)) {
  m->build();
}
Engine::~Engine() = default;

StepReport Engine::step() {
  m->lastReport = m->solver->step();
  return m->lastReport;
}

void Engine::reset() { m->build(); }

void Engine::update(const Project& project) {
  const Project before = m->project;
  // Particles carry indices of bodies and materials: as long as they live, a body keeps its place.
  Project next = project;
  const auto sameId = [](const auto& a, const auto& b) { return a.id == b.id; };
  const bool keepsMaterials =
      next.materials.size() >= before.materials.size() &&
      std::equal(before.materials.begin(), before.materials.end(), next.materials.begin(), sameId);
  if (!keepsMaterials) {
    m->project = std::move(next);
    m->build();
    return;
  }
  m->project = std::move(next);
  try {
    m->recompileAll();
  } catch (const Error&) {
    m->project = before;
    m->recompileAll();
    throw;
  }
}

bool Engine::setParameter(const Address& address, const Value& value) {
  ParameterSet* set = findSet(m->project, address);
  if (!set) return false;
  const ParameterSet before = *set;
  set->values[address.key] = value;
  if (address.owner == "body" || address.key == "particle_spacing") return false;
  try {
    m->recompile(address.owner);
  } catch (const Error&) {
    *findSet(m->project, address) = before;
    m->recompile(address.owner);
    throw;
  }
  return true;
}

std::vector<uint32_t> Engine::addCells(const Body& body, const std::vector<std::array<int, 3>>& cells, int palette) {
  size_t index = 0;
  while (index < m->project.bodies.size() && m->project.bodies[index].id != body.id) ++index;
  if (index == m->project.bodies.size()) {
    m->project.bodies.push_back(body);
    auto ids = *m->bodyIds;
    ids.push_back(body.id);
    m->bodyIds = std::make_shared<const std::vector<std::string>>(std::move(ids));
  } else {
    m->project.bodies[index] = body;
  }
  Spawn spawn = compileCells(m->project, m->plugins, m->materials, index, palette, cells, m->spacing);
  spawn.position = freePositions(m->solver->particles(), spawn.position, 0.9 * m->spacing);
  if (spawn.position.empty()) return {};
  return m->born(std::move(spawn), body);
}

void Engine::removeParticles(const std::vector<uint32_t>& ids) { m->solver->remove(ids); }
TakenMatter Engine::takeParticles(const std::vector<uint32_t>& ids) { return m->solver->take(ids); }
void Engine::putBack(const TakenMatter& matter) { m->solver->putBack(matter); }

std::vector<uint32_t> Engine::particlesIn(const VoxelShape& lattice,
                                          const std::vector<std::array<int, 3>>& cells) const {
  return idsInCells(m->solver->particles(), lattice, cells);
}

SnapshotPtr Engine::snapshot() const {
  auto snapshot = std::make_shared<Snapshot>();
  snapshot->stats = stats();
  snapshot->revision = m->revision;
  snapshot->spacing = m->spacing;
  snapshot->flags = m->lastReport.flags;
  snapshot->message = m->lastReport.message;
  snapshot->limits = m->solver->limits();
  snapshot->bodyIds = m->bodyIds;
  snapshot->materialColour = m->colours;
  fillSnapshot(*snapshot, *m->solver);
  return snapshot;
}

FrameStats Engine::stats() const {
  FrameStats stats = measure(*m->solver, m->lastReport);
  for (const Probe& probe : m->project.probes) {
    stats.probes.push_back(measureProbe(*m->solver, m->project, probe));
  }
  return stats;
}

const Project& Engine::project() const { return m->project; }
Solver& Engine::solver() { return *m->solver; }
const std::vector<std::string>& Engine::probeNames() const { return m->probeNames; }

}  // namespace ps
