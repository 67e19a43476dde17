// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/plugin.h>

#include "core/matter/material.h"

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace ps {

/// The materials of one registry, for plugins that ask; empty before it has loaded all and after it is gone.
struct InstalledMaterials {
  std::mutex mutex;
  std::map<std::string, const Material*> byId;
};

/// What one plugin may ask of the program.
class HostServices final : public api::Host {
 public:
  HostServices(std::string plugin, std::shared_ptr<InstalledMaterials> materials)
      : m_plugin(std::move(plugin)), m_materials(std::move(materials)) {}
  void log(Severity severity, const char* text) noexcept override;
  double property(const char* material, const char* key, double temperature) const noexcept override;
  const void* extension(const char* name) const noexcept override;
  /// From now on these are asked for properties; those of a registry that is loaded later.
  void use(std::shared_ptr<InstalledMaterials> materials);

 private:
  const std::string m_plugin;
  mutable std::mutex m_mutex;
  std::shared_ptr<InstalledMaterials> m_materials;  ///< under it
  std::atomic<int> m_lines{0};
};

/// Attaches a plugin to services that are kept as long as its object: for the life of the process. Registries share
/// that object, and one may be loaded while the scene of another runs, so an object is attached once; later on only its
/// materials change.
void attach(api::Plugin& plugin, const std::string& id, const std::shared_ptr<InstalledMaterials>& materials);

}  // namespace ps
