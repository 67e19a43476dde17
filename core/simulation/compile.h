// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/solver/solver.h"

#include <span>
#include <string>
#include <vector>

namespace ps {

class PluginRegistry;

// What a project's parts mean to the solver. Pure functions, one per part, so that an edit recompiles what it touched.

SolverSettings compileSettings(const Project& project);
ThermalSettings compileThermal(const Project& project);
std::vector<Wall> compileWalls(const Project& project);
Bounds compileBounds(const Project& project);

/// The scene's materials in order. One whose base is not installed gets the catalogue's defaults: its bodies stand
/// still. Throws InputError when values contradict each other (a solidus above the liquidus).
std::vector<Material> compileMaterials(const Project& project, const PluginRegistry& plugins);
/// Index of a scene material by id; throws InputError naming the body that refers to it.
uint32_t materialIndex(const Project& project, const std::string& material, const std::string& body);
/// Whether everything a body needs is installed; a body that lacks something stands still as a placeholder.
bool isPlaceholder(const Project& project, const Body& body, const PluginRegistry& plugins);

/// The particles of a body at the start, one batch per palette entry. `materials`: the scene's, baked.
std::vector<Spawn> compileBody(const Project& project, const PluginRegistry& plugins,
                               std::span<const BakedMaterial> materials, size_t body);
/// One batch of a sketched body's cells, filled with particles of `spacing` m.
Spawn compileCells(const Project& project, const PluginRegistry& plugins, std::span<const BakedMaterial> materials,
                   size_t body, int palette, const std::vector<std::array<int, 3>>& cells, double spacing);

}  // namespace ps
