// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/brush.h>
#include <phasesketch/constraint.h>
#include <phasesketch/material.h>
#include <phasesketch/thermal.h>

#include "core/matter/material.h"

#include <memory>
#include <string>
#include <vector>

namespace ps {

enum class PluginKind { Material, Constraint, Thermal, Brush };
const char* pluginKindName(PluginKind kind);  ///< "material", ...

/// One plugin that was found, loaded or not.
struct PluginInfo {
  enum class State { Loaded, Refused, Quarantined };
  std::string id, label, version, api, licence, author, help, path;
  PluginKind kind = PluginKind::Material;
  State state = State::Refused;
  std::string problem;  ///< one line: what, where, what to do; "" when loaded
  bool json = false;    ///< a material that is a JSON file alone
};

/// Finds plugins in the build tree, the install prefix, the user's data directory and PHASESKETCH_PLUGIN_PATH (in
/// rising order of precedence), reads their metadata before any code is loaded, and loads what is sound. Broken ones are
/// listed with the reason; the rest works. A lock file quarantines the plugin that crashed the last start.
class PluginRegistry {
 public:
  struct Options {
    std::vector<std::string> extraPaths;  ///< before PHASESKETCH_PLUGIN_PATH
    bool builtIn = true;                  ///< build tree or install prefix
    bool userDirectory = true;
    bool environment = true;
  };
  explicit PluginRegistry(const Options& options);
  PluginRegistry();
  ~PluginRegistry();

  const std::vector<PluginInfo>& plugins() const;
  /// nullptr when not installed. Materials made of JSON alone have no MaterialPlugin, but a Material.
  const api::MaterialPlugin* materialPlugin(const std::string& id) const;
  const Material* material(const std::string& id) const;
  const api::ConstraintPlugin* constraint(const std::string& id) const;
  const api::ThermalPlugin* thermal(const std::string& id) const;
  const api::BrushPlugin* brush(const std::string& id) const;
  /// Loaded ids of a kind, ascending.
  std::vector<std::string> ids(PluginKind kind) const;
  bool has(const std::string& id) const;
  /// A material with a plugin's own law evaluated for these own parameters.
  Material evaluated(const std::string& id, const std::vector<double>& parameters) const;
  /// A plugin threw while running: refuses it from now on, and says so in plugins().
  void fault(const std::string& id, const std::string& message);

 private:
  struct Impl;
  std::unique_ptr<Impl> m;
};

}  // namespace ps
