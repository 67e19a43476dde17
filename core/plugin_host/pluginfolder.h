// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/plugin_host/registry.h"

#include <string>
#include <vector>

namespace ps {

/// What lies in a folder, and in the folders directly in it, by what the files say of themselves: no code of them runs.
/// Files that are no plugins are left out; what is wrong with one stands in its `problem`. Ascending by path.
std::vector<PluginInfo> pluginsIn(const std::string& folder);

/// Copies a plugin's file to where the program looks for the user's plugins, in the place of an older one of that
/// file's name; it is loaded when the program starts again. Returns where it lies. Throws Error: no permission, a full
/// disk.
std::string installPlugin(const PluginInfo& info);

}  // namespace ps
