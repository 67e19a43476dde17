// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/solver/solver.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace ps {

class PluginRegistry;
class ShapeSurfaces;

// What a project's parts mean to the solver. Pure functions, one per part, so that an edit recompiles what it touched.

SolverSettings compileSettings(const Project& project);
ThermalSettings compileThermal(const Project& project);
std::vector<Wall> compileWalls(const Project& project);
Bounds compileBounds(const Project& project);

/// What a plugin gave a scene's material.
struct EvaluatedMaterial {
  std::string base;         ///< the plugin's id
  ParameterSet parameters;  ///< the plugin's own
  Material material;        ///< without the scene's changes
};
using EvaluatedMaterials = std::map<std::string, EvaluatedMaterial>;  ///< by SceneMaterial::id

/// One of the scene's materials. One whose base is not installed gets the catalogue's defaults: its bodies stand still.
/// `evaluated` is kept up to date, and stands in for a plugin that has failed since: matter does not change its
/// substance. Throws InputError when values contradict each other (a solidus above the liquidus), PluginError when a
/// plugin fails, or has failed and its parameters are others now.
Material compileMaterial(const Project& project, const SceneMaterial& source, const PluginRegistry& plugins,
                         EvaluatedMaterials& evaluated);
/// All of them, in order.
std::vector<Material> compileMaterials(const Project& project, const PluginRegistry& plugins);
/// Index of a scene material by id; throws InputError naming the body that refers to it.
uint32_t materialIndex(const Project& project, const std::string& material, const std::string& body);
/// Whether everything a body needs is installed; a body that lacks something stands still as a placeholder.
bool isPlaceholder(const Project& project, const Body& body, const PluginRegistry& plugins);

/// Whether its matter stands still until it is let go.
bool isHeld(const Body& body);
/// Particles to be, with the colour of their own (see colourNumber(); 0: none) that the store gets beside them.
struct ColouredSpawn : Spawn {
  uint32_t colour = 0;
};

/// The particles of a body at the start, one batch per palette entry, pinned ones before those that move; Spawn::body
/// and the constraints are the engine's to set. `materials`: the scene's, baked.
std::vector<ColouredSpawn> compileBody(const Project& project, const PluginRegistry& plugins,
                                       std::span<const BakedMaterial> materials, const Body& body);
/// How a fixed body moves; none of others.
BodyMotion compileMotion(const Body& body, double spacing);
/// Heat that each body is given, by the index that its particles carry; bodies that have left the project get none.
/// `fixed`: 1 for those whose matter was made fixed, by the same index; what the project says acts at the next reset.
/// `surfaces` knows those that have been measured.
std::vector<BodyHeat> compileHeating(const Project& project, const std::vector<std::string>& bodyIds,
                                     std::span<const uint8_t> fixed, ShapeSurfaces& surfaces);
/// One batch of a sketched body's cells, filled with particles of `spacing` m.
ColouredSpawn compileCells(const Project& project, const PluginRegistry& plugins,
                           std::span<const BakedMaterial> materials, const Body& body, int palette,
                           const std::vector<std::array<int, 3>>& cells, double spacing);

/// One layer of an emitter's jet, the places of its Mouth for particles `spacing` m apart, `offset` m down the jet.
Spawn compileLayer(const Project& project, std::span<const BakedMaterial> materials, const Emitter& emitter,
                   double spacing, double offset);

}  // namespace ps
