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

 private:
  std::string m_plugin;
  std::shared_ptr<InstalledMaterials> m_materials;
  std::atomic<int> m_lines{0};
};

/// Made for a plugin, and kept as long as its object: for the life of the process.
HostServices& hostServicesFor(const std::string& plugin, const std::shared_ptr<InstalledMaterials>& materials);

}  // namespace ps
