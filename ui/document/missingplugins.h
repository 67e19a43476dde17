// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/plugin_host/registry.h"
#include "core/scene/address.h"
#include "core/scene/project.h"

#include <QtCore/QString>

#include <string>
#include <vector>

namespace ps {

/// A plugin that a scene needs and that is not here, with what does without it meanwhile.
struct MissingPlugin {
  std::string id;  ///< of the plugin
  PluginKind kind = PluginKind::Material;
  std::string material{};       ///< SceneMaterial::id that is of it; "": of another kind
  std::vector<Address> rows{};  ///< where it is chosen
};

/// Of materials in the order of the scene, then of what holds bodies together, then of heat; each of them once.
std::vector<MissingPlugin> missingPlugins(const Project& project, const PluginRegistry& plugins);

/// "The material “Bingham paste” needs the plugin “org.example.bingham”, which is not installed. “Block” stands still
/// meanwhile. All values are kept."
QString missingText(const MissingPlugin& missing, const Project& project, const PluginRegistry& plugins);

}  // namespace ps
