// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/bodykind.h"

#include "core/matter/material.h"
#include "core/matter/phasebands.h"
#include "core/simulation/declared.h"
#include "ui/document/declared.h"
#include "ui/session/swatches.h"
#include "ui/tools/becoming.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace ps {
namespace {

constexpr const char* kSolid = "solid";

/// K; of a sketch that of its first matter, which is also whose material the body names.
double temperatureOf(const Body& body) {
  const auto* sketch = std::get_if<VoxelShape>(&body.shape);
  if (sketch && !sketch->palette.empty()) return sketch->palette.front().temperature;
  return numberOf(body.parameters, bodyParameters(), "temperature");
}

/// That it says, or that is stable at its temperature.
std::string phaseOf(const Body& body, const Project& project, const PluginRegistry& plugins) {
  const std::string asked = choiceOf(body.parameters, bodyParameters(), "phase");
  if (asked != "automatic") return asked;
  const double temperature = temperatureOf(body);
  const std::vector<PhaseBand> bands = bandsOf(materialAsShown(project, &plugins, body.material));
  const auto band =
      std::find_if(bands.begin(), bands.end(), [&](const PhaseBand& one) { return temperature < one.to; });
  if (band == bands.end() || band->phase == api::Phase::Gas) return "gas";
  return band->phase == api::Phase::Solid ? kSolid : "liquid";
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
