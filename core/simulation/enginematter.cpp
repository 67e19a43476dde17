// SPDX-License-Identifier: Apache-2.0
// What comes into a scene that runs, goes out of it, and is carried about in it.
#include "core/base/error.h"
#include "core/particles/colourfield.h"
#include "core/scene/pose.h"
#include "core/scene/shownname.h"
#include "core/simulation/compile.h"
#include "core/simulation/engineimpl.h"
#include "core/simulation/lattice.h"
#include "core/simulation/truesurface.h"
#include "core/sketch/cellset.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ps {
namespace {

/// By as much the cells of a sketch are others on its lattice: one that was never turned goes by whole ones.
Vector3 wayOnLattice(const Body& before, const Body& after) {
  const auto *from = std::get_if<VoxelShape>(&before.shape), *to = std::get_if<VoxelShape>(&after.shape);
  if (!from || !to) return Vector3::Zero();
  const auto drawn = [](const VoxelShape& voxels) {
    VoxelShape alone;
    alone.origin = voxels.origin, alone.spacing = voxels.spacing, alone.runs = voxels.runs;
    Body body;
    body.shape = std::move(alone);
    return body;
  };
  const auto move = moveBetween(drawn(*from), drawn(*to));
  return move ? move->shift : Vector3(Vector3::Zero());
}

/// Of a body, ascending.
std::vector<uint32_t> particlesOf(const ParticleStore& store, const std::vector<std::string>& bodies,
                                  const std::string& id) {
  const auto index = static_cast<uint32_t>(std::find(bodies.begin(), bodies.end(), id) - bodies.begin());
  std::vector<uint32_t> ids;
  for (size_t i = 0; i < store.size(); ++i) {
    if (store.body()[i] == index) ids.push_back(store.id()[i]);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace

void Engine::Impl::carry(const Body& from, const RigidMove& move, bool led) {
  const auto found = std::find(bodyIds->begin(), bodyIds->end(), from.id);
  if (found == bodyIds->end()) return;
  const Vector3 centre = centroidOf(from);
  const Vector3 way = move.turns() ? Vector3(move.of(centre) - centre) : move.shift;
  const auto index = static_cast<uint32_t>(found - bodyIds->begin());
  if (!led) return solver->carry(index, move.turn, way);
  solver->lead(index, move.turn, way);
  tools.add(index);
}

void Engine::moveBody(const Body& body, const RigidMove& move, bool led) {
  std::vector<Body>& bodies = m->project.bodies;
  const auto known = std::find_if(bodies.begin(), bodies.end(), [&](const Body& b) { return b.id == body.id; });
  if (known == bodies.end()) return;
  Body placed = body;
  // A log names the mesh alone, which is the body's own.
  auto* solid = std::get_if<SolidShape>(&placed.shape);
  const auto* was = std::get_if<SolidShape>(&known->shape);
  if (solid && was && !solid->mesh) solid->mesh = was->mesh;
  m->overlay.lift(m->project);
  const Body from = std::exchange(*known, std::move(placed));
  if (const Vector3 way = wayOnLattice(from, *known); !way.isZero(0)) {
    auto rest = std::make_shared<RestPlaces>(*m->rest);
    rest->shift(particlesOf(m->solver->particles(), *m->bodyIds, body.id), way);
    m->rest = std::move(rest);
  }
  m->overlay.lay(m->project);
  if (!led || !m->isFixed(body.id)) {
    m->recompile({{Owner::Body}});
    m->carry(from, move);
    return;
  }
  // Hands move often, and what else is compiled of a body does not depend on where it is.
  m->setShapes();
  m->carry(from, move, true);
  m->lead();
}

void Engine::passMatter(const PassMatter& passed) {
  const std::vector<std::string>& known = *m->bodyIds;
  const auto from = static_cast<uint32_t>(std::find(known.begin(), known.end(), passed.from) - known.begin());
  std::vector<api::Cell> list;
  for (const CellIndex& c : passed.cells) list.push_back({c[0], c[1], c[2]});
  const CellSet cells(list);
  const SketchGrid drawn{passed.lattice.origin, passed.lattice.spacing};
  const ParticleStore& store = m->solver->particles();
  std::vector<uint32_t> ids;
  for (size_t i = 0; i < store.size(); ++i) {
    if (store.body()[i] != from) continue;
    const auto rest = passed.all ? std::nullopt : m->rest->of(store.id()[i]);
    if (passed.all || (rest && cells.contains(drawn.cellAt(*rest)))) ids.push_back(store.id()[i]);
  }
  if (ids.empty()) return;
  const uint32_t to = m->bodyIndex(passed.to);
  m->fixedBodies.resize(m->bodyIds->size());
  m->fixedBodies[to] = m->fixedBodies[from];
  m->bodyNames.resize(m->bodyIds->size());
  for (const Body& body : m->project.bodies) {
    if (body.id == passed.to) m->bodyNames[to] = shownName(body);
  }
  m->solver->setBodyNames(m->bodyNames);
  m->solver->pass(ids, from, to);
  m->recompile({{Owner::Body, Owner::Constraint}});
  m->holdBodies();
}

void Engine::Impl::noteRest(const VoxelShape& voxels, const RigidMove& way, std::span<const uint32_t> ids,
                            std::span<const api::Double3> places) {
  const RigidMove back = way.after(poseOf(voxels)).inverse();
  std::vector<RestPlaces::Place> own;
  own.reserve(places.size());
  for (const api::Double3& place : places) {
    const Vector3 p = back.of(vectorOf(place));
    own.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  }
  auto known = std::make_shared<RestPlaces>(*rest);  // snapshots hold what was known
  known->add(ids, own);
  rest = std::move(known);
}

std::vector<uint32_t> Engine::addCells(const Body& body, const std::vector<std::array<int, 3>>& cells, int palette,
                                       const RigidMove& way) {
  const double edge = std::get<VoxelShape>(body.shape).spacing / m->spacing;
  m->requireRoomFor(static_cast<double>(cells.size()) * edge * edge * edge, body);
  ColouredSpawn spawn = compileCells(m->project, m->plugins, m->tables.tables(), body, palette, cells, m->spacing);
  if (!way.isNothing()) {
    for (api::Double3& place : spawn.position) place = double3Of(way.of(vectorOf(place)));
  }
  spawn.position = freePositions(m->solver->particles(), spawn.position, 0.9 * m->spacing);
  std::vector<uint32_t> ids;
  if (!spawn.position.empty()) ids = m->born(std::move(spawn), body, way);
  m->overlay.lift(m->project);
  std::vector<Body>& bodies = m->project.bodies;
  const auto known = std::find_if(bodies.begin(), bodies.end(), [&](const Body& b) { return b.id == body.id; });
  // Of each sample of a stroke the same: nothing but its matter is new then.
  const bool isAsItWas = known != bodies.end() && *known == body;
  if (known == bodies.end()) {
    bodies.push_back(body);
  } else if (!isAsItWas) {
    *known = body;
  }
  m->overlay.lay(m->project);
  if (!isAsItWas) {
    m->recompile({{Owner::Body}});
    m->bindTracks(m->solver->time());
  }
  m->holdBodies();
  return ids;
}

std::vector<uint32_t> Engine::addBody(const Body& body) {
  Project project = m->project;
  project.solver.parameters.values["particle_spacing"] = m->spacing;
  m->requireRoomFor(particleCount(body, m->spacing), body);
  std::vector<uint32_t> ids, packed;
  // What is there keeps away; the body's own particles may lie nearer, on a lattice that is pressed or packed.
  const OccupiedPlaces taken = occupiedPlaces(m->solver->particles(), 0.9 * m->spacing);
  const Period& period = m->solver->particles().period();
  OccupiedPlaces own(kOverlap * m->spacing, static_cast<size_t>(particleCount(body, m->spacing)), period);
  for (ColouredSpawn& spawn : compileBody(project, m->plugins, m->tables.tables(), body)) {
    dropOccupied(spawn, own, &taken);
    if (spawn.position.empty()) continue;
    const bool isPacked = spawn.packed;
    const std::vector<uint32_t> fresh = m->born(std::move(spawn), body);
    ids.insert(ids.end(), fresh.begin(), fresh.end());
    if (isPacked) packed.insert(packed.end(), fresh.begin(), fresh.end());
    m->surfaces.note(m->solver->particles(), fresh, body, m->spacing);
    if (hasTrueSurface(body)) noteTrueSurface(m->solver->particles(), fresh, body, m->spacing);
  }
  m->solver->settle(packed);
  m->recompile({{Owner::Body}});
  m->bindTracks(m->solver->time());
  m->holdBodies();
  return ids;
}

std::vector<std::pair<uint32_t, uint32_t>> giveColour(ParticleStore& store, const std::vector<uint32_t>& ids,
                                                      uint32_t colour) {
  store.declare(kColourField, api::FieldType::UInt32, "", "Colour of its own");
  auto* colours = static_cast<uint32_t*>(store.write(kColourField, api::FieldType::UInt32));
  std::vector<std::pair<uint32_t, uint32_t>> before;
  for (const uint32_t i : store.indicesOf(ids)) {
    if (colours[i] == colour) continue;
    before.emplace_back(store.id()[i], colours[i]);
    colours[i] = colour;
  }
  return before;
}

std::vector<uint32_t> Engine::Impl::notHeld(const std::vector<uint32_t>& ids) const {
  std::vector<uint32_t> some;
  std::copy_if(ids.begin(), ids.end(), std::back_inserter(some), [&](uint32_t id) { return !flow.holds(id); });
  return some;
}

ExtractedMatter Engine::extractParticles(const std::vector<uint32_t>& ids) {
  return m->solver->extract(m->notHeld(ids));
}
PaintedMatter Engine::paint(const std::vector<uint32_t>& ids, const std::string& material) {
  const std::vector<std::string> known = idsOf(m->project.materials);
  const auto index = static_cast<size_t>(std::find(known.begin(), known.end(), material) - known.begin());
  if (index >= m->solver->materials().size())
    throw InputError("Matter cannot be painted: the scene has no material '" + material + "'");
  return m->solver->paint(m->notHeld(ids), static_cast<uint32_t>(index));
}
void Engine::unpaint(const PaintedMatter& painted) { m->solver->unpaint(painted); }

/// Nothing moves or warms otherwise by it: the store alone hears of it.
std::vector<std::pair<uint32_t, uint32_t>> Engine::colour(const std::vector<uint32_t>& ids, uint32_t colour) {
  return giveColour(m->solver->particles(), m->notHeld(ids), colour);
}

bool Engine::addHeat(std::span<double> joules) { return m->solver->addHeat(joules); }
void Engine::addVelocities(std::span<const Vector3> change) { m->solver->addVelocities(change); }
TieChange Engine::cut(std::span<const Blade> blades, std::span<const uint8_t> isSpared) {
  return m->solver->cut(blades, isSpared);
}
TieChange Engine::weld(std::span<const Blade> balls, std::span<const uint8_t> isSpared) {
  return m->solver->weld(balls, isSpared);
}
void Engine::undo(const TieChange& change) { m->solver->undo(change); }
void Engine::redo(const TieChange& change) { m->solver->redo(change); }
void Engine::putBack(const ExtractedMatter& matter) {
  m->solver->putBack(matter);
  m->holdBodies();  // as is said by now
}

std::vector<uint32_t> Engine::particlesIn(const VoxelShape& lattice,
                                          const std::vector<std::array<int, 3>>& cells) const {
  return idsInCells(m->solver->particles(), lattice, cells);
}

}  // namespace ps
