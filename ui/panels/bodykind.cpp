// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/bodykind.h"

#include "core/matter/material.h"
#include "core/matter/phasebands.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "ui/document/declared.h"
#include "ui/tools/becoming.h"

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

namespace ps {
namespace {

constexpr const char* kSolid = "solid";

/// K; of a sketch that of its first matter, which is also whose material the body names.
double temperatureOf(const Body& body) {
  const auto* sketch = std::get_if<VoxelShape>(&body.shape);
  if (sketch && !sketch->palette.empty()) return sketch->palette.front().temperature;
  return numberOf(body.parameters, bodyParameters(), "temperature");
}

/// Whether what never melts and never boils is a liquid: who says how thick it is means one.
bool flows(const Project& project, const PluginRegistry& plugins, const std::string& id) {
  const auto own = std::find_if(project.materials.begin(), project.materials.end(),
                                [&](const SceneMaterial& material) { return material.id == id; });
  if (own == project.materials.end()) return false;
  const Material* installed = plugins.material(own->base);
  return own->properties.values.contains("viscosity") || (installed && installed->properties.contains("viscosity"));
}

/// That it says, or that is stable at its temperature.
std::string phaseOf(const Body& body, const Project& project, const PluginRegistry& plugins) {
  const std::string asked = choiceOf(body.parameters, bodyParameters(), "phase");
  if (asked != "automatic") return asked;
  const auto point = [&](const char* key) {
    const Value value = valueAt(project, &plugins, {Owner::Material, body.material, key});
    if (const auto* number = std::get_if<double>(&value)) return *number;
    const auto* response = std::get_if<Response>(&value);
    return response ? response->at(kRoom) : 0.0;
  };
  const double melting = point("melting_temperature"), boiling = point("boiling_temperature");
  const double temperature = temperatureOf(body);
  if (boiling > 0 && temperature >= boiling) return "gas";
  if (melting > 0) return temperature < melting ? kSolid : "liquid";
  return boiling > 0 || flows(project, plugins, body.material) ? "liquid" : kSolid;
}

}  // namespace

BodyKind kindOf(const Body& body, const Project& project, const PluginRegistry* plugins) {
  static constexpr std::pair<const char*, const char*> kHeld[] = {
      {"rigid", "body"}, {"bonded", "bonded"}, {"soft", "soft"}, {"cloth", "cloth"}, {"rope", "rope"}};
  static constexpr std::pair<const char*, const char*> kLoose[] = {
      {kSolid, "grains"}, {"liquid", "liquid"}, {"gas", "gas"}};
  if (toggleOf(body.parameters, bodyParameters(), "fixed"))
    return {QStringLiteral("plate"), QStringLiteral("Held in place")};
  if (!plugins) return {QStringLiteral("body"), {}};
  const auto named = [](const std::string& becoming, const char* icon) {
    for (const auto& [name, label] : becomings()) {
      if (name == becoming) return BodyKind{QString::fromLatin1(icon), label};
    }
    return BodyKind{QString::fromLatin1(icon), {}};
  };
  for (const auto& [becoming, icon] : kHeld) {
    if (hasBecome(body, becoming, project, *plugins, temperatureOf(body))) return named(becoming, icon);
  }
  if (structureOf(body, plugins) != kNoStructure) return {QStringLiteral("body"), {}};  // in a way of its own
  const std::string phase = phaseOf(body, project, *plugins);
  for (const auto& [loose, icon] : kLoose) {
    if (phase == loose) return named(phase == kSolid ? "loose" : phase, icon);
  }
  return {QStringLiteral("body"), {}};
}

}  // namespace ps
