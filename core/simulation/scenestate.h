// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/simulation/restplaces.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ps {

class PluginRegistry;
class StateReader;
class StateWriter;

/// What an engine's state says of the scene: who is meant by the numbers that particles carry, and what must be there
/// for the state to go on.
struct SceneState {
  std::string title, thermalModel;
  double spacing = 0;                          ///< m, of the particles
  std::vector<std::string> materials, bodies;  ///< ids, by the index that particles carry
  std::vector<std::string> bodyNames;          ///< for messages, by the same index
  std::vector<std::string> constraints;        ///< plugins, in the order in which they came to the scene
  std::vector<uint8_t> fixedBodies;            ///< 1 for bodies that were born fixed
  std::vector<Vector3> start;                  ///< m, places at the start by the particles' ids, for probes of regions
  RestPlaces rest;                             ///< of sketches

  void save(StateWriter& writer) const;
  /// Throws InputError for what is damaged.
  static SceneState read(const StateReader& reader);
};

/// The materials of a project in the order of a state, those that came later behind. Throws InputError where matter of
/// the state is of a material that the project has not.
std::vector<SceneMaterial> materialsInOrder(const SceneState& state, const StateReader& reader, const Project& project);
/// Throws InputError, saying what is missing, where a project with these plugins cannot go on from a state.
void requireGoesOn(const SceneState& state, const Project& project, const PluginRegistry& plugins);
/// Throws InputError where matter of a state would be nobody's: what an emitter has poured that is gone.
void requireOwners(const SceneState& state, const StateReader& reader, const Project& project);
/// Throws InputError for the state of another project: of another title, or without one of its bodies.
void requireOfProject(const StateReader& reader, const Project& project);

}  // namespace ps
