// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/plugin_host/registry.h"

#include <functional>
#include <string>

namespace ps {

/// What became of a plugin that was tried.
struct PluginCheck {
  PluginInfo info;
  std::string problem;  ///< one line, or "" when all is well
};

/// Tries one plugin file: metadata and stamp, declarations, and a small scene of ten frames that uses it, or a stroke,
/// without matter and beside some.
/// Runs its code in this process, which it may take down or never leave: call it in a child. `stage` is told what comes
/// next. Sees the program's own plugins beside it; what is remembered of it goes into `scratch`, an empty folder.
PluginCheck checkPlugin(const std::string& path, const std::string& scratch,
                        const std::function<void(const std::string&)>& stage);

}  // namespace ps
