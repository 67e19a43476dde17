// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/io/mixing.h"
#include "core/io/projectio.h"
#include "core/matter/mixture.h"
#include "core/parameters/wording.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/compile.h"

#include <algorithm>
#include <cstdio>

namespace ps::cli {
namespace {

constexpr double kReference = 293.15;  // K, at which values are listed

constexpr OptionSpec kOptions[] = {
    {"--share", "W", "of the second material, by mass: 0 to 1; without it 0.5"},
    {"--name", "TEXT", "what people call it; without it what it is made of"},
    {"--id", "ID", "what bodies call it; without it mixture"},
    {"--out", "FILE.json", "a preset of it: a project that holds nothing else"},
    kQuiet,
};

/// An installed material by its id, or one of a file: FILE.json where it holds one, FILE.json#ID where it holds more.
Material materialFor(const std::string& name, const PluginRegistry& plugins) {
  if (const Material* installed = plugins.material(name)) return *installed;
  const size_t mark = name.rfind('#');
  const std::string path = name.substr(0, mark), id = mark == std::string::npos ? "" : name.substr(mark + 1);
  if (!path.ends_with(".json")) throw InputError(name + ": no such material is installed, and it is no file FILE.json");
  const Project project = loadProject(path, plugins).project;
  const std::vector<Material> materials = compileMaterials(project, plugins);
  if (id.empty() && materials.size() == 1) return materials.front();
  if (id.empty())
    throw InputError(path + ": holds " + counted(materials.size(), "material") + "; say which: FILE.json#ID");
  const auto found = std::find_if(materials.begin(), materials.end(), [&](const Material& m) { return m.id == id; });
  if (found == materials.end()) throw InputError(path + ": has no material '" + id + "'");
  return *found;
}

void print(const Mixture& mixture) {
  const Material first = materialOf(mixture.first), second = materialOf(mixture.second), whole = materialOf(mixture);
  std::printf("%s, at 20 °C:\n", whole.label.c_str());
  const api::ParameterList catalogue = propertyCatalogue();
  for (size_t k = 0; k < catalogue.count; ++k) {
    const api::ParameterDeclaration& property = catalogue[k];
    if (!whole.properties.contains(property.key)) continue;
    const auto shown = [&](const Material& material) {
      return shownText(property, valueOf(material, property.key, kReference));
    };
    std::printf("  %s: %s; of %s and %s: %s\n", property.key, shown(whole).c_str(), shown(first).c_str(),
                shown(second).c_str(), std::string(mixtureRule(property.key)).c_str());
  }
}

}  // namespace

std::string mixHelp() {
  return "phasesketch-cli mix FIRST SECOND [options]\n\nMakes a material of two: FIRST and SECOND are ids of installed "
         "ones, or files FILE.json with one material, or\nFILE.json#ID. Says of each property what it comes to and by "
         "which rule. What cannot be one material (grains in a\nliquid, what boils before the other melts) is refused, "
         "with exit code 2.\n\n" +
         optionHelp(kOptions);
}

int mixCommand(CommandArguments list) {
  const Arguments arguments(list, kOptions);
  if (arguments.positional().size() != 2) throw InputError("which two materials? give ids or files, see mix --help");
  const std::string &first = arguments.positional()[0], &second = arguments.positional()[1];
  requireOutputs(arguments, {first, second}, {"--out"});
  const PluginRegistry plugins;
  const Mixture mixture{arguments.number("--share", 0, 1).value_or(0.5),
                        partOf(materialFor(first, plugins)),
                        partOf(materialFor(second, plugins)),
                        {}};
  SceneMaterial made = mixedMaterial(mixture, plugins);
  made.id = arguments.text("--id", "mixture");
  made.label = arguments.text("--name", made.label);
  if (!arguments.has("--quiet")) print(mixture);
  if (!arguments.has("--out")) return kFine;
  Project project;
  project.title = made.label;
  project.materials.push_back(std::move(made));
  (void)parseProject(writeProject(project), "--id " + arguments.text("--id"), plugins);  // an id that is none
  saveProject(project, arguments.text("--out"));
  return kFine;
}

}  // namespace ps::cli
