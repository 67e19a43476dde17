// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/parameter.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace ps {

/// Newest project format that this program reads and the one it writes.
inline constexpr int kProjectVersion = 1;

/// JSON Schema (draft 2020-12) of a project, made from the declarations; published as
/// resources/schema/project.schema.json. Parameters of plugins are open here and checked with parameterSchema().
/// What no schema can say is checked beside it: references, relations between properties, ascending curves, and how
/// many coefficients a law takes.
const nlohmann::json& projectSchema();

/// Schema of one declared parameter; "x-unit" carries its SI unit.
nlohmann::json parameterSchema(const api::ParameterDeclaration& declaration);
/// An object with these parameters; other keys are allowed.
nlohmann::json parameterListSchema(api::ParameterList list);

/// Of so many unknown keys each is told.
inline constexpr size_t kMostUnknown = 20;
/// A key that a schema does not name.
struct UnknownKey {
  std::string pointer;
  std::string meant;  ///< " (did you mean 'environment'?)", or ""
};
/// Checks a value against a schema made by the functions above ("$ref" is looked up in projectSchema()).
/// Throws InputError "name:pointer: what is wrong" for the first thing wrong. `unknown` receives the keys that the
/// schema does not name ("$..." and "x-..." are meant for others and left out).
void checkAgainst(const nlohmann::json& schema, const nlohmann::json& value, const std::string& name,
                  const std::string& pointer, std::vector<UnknownKey>& unknown);

}  // namespace ps
