// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/parameters/wording.h"
#include "core/scene/project.h"

#include <string>
#include <vector>

// What declarations say of other parameters, for the addresses of a project.
namespace ps {

class PluginRegistry;

/// "" or when the value of an address would act, for one that does nothing as the scene is: "Acts when “Heat” is fixed
/// temperature or convective."
std::string idleReason(const Project& project, const PluginRegistry* plugins, const Address& address);
/// Whether a declaration may come to act, or cease to, when another key changes.
bool mayEnable(const api::ParameterDeclaration& declaration, const Address& own, const Address& changed);
/// What the value of an address is bound by and when it acts, in sentences.
std::vector<std::string> rulesOf(const Project& project, const PluginRegistry* plugins, const Address& address);
/// "" or what the value of an address should be, by its own declaration, and is not: "Should be above “Opens at” (5 s),
/// not 2 s."
std::string adviceOf(const Project& project, const PluginRegistry* plugins, const Address& address);
/// "" or the relation of the address's list that a value would break: "Cold side: must be below “Hot side” (20 °C), not
/// 25 °C." Those of a material's properties are found by problemOf(Material).
std::string problemOfRelations(const Project& project, const PluginRegistry* plugins, const Address& address,
                               const Value& value);
/// Throws SceneError for the first relation that must hold in a project and does not. Those of a material's properties
/// are found when its table is made.
void requireRelations(const Project& project, const PluginRegistry& plugins);

}  // namespace ps
