// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/engineimpl.h"

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/base/progress.h"
#include "core/plugin_host/registry.h"
#include "core/scene/pose.h"
#include "core/simulation/compile.h"
#include "core/simulation/declared.h"
#include "core/simulation/edits.h"
#include "core/simulation/measure.h"
#include "core/simulation/rules.h"
#include "core/simulation/sceneneed.h"
#include "core/simulation/sceneproblem.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

namespace ps {

uint64_t nextRevision() {
  static std::atomic<uint64_t> count{0};
  return ++count;
}

namespace {

/// Whether it may change how many particles there are, or what each of them takes.
bool resizes(const Project& project, const PluginRegistry& plugins, const Address& address) {
  const api::ParameterDeclaration* declaration = declarationOf(project, &plugins, address);
  const bool reach = address.owner == Owner::Solver && address.key == "support_ratio";
  return reach || (declaration && declaration->actsAt == api::ActsAt::NextReset);
}

/// The bodies whose shapes these edits may move, as they are before.
std::vector<Body> movedBy(const Project& project, std::span<const SetParameter> edits) {
  std::vector<Body> bodies;
  std::copy_if(project.bodies.begin(), project.bodies.end(), std::back_inserter(bodies), [&](const Body& body) {
    return std::any_of(edits.begin(), edits.end(), [&](const SetParameter& edit) {
      return edit.address.owner == Owner::Shape && edit.address.id == body.id;
    });
  });
  return bodies;
}

auto byId(const std::vector<SceneMaterial>& materials, const std::string& id) {
  return std::find_if(materials.begin(), materials.end(), [&](const SceneMaterial& m) { return m.id == id; });
}

}  // namespace

void Engine::Impl::bakeMaterials(const std::string& only) {
  // What has melted may freeze far from what held it.
  if (tables.update(project, plugins, *solver, only) && tables.anyMelts()) holdFrozen();
}

void Engine::Impl::holdFrozen() {
  if (const std::string id = frozenStructure(plugins); !id.empty()) constraintSet(id);
}

void Engine::Impl::setThermal() {
  const api::ThermalPlugin* model = plugins.thermal(project.solver.thermalModel);
  if (!model && !project.solver.thermalModel.empty() && plugins.has(project.solver.thermalModel)) {
    throw InputError("solver: '" + project.solver.thermalModel + "' is not a thermal model");
  }
  std::vector<double> parameters;
  if (model) parameters = numbersOf(project.solver.thermalParameters, plugins.parameters(project.solver.thermalModel));
  ThermalSettings settings = compileThermal(project);
  settings.surfaceArea.assign(bodyIds->size(), 0);
  for (const Body& body : project.bodies) {
    const auto found = std::find(bodyIds->begin(), bodyIds->end(), body.id);
    if (found == bodyIds->end()) continue;
    settings.surfaceArea[static_cast<size_t>(found - bodyIds->begin())] =
        numberOf(body.parameters, bodyParameters(), "surface_area");
  }
  solver->setThermal(settings, model, project.solver.thermalModel, std::move(parameters));
  std::vector<HeatSource> sources;
  for (const UsedHeatSource& source : project.solver.heatSources) {
    if (const api::HeatSourcePlugin* plugin = plugins.heatSource(source.plugin))
      sources.push_back({plugin, source.plugin, numbersOf(source.parameters, plugins.parameters(source.plugin))});
  }
  solver->setHeatSources(std::move(sources));
}

uint32_t Engine::Impl::constraintSet(const std::string& id) {
  if (const auto found = constraintSets.find(id); found != constraintSets.end()) return found->second;
  const uint32_t set = solver->addConstraintSet(*plugins.constraintForm(id), id, numbersOf({}, plugins.parameters(id)));
  constraintSets.emplace(id, set);
  return set;
}

uint32_t Engine::Impl::bodyIndex(const std::string& id) {
  const auto found = std::find(bodyIds->begin(), bodyIds->end(), id);
  const auto index = static_cast<uint32_t>(found - bodyIds->begin());
  if (found == bodyIds->end()) {
    std::vector<std::string> ids = *bodyIds;  // snapshots hold the list that was
    ids.push_back(id);
    bodyIds = std::make_shared<const std::vector<std::string>>(std::move(ids));
  }
  return index;
}

std::vector<uint32_t> Engine::Impl::born(Spawn spawn, const std::string& id, const std::string& name) {
  spawn.body = bodyIndex(id);
  bodyNames.resize(bodyIds->size());
  bodyNames[spawn.body] = name.empty() ? id : name;
  solver->setBodyNames(bodyNames);
  return solver->spawn(spawn);
}

std::vector<uint32_t> Engine::Impl::born(ColouredSpawn spawn, const Body& body, const RigidMove& way) {
  if (toggleOf(body.parameters, bodyParameters(), "fixed")) {
    const uint32_t index = bodyIndex(body.id);
    fixedBodies.resize(bodyIds->size());
    fixedBodies[index] = 1;
    solver->setMotion(index, compileMotion(body, spacing));
  }
  if (!spawn.fixed) {
    for (const BodyConstraint& c : body.constraints) {
      if (!plugins.constraint(c.plugin)) continue;
      const uint32_t set = constraintSet(c.plugin);
      solver->setConstraintParameters(set, bodyIndex(body.id), numbersOf(c.parameters, plugins.parameters(c.plugin)));
      spawn.constraintSets.push_back(set);
    }
  }
  const uint32_t colour = spawn.colour;
  const auto* voxels = std::get_if<VoxelShape>(&body.shape);
  const std::vector<api::Double3> places = voxels ? spawn.position : std::vector<api::Double3>{};
  std::vector<uint32_t> ids = born(Spawn(std::move(spawn)), body.id, body.name);
  if (voxels) noteRest(*voxels, way, ids, places);
  if (colour != 0) giveColour(solver->particles(), ids, colour);
  return ids;
}

/// Emitters and sinks, after a frame.
void Engine::Impl::exchangeMatter() {
  flow.drain(*solver, project);
  const auto bodyOf = [this](const Emitter& emitter) { return bodyIndex(emitter.id); };
  const auto birth = [this](Spawn spawn, const Emitter& emitter) {
    const SceneMaterial& material = project.materials[spawn.material];
    if (!plugins.material(material.base) || !mayPour(spawn.position.size())) return std::vector<uint32_t>{};
    return born(std::move(spawn), emitter.id, emitter.name);
  };
  flow.pour(*solver, project, tables.tables(), spacing, compileSettings(project).dt, bodyOf, birth);
}

void Engine::Impl::watchForces() {
  std::vector<uint32_t> walls, bodies;
  const auto watch = [](std::vector<uint32_t>& list, const auto& all, const auto& is) {
    const auto index = static_cast<uint32_t>(std::find_if(all.begin(), all.end(), is) - all.begin());
    if (index < all.size() && std::find(list.begin(), list.end(), index) == list.end()) list.push_back(index);
  };
  for (const Probe& probe : project.probes) {
    if (!isForce(probe.quantity)) continue;
    if (!probe.wall.empty())
      watch(walls, project.environment.walls, [&](const SceneWall& wall) { return wall.id == probe.wall; });
    else
      watch(bodies, *bodyIds, [&](const std::string& id) { return id == probe.body; });
  }
  for (const uint32_t index : tools.bodies()) {
    if (std::find(bodies.begin(), bodies.end(), index) == bodies.end()) bodies.push_back(index);
  }
  solver->watchForces(walls, bodies);
  solver->measureBalance(measuresBalance);
}

Project Engine::Impl::document() const {
  Project source = project;
  overlay.liftFrom(source);
  std::vector<SceneMaterial> ordered;
  for (const std::string& id : materialOrder) ordered.push_back(*byId(source.materials, id));
  source.materials = std::move(ordered);
  return source;
}

void Engine::Impl::prepare(double livingSpacing, const std::vector<std::string>& constraints) {
  solver = std::make_unique<Solver>();
  revision = nextRevision();
  spacing = livingSpacing;
  SolverSettings settings = compileSettings(project);
  settings.spacing = spacing;
  solver->setSettings(settings);
  solver->setBounds(compileBounds(project));
  solver->setWalls(compileWalls(project));
  for (const std::string& plugin : constraints) constraintSet(plugin);
  bakeMaterials();
  setThermal();
  measurePouring();
  nameProbes();
}

std::unique_ptr<Engine::Impl> Engine::Impl::rebuilt(const Project& source) const {
  auto next = std::make_unique<Impl>(source, plugins);
  next->tables = tables;
  next->shown = shown;
  next->build();
  return next;
}

void Engine::Impl::recompile(const Touched& touched) {
  const auto any = [&](std::initializer_list<Owner> owners) {
    return std::any_of(owners.begin(), owners.end(), [&](Owner owner) { return touched.owners.count(owner) > 0; });
  };
  if (touched.allMaterials) bakeMaterials();
  for (const std::string& id : touched.materials) bakeMaterials(id);
  if (any({Owner::Wall})) solver->setWalls(compileWalls(project));
  if (any({Owner::Solver, Owner::Environment})) {  // wind and drag are the environment's
    SolverSettings settings = compileSettings(project);
    settings.spacing = spacing;
    solver->setSettings(settings);
  }
  if (any({Owner::Environment, Owner::Solver, Owner::Thermal, Owner::HeatSource, Owner::Body})) setThermal();
  if (any({Owner::Body})) {
    lead();
    setShapes();
    fill = fillLimit(project, spacing);
    solver->setHeating(compileHeating(project, *bodyIds, fixedBodies, surfaces));
  }
  if (any({Owner::Constraint})) setConstraints();
}

void Engine::Impl::setShapes() {
  std::vector<FixedShape> shapes;
  for (const Body& body : project.bodies) {
    const auto found = std::find(bodyIds->begin(), bodyIds->end(), body.id);
    if (!isFixed(body.id)) continue;  // as its matter was made: what the project says acts at the next reset
    const auto index = static_cast<uint32_t>(found - bodyIds->begin());
    if (std::optional<FixedShape> shape = surfaces.of(body, index, spacing)) shapes.push_back(std::move(*shape));
  }
  solver->setShapes(std::move(shapes));
}

void Engine::Impl::setConstraints() {
  for (const Body& body : project.bodies) {
    for (const BodyConstraint& c : body.constraints) {
      const auto set = constraintSets.find(c.plugin);
      if (set == constraintSets.end() || !plugins.constraint(c.plugin)) continue;
      solver->setConstraintParameters(set->second, bodyIndex(body.id),
                                      numbersOf(c.parameters, plugins.parameters(c.plugin)));
    }
  }
}

bool Engine::Impl::isFixed(const std::string& body) const {
  const auto index = static_cast<size_t>(std::find(bodyIds->begin(), bodyIds->end(), body) - bodyIds->begin());
  return index < fixedBodies.size() && fixedBodies[index];
}

void Engine::Impl::lead() {
  for (uint32_t index = 0; index < fixedBodies.size(); ++index) {
    if (!fixedBodies[index]) continue;
    const auto body = std::find_if(project.bodies.begin(), project.bodies.end(),
                                   [&](const Body& b) { return b.id == (*bodyIds)[index]; });
    solver->setMotion(index, body == project.bodies.end() ? BodyMotion{} : compileMotion(*body, spacing));
  }
}

void Engine::Impl::holdBodies() {
  std::vector<Hold> hold(bodyIds->size(), Hold::AsItIs);
  for (const Body& body : project.bodies) {
    const auto index = static_cast<size_t>(std::find(bodyIds->begin(), bodyIds->end(), body.id) - bodyIds->begin());
    if (index < hold.size()) hold[index] = isHeld(body) ? Hold::Held : Hold::Free;
  }
  solver->hold(hold);
}

std::vector<uint8_t> Engine::Impl::heldBodies() const {
  std::vector<uint8_t> held(bodyIds->size());
  for (const Body& body : project.bodies) {
    if (!isHeld(body)) continue;  // for each snapshot: few are, and ids are looked for one by one
    const auto index = static_cast<size_t>(std::find(bodyIds->begin(), bodyIds->end(), body.id) - bodyIds->begin());
    if (index < held.size()) held[index] = !isFixed(body.id);
  }
  return held;
}

std::vector<FieldPtr> Engine::Impl::shownFields() const {
  std::vector<FieldPtr> list;
  for (const FieldPtr& field : fields.all()) {
    if (std::find(shown.begin(), shown.end(), field->name) != shown.end()) list.push_back(field);
  }
  return list;
}

void Engine::Impl::recompileAll() {
  solver->setBounds(compileBounds(project));
  measurePouring();
  recompile({{Owner::Wall, Owner::Solver, Owner::Environment, Owner::Constraint, Owner::Body}, {}, true});
}

Engine::Engine(const Project& project, PluginRegistry& plugins) : m(std::make_unique<Impl>(project, plugins)) {
  if (project.state) openAtState();
  if (!m->solver) m->build();
}
Engine::~Engine() = default;

void Engine::measureBalance(bool on) { m->measuresBalance = on; }

StepReport Engine::step() {
  const ProgressScope unwatched(nullptr);  // who watches a run counts frames, and stops it between two
  m->flow.steer(*m->solver, m->project, compileSettings(m->project).dt);
  const uint64_t before = m->solver->frame();
  m->watchForces();
  m->named.act(*this);
  m->lastReport = m->solver->step();
  for (const PluginFault& fault : m->lastReport.faults) m->plugins.fault(fault.plugin, fault.what);
  if (m->solver->frame() > before) {  // not of a frame that was taken back
    m->tools.measure(*m->solver, m->spacing);
    m->exchangeMatter();
    m->followTracks(m->solver->time());
  }
  return m->lastReport;
}

std::vector<PluginFault> Engine::lateFaults() {
  (void)m->solver->limits();
  (void)m->solver->elasticEnergy();
  (void)m->solver->thermalEnergy();
  std::vector<PluginFault> faults = m->solver->drainFaults();
  for (const PluginFault& fault : faults) m->plugins.fault(fault.plugin, fault.what);
  return faults;
}

void Engine::reset() { m = m->rebuilt(m->document()); }

void Engine::update(const Project& project) {
  Project next = project;
  next.materials = inTheirPlaces(m->project.materials, project.materials);
  const Project before = std::exchange(m->project, std::move(next));
  const TrackOverlay overlay = std::exchange(m->overlay, {});
  try {
    Touched all;  // is compiled
    m->bindOverlay(all);
    m->recompileAll();
    m->followTracks(m->solver->time());
    m->holdBodies();
  } catch (...) {
    m->project = before;
    m->overlay = overlay;
    m->recompileAll();
    throw;
  }
  m->materialOrder = idsOf(project.materials);
  m->nameProbes();
  m->flow.steer(*m->solver, m->project, compileSettings(m->project).dt);
}

bool Engine::setParameter(const Address& address, const Value& value) {
  const SetParameter edit{address, value};
  return setParameters({&edit, 1});
}

bool Engine::setParameters(std::span<const SetParameter> edits) {
  std::vector<UndoEdit> undo;
  bool now = true;
  const std::vector<Body> standing = movedBy(m->project, edits);
  const bool resized = std::any_of(edits.begin(), edits.end(), [this](const SetParameter& edit) {
    return resizes(m->project, m->plugins, edit.address);
  });
  const double before = resized ? needOf(m->project, &m->plugins).bytes : 0;
  const auto write = [&](Touched& touched) {
    for (const SetParameter& edit : edits) {
      const std::optional<api::ActsAt> when = writeValue(m->project, m->plugins, edit, touched, undo);
      now = now && (when == api::ActsAt::NextFrame || when == api::ActsAt::WithItsMatter ||
                    (when == api::ActsAt::NextFrameIfFixed && m->isFixed(edit.address.id)));
    }
    if (resized && needOf(m->project, &m->plugins).bytes > before) requireRoom(m->project, m->plugins, memoryNow());
  };
  m->changeBeneath(write, [&] {
    for (auto step = undo.rbegin(); step != undo.rend(); ++step) (*step)(m->project);
  });
  for (const Body& from : standing) {
    const auto to = std::find_if(m->project.bodies.begin(), m->project.bodies.end(),
                                 [&](const Body& body) { return body.id == from.id; });
    if (const auto move = moveBetween(from, *to)) m->carry(from, *move);
  }
  return now;
}

void Engine::apply(const Command& command) {
  if (const auto* edit = std::get_if<SetParameter>(&command)) {
    setParameters({edit, 1});
  } else if (const auto* whole = std::get_if<UpdateProject>(&command)) {
    update(*whole->project);
  } else if (const auto* animated = std::get_if<SetTracks>(&command)) {
    setTracks(animated->tracks);
  } else if (const auto* moved = std::get_if<MoveBody>(&command)) {
    moveBody(*moved->body, moved->move, moved->led);
  } else if (const auto* passed = std::get_if<PassMatter>(&command)) {
    passMatter(*passed);
  } else if (const auto* measured = std::get_if<SetProbes>(&command)) {
    m->project.probes = measured->probes;
    m->noteStart();
    m->nameProbes();
  } else if (const auto* start = std::get_if<Reset>(&command)) {
    reset();
    for (const NameMatter& named : start->named) m->named.apply(*this, named);
  } else if (const auto* back = std::get_if<ReturnToState>(&command)) {
    restore(*back->state);
    m->named = back->named ? back->named->inScene() : NamedMatter();
  } else if (const auto* wanted = std::get_if<ShowFields>(&command)) {
    show(wanted->names);
  } else {
    std::visit(
        [this](const auto& matter) {
          if constexpr (requires(NamedMatter & named) { named.apply(*this, matter); }) m->named.apply(*this, matter);
        },
        command);
  }
}

std::vector<Limit> Engine::limits() const {
  std::vector<Limit> all = m->solver->limits();
  for (const std::vector<Limit>& more :
       {m->flow.limits(), m->tables.limits(m->solver->particles()), m->overlay.limits()})
    all.insert(all.end(), more.begin(), more.end());
  if (m->fill) all.push_back(*m->fill);
  return all;
}

SnapshotPtr Engine::snapshot() const {
  auto snapshot = std::make_shared<Snapshot>();
  snapshot->limits = limits();  // first: edits act on what it asks
  snapshot->stats = stats();
  snapshot->revision = m->revision;
  snapshot->spacing = m->spacing;
  snapshot->flags = m->lastReport.flags;
  snapshot->knowsStart = !m->start.empty();
  snapshot->tools = m->tools.contacts(*m->bodyIds);
  for (ToolContact& hand : m->named.contacts()) snapshot->tools.push_back(std::move(hand));
  snapshot->erasedOrPainted = m->named.erasedOrPainted();
  snapshot->keptForUndo = m->named.bytes();
  snapshot->bodyIds = m->bodyIds;
  snapshot->rest = m->rest;
  snapshot->heldBodies = m->heldBodies();
  snapshot->materialIds = idsOf(m->project.materials);
  snapshot->materialLook = m->tables.looks();
  fillSnapshot(*snapshot, *m->solver, m->shownFields());
  return snapshot;
}

FrameStats Engine::stats() const {
  FrameStats stats = measure(*m->solver, m->lastReport);
  stats.flow = m->flow.total();
  const ProbeView view{
      *m->solver, *m->bodyIds, m->fields, compileWalls(m->project), m->spacing, m->start, idsOf(m->project.materials)};
  for (const Probe& probe : m->project.probes) {
    stats.probes.push_back(measureProbe(view, probe));
  }
  stats.measured = m->measured;
  return stats;
}

uint64_t Engine::revision() const { return m->revision; }
const Project& Engine::project() const { return m->project; }
Project Engine::document() const { return m->document(); }
void Engine::show(const std::vector<std::string>& names) { m->shown = names; }
const Solver& Engine::solver() const { return *m->solver; }
const ParticleStore& Engine::particles() const { return m->solver->particles(); }
const ParticleFields& Engine::fields() const { return m->fields; }
uint64_t Engine::bakedTables() const { return m->tables.baked(); }
const std::vector<std::string>& Engine::bodyIds() const { return *m->bodyIds; }
const std::vector<std::string>& Engine::probeNames() const { return m->probeNames; }

}  // namespace ps
