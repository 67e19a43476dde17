// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/plugin_host/registry.h"

#include <string>
#include <vector>

namespace ps {

/// A directory to look into; `asked` when a person named it, so that its absence deserves a line.
struct PluginDirectory {
  std::string path;    ///< absolute
  std::string origin;  ///< "PHASESKETCH_PLUGIN_PATH", ... for messages
  bool asked = false;
  bool own = false;  ///< the program's own plugins lie here
};

/// In rising order of precedence; a directory that appears twice keeps its last place.
std::vector<PluginDirectory> pluginDirectories(const PluginRegistry::Options& options);

/// Where the user's own plugins lie: $XDG_DATA_HOME/phasesketch/plugins, or ~/.local/share/phasesketch/plugins.
std::string userPluginDirectory();

/// Where this program keeps what it notices about itself: $XDG_STATE_HOME/phasesketch, or ~/.local/state/phasesketch.
std::string stateDirectory();

}  // namespace ps
