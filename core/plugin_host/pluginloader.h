// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/plugin_host/registry.h"

#include <memory>
#include <string>
#include <vector>

namespace ps {

struct InstalledMaterials;

/// A plugin at work: its kind's pointer is set, of a constraint its form's as well, or only `material.id` for a JSON
/// material.
struct LoadedPlugin {
  std::string id;
  api::Plugin* plugin = nullptr;
  const api::MaterialPlugin* materialPlugin = nullptr;
  const api::ConstraintPlugin* constraint = nullptr;
  const api::StructuralPlugin* structural = nullptr;
  const api::GroupPlugin* group = nullptr;
  const api::NeighbourPlugin* neighbour = nullptr;
  const api::ThermalPlugin* thermal = nullptr;
  const api::HeatSourcePlugin* heatSource = nullptr;
  const api::BrushPlugin* brush = nullptr;
  std::vector<api::ParameterDeclaration> parameters;
  std::vector<api::FieldDeclaration> fields;  ///< of particles
  Material declared;                          ///< of material plugins: properties() alone
  Material material;                          ///< of materials; own laws evaluated at their defaults
};

/// Loads a library whose metadata are sound, makes its object and checks all that it declares. `info` receives label
/// and help, and `problem` when the plugin must be refused; whatever its code throws ends there. The plugin is attached
/// to the host, where it may ask for `materials`. The locale's number format is "C" afterwards.
LoadedPlugin loadLibrary(PluginInfo& info, const std::shared_ptr<InstalledMaterials>& materials);

/// The material of a plugin with its laws evaluated (see MaterialPlugin::evaluate) from 1 K to 6000 K. Throws what the
/// plugin throws, and Error for values that are not finite or out of range.
Material evaluateLaws(const LoadedPlugin& plugin, Material material, const std::vector<double>& parameters);

/// "tell its author, NAME": what to do about a fault of the plugin.
std::string whomToTell(const PluginInfo& info);
/// What a caught exception says, in one line. Call it in a catch block.
std::string currentExceptionText();
/// Line breaks and control characters become spaces, what is not UTF-8 the replacement character.
std::string oneLine(std::string text);

}  // namespace ps
