// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/plugin_host/registry.h"

#include <string>
#include <string_view>

namespace ps {

/// Reads a material that is a JSON file alone; plugins/materials/README.md describes the format. Throws InputError
/// "file:/json/pointer: what is wrong" for the first thing wrong. `info` receives what the file says about itself, as
/// far as it was read when something is thrown.
Material parseMaterialJson(std::string_view text, const std::string& name, PluginInfo& info);

/// The same from a file of at most 1 MiB; info.problem holds what parseMaterialJson would throw.
Material readMaterialFile(const std::string& path, PluginInfo& info);

}  // namespace ps
