// SPDX-License-Identifier: Apache-2.0
#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/base/statestream.h"
#include "core/simulation/engineimpl.h"
#include "core/simulation/projectstate.h"
#include "core/simulation/sceneneed.h"
#include "core/simulation/sceneproblem.h"

namespace ps {

SceneState Engine::Impl::sceneState() const {
  std::vector<std::string> constraints(constraintSets.size());
  for (const auto& [plugin, set] : constraintSets) constraints[set] = plugin;
  return {project.title,
          project.solver.thermalModel,
          spacing,
          idsOf(project.materials),
          *bodyIds,
          bodyNames,
          std::move(constraints),
          fixedBodies,
          start,
          *rest};
}

std::unique_ptr<Engine::Impl> Engine::Impl::restored(const StateReader& reader) const {
  SceneState state = SceneState::read(reader);
  const Project source = document();
  requireGoesOn(state, source, plugins);
  const double each = meanParticleBytes(source, &plugins, {state.spacing, scaleOf(source).reach});
  ps::requireRoomFor(0, static_cast<double>(reader.count("field/id")), each, memoryNow());
  auto next = std::make_unique<Impl>(source, plugins);
  next->tables = tables;
  next->shown = shown;
  next->project.materials = materialsInOrder(state, reader, source);
  next->prepare(state.spacing, state.constraints);
  next->bodyIds = std::make_shared<const std::vector<std::string>>(std::move(state.bodies));
  next->fixedBodies = std::move(state.fixedBodies);
  next->bodyNames = std::move(state.bodyNames);
  next->start = std::move(state.start);
  next->rest = std::make_shared<const RestPlaces>(std::move(state.rest));
  for (const Body& body : source.bodies) next->bodyIndex(body.id);
  for (const Emitter& emitter : source.emitters) next->bodyIndex(emitter.id);
  next->solver->setBodyNames(next->bodyNames);
  next->recompile({{Owner::Body, Owner::Constraint}});
  advance(0);
  // Before the lists are made again that follow from the state: how far they reach may have keys.
  next->bindTracks(reader.array<double>("clock/seconds", 2, 1)[0]);
  next->solver->restore(reader);
  next->lead();  // as the document says by now
  next->holdBodies();
  next->bindTracks(next->solver->time());
  next->flow.restore(reader, next->solver->particles());
  next->flow.requireLayers(next->project, next->tables.tables(), next->spacing);
  return next;
}

std::unique_ptr<Engine::Impl> Engine::Impl::restored(const ProjectState& state,
                                                     std::vector<std::string>& unread) const {
  if (const std::string why = whyStateDoesNotFit(state, document(), plugins); !why.empty()) throw InputError(why);
  if (t_progress) t_progress->expect(1);
  beginStage("Reading the state", 1, static_cast<double>(state.blocks.size()));
  const StateBuffer buffer = unpackState(state.blocks);
  const StateReader reader(buffer.bytes());
  auto next = restored(reader);
  if (next->solver->frame() != state.frame) {
    throw InputError("says frame " + std::to_string(state.frame) + ", and its blocks are of frame " +
                     std::to_string(next->solver->frame()));
  }
  unread = reader.unread();
  return next;
}

void Engine::save(StateWriter& writer) const {
  m->solver->save(writer);
  m->sceneState().save(writer);
  m->flow.save(writer);
}

Engine::Engine(const Project& document, PluginRegistry& plugins, const StateReader& state)
    : m(std::make_unique<Impl>(document, plugins)) {
  m = m->restored(state);
}

std::shared_ptr<const NamedMatter> Engine::names() const { return std::make_shared<const NamedMatter>(m->named); }
std::vector<MatterKey> Engine::hands() const { return m->named.hands(); }
void Engine::setNames(const NamedMatter& names) { m->named = names; }

void Engine::restore(const StateReader& reader) { m = m->restored(reader); }

void Engine::restore(const ProjectState& state) {
  std::vector<std::string> unread;
  m = m->restored(state, unread);
}

/// What is wrong with the state is no reason to do without the scene.
void Engine::openAtState() {
  std::vector<std::string> unread;
  try {
    m = m->restored(*m->project.state, unread);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& problem) {
    m_remarks.push_back(std::string("/state: ") + problem.what() + "; the scene opens at its start");
  }
  for (const std::string& name : unread)
    m_remarks.push_back("/state/blocks: nothing here knows the block '" + name + "'; it is kept and has no effect");
}

uint64_t Engine::stateHash() const { return savedHash(*this); }

}  // namespace ps
