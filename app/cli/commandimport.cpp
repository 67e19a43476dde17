// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/base/jsontext.h"
#include "core/geometry/solidfill.h"
#include "core/io/meshimport.h"
#include "core/io/outputfile.h"
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/scene/solidform.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ps::cli {
namespace {

constexpr OptionSpec kOptions[] = {
    {"--out", "PROJECT.json", "the project that is written"},
    {"--spacing", "M", "particle spacing in m; without it one that makes some 20,000 particles, or the finest"},
    {"--unit", "mm|cm|m|in", "length that the file means by 1; without it what it says itself, or m"},
    {"--reduce", "N", "triangles that are kept at most; without it 200,000, where their volume is within 0.5 %"},
    {"--material", "ID", "what it is made of; without it the standard one"},
    {"--structure", "ID", "the constraint plugin that holds it together where it is solid"},
    {"--fill", "automatic|lattice|relaxed",
     "how particles lie in it; relaxed packs them against its surface, automatic what is fixed"},
    {"--wall", "", "the mesh is a wall: its surface alone, held in place, which lets no heat through"},
    {"--report", "FILE.json", "writes triangles, closed, mesh_volume, particles, particle_volume"},
};
constexpr int kMostTriangles = 10'000'000;  ///< that are read
constexpr double kReading = 120;            ///< s, at most
constexpr double kParticles = 20000;        ///< without --spacing

double spacingFor(const Arguments& arguments, const ImportedMesh& imported) {
  const api::ParameterDeclaration& declared = *findDeclaration(solverParameters(), "particle_spacing");
  const double least = declared.hardMinimum, most = declared.hardMaximum;
  if (const auto given = arguments.number("--spacing", least, most)) return *given;
  const double wanted = std::clamp(std::cbrt(imported.facts.volume / kParticles), least, most);
  const double digit = std::pow(10, std::floor(std::log10(wanted)) - 1);
  return std::clamp(std::round(wanted / digit) * digit, least, most);
}

SceneMaterial materialFor(const Arguments& arguments, const PluginRegistry& plugins) {
  SceneMaterial material;
  material.id = material.base = arguments.text("--material", plugins.standard(PluginKind::Material));
  const Material* installed = plugins.material(material.base);
  if (!installed) throw InputError("--material " + material.base + ": no such material is installed");
  material.label = installed->label;
  return material;
}

/// The body on a floor, in a box that gives it room to fall apart.
Project projectOf(Body body, const SceneMaterial& material, double spacing, const PluginRegistry& plugins) {
  Project project;
  project.title = body.name;
  project.solver.thermalModel = plugins.standard(PluginKind::Thermal);
  project.solver.parameters.values["particle_spacing"] = spacing;
  project.materials.push_back(material);
  const Vector3 size = SolidForm(std::get<SolidShape>(body.shape)).size();
  const double room = size.maxCoeff();
  project.environment.boundsMinimum = {-size[0] / 2 - room, -room / 2, -size[2] / 2 - room};
  project.environment.boundsMaximum = {size[0] / 2 + room, size[1] + room, size[2] / 2 + room};
  SceneWall floor;
  floor.id = "floor";
  floor.name = "Floor";
  project.environment.walls.push_back(floor);
  project.bodies.push_back(std::move(body));
  return project;
}

nlohmann::json reportOf(const ImportedMesh& imported, double spacing, const SolidMatter& matter) {
  return {{"triangles", imported.facts.triangles},
          {"closed", imported.facts.closed()},
          {"open_edges", imported.facts.openEdges},
          {"triangles_read", imported.reduction.from},
          {"reduction_error", imported.reduction.error},
          {"points_joined", imported.repair.joined},
          {"triangles_left_out", imported.repair.left},
          {"turned", imported.repair.turned},
          {"metres_per_unit", imported.metresPerUnit},
          {"unit_of_file", imported.unitIsOfFile},
          {"mesh_volume", imported.facts.volume},
          {"spacing", spacing},
          {"particles", matter.places.size()},
          {"particle_volume", static_cast<double>(matter.places.size()) * matter.volume}};
}

}  // namespace

std::string importHelp() {
  return "phasesketch-cli import MESH --out PROJECT.json [options]\n\nMakes a project of a mesh (OBJ, STL, PLY, glTF, "
         "FBX, 3MF and what else assimp reads), filled with particles and standing\non a floor. Open meshes are filled "
         "by their winding number; with --wall any mesh stands for its surface alone.\nThe file is read in a process "
         "of its own, which can do no harm.\n\n" +
         optionHelp(kOptions);
}

int importCommand(CommandArguments list) {
  const Arguments arguments(list, kOptions);
  const std::string path = onlyFile(arguments, "mesh");
  if (!arguments.has("--out")) throw InputError("which project? give --out PROJECT.json");
  const std::optional<double> unit = metresPer(arguments.text("--unit"));
  if (arguments.has("--unit") && !unit)
    throw InputError("--unit " + arguments.text("--unit") + ": must be mm, cm, m or in");
  requireOutputs(arguments, {path}, {"--out", "--report"});
  PluginRegistry plugins;
  const SceneMaterial material = materialFor(arguments, plugins);
  const size_t most = static_cast<size_t>(arguments.integer("--reduce", 4, kMostTriangles).value_or(kKeptTriangles));
  const ImportedMesh imported = importMesh(path, unit, kReading, most);
  const double spacing = spacingFor(arguments, imported);
  Body body = arguments.has("--wall") ? wallOf(imported) : bodyOf(imported);
  body.material = material.id;
  if (arguments.has("--structure")) {
    const std::string structure = arguments.text("--structure");
    if (!plugins.constraint(structure)) throw InputError("--structure " + structure + ": no such plugin is installed");
    body.constraints.push_back({structure, {}, {}});
  }
  auto& shape = std::get<SolidShape>(body.shape);
  if (arguments.has("--fill")) {
    const std::string fill = arguments.text("--fill");
    if (fill != "automatic" && fill != "lattice" && fill != "relaxed")
      throw InputError("--fill " + fill + ": must be automatic, lattice or relaxed");
    shape.parameters.values["fill"] = fill;
  }
  const double estimate = particleCount(body, spacing);
  if (estimate > kMaximumParticles)
    throw InputError(path + ": would be " + numberText(estimate) +
                     " particles; give a larger --spacing or another --unit");
  const SolidMatter matter = solidMatter(shape, spacing, toggleOf(body.parameters, bodyParameters(), "fixed"));
  saveProject(projectOf(std::move(body), material, spacing, plugins), arguments.text("--out"));
  if (arguments.has("--report"))
    writeFileAtomically(arguments.text("--report"), writeJson(reportOf(imported, spacing, matter)));
  if (const std::string& origin = imported.mesh->origin; origin.find(": ") != std::string::npos)
    std::printf("%s\n", origin.c_str());
  const char* closed = imported.facts.closed() ? "closed" : "open";
  if (arguments.has("--wall"))
    std::printf("%zu triangles, %s, a wall of %zu particles\n", imported.facts.triangles, closed, matter.places.size());
  else
    std::printf("%zu triangles, %s, %.4g m³ filled with %zu particles\n", imported.facts.triangles, closed,
                imported.facts.volume, matter.places.size());
  return kFine;
}

}  // namespace ps::cli
