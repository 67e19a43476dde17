// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/projectio.h"

#include <nlohmann/json_fwd.hpp>

namespace ps {

// The steps of reading a project, in order; each throws InputError "name:/json/pointer: what is wrong".

/// Applies one "json/pointer=value" edit: the value is JSON, or else text. Elements of lists are named by number or by
/// their "id"; missing objects on the way are made. Throws InputError "--set EDIT: what is wrong".
void applyEdit(nlohmann::json& document, const std::string& edit);
/// Format, version, required plugins, the schema, the parameters of plugins. Unknown keys become warnings.
void checkDocument(const nlohmann::json& document, const std::string& name, const PluginRegistry& plugins,
                   std::vector<ProjectMessage>& warnings);
/// A document that passed checkDocument(); it is taken apart.
Project readDocument(nlohmann::json& document, const PluginRegistry& plugins);
/// References, relations and sizes. Missing plugins that are not required become warnings; what keeps a scene from
/// being made of a project that is sound otherwise becomes a problem.
void checkProject(const Project& project, const std::string& name, const PluginRegistry& plugins,
                  std::vector<ProjectMessage>& warnings, std::vector<ProjectMessage>& problems);

}  // namespace ps
