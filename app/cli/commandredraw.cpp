// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "core/sketch/redraw.h"

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

/// In the order of the bodies: what one has drawn, those after it leave free.
void redraw(Project& project, const std::string& path, double spacing, const PluginRegistry& plugins) {
  CellSet taken;
  const auto brushOf = [&](const std::string& id) { return plugins.brush(id); };
  for (size_t i = 0; i < project.bodies.size(); ++i) {
    Body& body = project.bodies[i];
    auto* sketch = std::get_if<VoxelShape>(&body.shape);
    if (!sketch || sketch->strokes.empty()) continue;
    try {
      *sketch = redrawn(*sketch, spacing, taken, brushOf);
    } catch (const Error& error) {
      throw InputError(path + ":/bodies/" + std::to_string(i) + ": " + error.what());
    }
    if (sketch->runs.empty()) throw InputError(path + ":/bodies/" + std::to_string(i) + ": its strokes fill no cell");
    taken.add(VoxelCanvas(sketch->runs).cells().cells());
    std::printf("%s: %zu strokes, %zu cells\n", body.id.c_str(), sketch->strokes.size(), countOf(*sketch));
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
