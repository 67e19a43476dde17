// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "ui/document/redrawing.h"

#include <cstdio>

namespace ps::cli {
namespace {

constexpr OptionSpec kOptions[] = {
    {"--out", "PROJECT.json", "the project that is written"},
    {"--spacing", "M", "particle spacing in m; without it the project's own"},
};

/// In the order of the bodies: as in the editor, a stroke leaves free what others hold, those that are still to be
/// drawn left out.
void redraw(Project& project, const std::string& path, double spacing, const PluginRegistry& plugins) {
  std::vector<VoxelShape> sketches;
  for (Body& body : project.bodies) {
    auto* sketch = std::get_if<VoxelShape>(&body.shape);
    sketches.push_back(sketch ? *sketch : VoxelShape{});
    if (sketch && !sketch->strokes.empty()) sketch->runs.clear();
  }
  for (size_t i = 0; i < project.bodies.size(); ++i) {
    if (sketches[i].strokes.empty()) continue;
    Body& body = project.bodies[i];
    try {
      body.shape = redrawnIn(project, body.id, sketches[i], spacing, plugins);
    } catch (const Error& error) {
      throw InputError(path + ":/bodies/" + std::to_string(i) + ": " + error.what());
    }
    const size_t cells = cellCount(std::get<VoxelShape>(body.shape));
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
