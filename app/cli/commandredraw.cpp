// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/scene/pose.h"
#include "core/simulation/declared.h"
#include "core/sketch/redraw.h"
#include "core/sketch/stroke.h"
#include "ui/document/strokerecord.h"

#include <cstdio>

namespace ps::cli {
namespace {

constexpr OptionSpec kOptions[] = {
    {"--out", "PROJECT.json", "the project that is written"},
    {"--spacing", "M", "particle spacing in m; without it the project's own"},
};

size_t countOf(const VoxelShape& shape) {
  size_t cells = 0;
  for (const VoxelShape::Run& run : shape.runs) cells += static_cast<size_t>(run.length);
  return cells;
}

/// In the order of the bodies: as in the editor, a stroke leaves free what others hold, those that are still to be
/// drawn left out.
void redraw(Project& project, const std::string& path, double spacing, const PluginRegistry& plugins) {
  const auto brushOf = [&](const std::string& id) { return plugins.brush(id); };
  std::vector<VoxelShape> sketches;
  for (Body& body : project.bodies) {
    auto* sketch = std::get_if<VoxelShape>(&body.shape);
    sketches.push_back(sketch ? *sketch : VoxelShape{});
    if (sketch && !sketch->strokes.empty()) sketch->runs.clear();
  }
  for (size_t i = 0; i < project.bodies.size(); ++i) {
    if (sketches[i].strokes.empty()) continue;
    Body& body = project.bodies[i];
    const auto freeOf = [&](const SketchGrid& grid, const CellSet& cells) {
      std::vector<api::Cell> inside;
      for (const api::Cell& cell : cells.cells()) {
        if (isInScene(project.environment, grid, cell)) inside.push_back(cell);
      }
      VoxelShape lattice = latticeOf(sketches[i]);
      lattice.origin = grid.origin, lattice.spacing = grid.spacing;
      std::vector<api::Cell> free;
      for (const auto& [x, y, z] : freeAtStart(project, body.id, lattice, CellSet(inside).indices()))
        free.push_back({x, y, z});
      return CellSet(free);
    };
    try {
      body.shape = redrawn(sketches[i], spacing, freeOf, brushOf, project.environment.gravity);
    } catch (const Error& error) {
      throw InputError(path + ":/bodies/" + std::to_string(i) + ": " + error.what());
    }
    const size_t cells = countOf(std::get<VoxelShape>(body.shape));
    std::printf("%s: %zu strokes, %zu cells%s\n", body.id.c_str(), sketches[i].strokes.size(), cells,
                cells == 0 ? ": they lie where others are, or outside of the scene" : "");
  }
}

}  // namespace

std::string redrawHelp() {
  return "phasesketch-cli redraw PROJECT --out PROJECT.json [options]\n\nDraws the strokes of sketched bodies again: "
         "after a script wrote or changed them, or with another particle spacing. Cells\nthat come from no stroke go; "
         "what one body has drawn stays free of those after it.\n\n" +
         optionHelp(kOptions);
}

int redrawCommand(CommandArguments list) {
  const Arguments arguments(list, kOptions);
  const std::string path = onlyFile(arguments, "project");
  if (!arguments.has("--out")) throw InputError("which project? give --out PROJECT.json");
  requireOutputs(arguments, {path}, {"--out"});
  PluginRegistry plugins;
  Project project = loadProject(path, plugins).project;
  const api::ParameterDeclaration& declared = *findDeclaration(solverParameters(), "particle_spacing");
  double spacing = numberOf(project.solver.parameters, solverParameters(), "particle_spacing");
  if (const auto given = arguments.number("--spacing", declared.hardMinimum, declared.hardMaximum)) {
    spacing = *given;
    project.solver.parameters.values["particle_spacing"] = spacing;
  }
  project.state = nullptr;  // of other matter
  redraw(project, path, spacing, plugins);
  saveProject(project, arguments.text("--out"));
  return kFine;
}

}  // namespace ps::cli
