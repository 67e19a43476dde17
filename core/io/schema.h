// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/parameter.h>

#include <nlohmann/json.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ps {

/// Newest project format that this program reads and the one it writes.
inline constexpr int kProjectVersion = 1;

/// JSON Schema (draft 2020-12) of a project, made from the tables of fields and the declarations; published as
/// resources/schema/project.schema.json. Parameters of plugins are open here, with kPluginKeyword beside them.
/// What no schema can say is checked beside it: references, relations between properties, ascending curves, and how
/// many coefficients a law takes.
const nlohmann::json& projectSchema();

/// Schema of one declared parameter of a list: "x-unit" carries its SI unit, "x-enabledWhen", "x-relations" and
/// "x-actsAt" what its declaration says of the others and of time, which stands in words at the end of the description
/// too.
nlohmann::json parameterSchema(const api::ParameterDeclaration& declaration, api::ParameterList list);
/// Adds each as a key. Throws Error for one that stands there already.
void addParameterSchemas(nlohmann::json& properties, api::ParameterList list);
/// An object with these parameters; other keys are allowed.
nlohmann::json parameterListSchema(api::ParameterList list);

/// Of so many unknown keys each is told.
inline constexpr size_t kMostUnknown = 20;
/// A key that a schema does not name.
struct UnknownKey {
  std::string pointer;
  std::string meant;  ///< " (did you mean 'environment'?)", or ""
};
/// Keyword of an object that holds a plugin's parameters: {"kind": "brush", "key": "brush"}, the plugin's kind and the
/// key beside the object that has its id.
inline constexpr const char* kPluginKeyword = "x-plugin";
/// What a plugin declares; none for one that is not there.
using PluginParameters = std::function<std::optional<api::ParameterList>(const std::string& id)>;
/// Checks a project. Throws InputError "name:pointer: what is wrong" for the first thing wrong. `unknown` receives the
/// keys that the schema does not name ("$..." and "x-..." are meant for others and left out).
void checkAgainstSchema(const nlohmann::json& project, const std::string& name, const PluginParameters& parameters,
                        std::vector<UnknownKey>& unknown);
/// Checks any other value against a schema that may refer to the project's definitions. Throws likewise.
void requireSchema(const nlohmann::json& schema, const nlohmann::json& value, const std::string& name);

}  // namespace ps
