// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/scenestate.h"

#include "core/base/error.h"
#include "core/base/statestream.h"
#include "core/plugin_host/registry.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

bool has(const std::vector<std::string>& ids, const std::string& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

std::string nameOf(const std::string& title) { return title.empty() ? "a project without a title" : "'" + title + "'"; }

}  // namespace

void SceneState::save(StateWriter& writer) const {
  const std::string words[] = {title, thermalModel};
  writer.texts("scene/words", words);
  writer.value("scene/spacing", spacing);
  writer.texts("scene/materials", materials);
  writer.texts("scene/bodies", bodies);
  writer.texts("scene/body_names", bodyNames);
  writer.texts("scene/constraints", constraints);
  writer.array("scene/fixed_bodies", fixedBodies);
  writer.open("scene/start", StateType::Float64, 3 * start.size());
  for (const Vector3& place : start) {
    for (const double c : place) writer.put(c);
  }
  writer.close();
  rest.save(writer);
}

SceneState SceneState::read(const StateReader& reader) {
  SceneState state;
  const std::vector<std::string> words = reader.texts("scene/words");
  if (words.size() != 2) StateReader::fail("scene/words", "has " + std::to_string(words.size()) + " texts, not 2");
  state.title = words[0], state.thermalModel = words[1];
  state.spacing = reader.value<double>("scene/spacing");
  if (!(state.spacing > 0) || !std::isfinite(state.spacing))
    StateReader::fail("scene/spacing", "is no positive number");
  state.materials = reader.texts("scene/materials");
  state.bodies = reader.texts("scene/bodies");
  state.bodyNames = reader.texts("scene/body_names");
  state.constraints = reader.texts("scene/constraints");
  state.fixedBodies = reader.array<uint8_t>("scene/fixed_bodies");
  for (const size_t count : {state.bodyNames.size(), state.fixedBodies.size()}) {
    if (count > state.bodies.size()) StateReader::fail("scene/bodies", "has fewer bodies than it counts");
  }
  const std::vector<uint32_t> bodyOf = reader.array<uint32_t>("field/body");
  if (std::any_of(bodyOf.begin(), bodyOf.end(), [&](uint32_t body) { return body >= state.bodies.size(); }))
    StateReader::fail("field/body", "names a body that there is not");
  const std::vector<double> places = reader.array<double>("scene/start");
  if (places.size() % 3 != 0) StateReader::fail("scene/start", "is not made of places");
  for (size_t k = 0; k < places.size(); k += 3) state.start.push_back({places[k], places[k + 1], places[k + 2]});
  state.rest = RestPlaces::read(reader);
  return state;
}

std::vector<SceneMaterial> materialsInOrder(const SceneState& state, const StateReader& reader,
                                            const Project& project) {
  const std::vector<uint32_t> used = reader.array<uint32_t>("field/material");
  std::vector<SceneMaterial> ordered;
  for (size_t k = 0; k < state.materials.size(); ++k) {
    const auto found = std::find_if(project.materials.begin(), project.materials.end(),
                                    [&](const SceneMaterial& m) { return m.id == state.materials[k]; });
    if (found != project.materials.end()) {
      ordered.push_back(*found);
      continue;
    }
    // What nothing is of any more may have left; the numbers of those behind it would change.
    const bool needed =
        k + 1 < state.materials.size() || std::any_of(used.begin(), used.end(), [&](uint32_t m) { return m == k; });
    if (needed) {
      throw InputError("the state has the material '" + state.materials[k] +
                       "', which the project has not; add it again, or start without the state");
    }
  }
  for (const SceneMaterial& material : project.materials) {
    if (!has(state.materials, material.id)) ordered.push_back(material);
  }
  return ordered;
}

void requireGoesOn(const SceneState& state, const Project& project, const PluginRegistry& plugins) {
  if (project.solver.thermalModel != state.thermalModel) {
    const auto named = [](const std::string& model) { return model.empty() ? "none" : "'" + model + "'"; };
    throw InputError("the state is of the thermal model " + named(state.thermalModel) + ", and the project's is " +
                     named(project.solver.thermalModel));
  }
  for (const std::string& plugin : state.constraints) {
    if (!plugins.constraint(plugin))
      throw InputError("the state needs the constraint plugin '" + plugin + "', which is not installed");
  }
}

void requireOwners(const SceneState& state, const StateReader& reader, const Project& project) {
  std::vector<bool> hasMatter(state.bodies.size());
  for (const uint32_t body : reader.array<uint32_t>("field/body")) hasMatter[body] = true;
  const auto isOf = [](const std::string& id) { return [&id](const auto& item) { return item.id == id; }; };
  for (size_t k = 0; k < state.bodies.size(); ++k) {
    const std::string& id = state.bodies[k];
    if (hasMatter[k] && std::none_of(project.bodies.begin(), project.bodies.end(), isOf(id)) &&
        std::none_of(project.emitters.begin(), project.emitters.end(), isOf(id)))
      throw InputError("the state has matter of '" + id + "', which has gone");
  }
}

void requireOfProject(const StateReader& reader, const Project& project) {
  const SceneState state = SceneState::read(reader);
  if (state.title != project.title)
    throw InputError("the state is of " + nameOf(state.title) + ", not of " + nameOf(project.title));
  for (const Body& body : project.bodies) {
    if (!has(state.bodies, body.id))
      throw InputError("the state is of another project: it knows nothing of the body '" + body.id + "'");
  }
}

}  // namespace ps
