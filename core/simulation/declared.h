// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <string>
#include <vector>

// What an address means in a project: its declaration, its default, the value in force. Pure functions; without plugins
// (nullptr, or one not installed) an address of theirs has no declaration.
namespace ps {

class PluginRegistry;

/// What a body is made of is no parameter either; panels show it as one, a choice among the scene's materials.
inline constexpr const char* kBodyMaterialKey = "material";

/// Whom a material holds on to when one of the two freezes is a list (SceneMaterial::adheresTo); panels show a toggle
/// for each other material of the scene, whose key is this with the other's id behind it.
inline constexpr const char* kAdheresKey = "adheres_to.";
/// The other material's id, or "" where the address is no such toggle.
std::string adhesionPartner(const Address& address);
/// Which of the scene's materials a list of the scene means: by their ids, and by a name that is none of these ids, all
/// that are the installed one of that name.
std::vector<std::string> namedInScene(const Project& project, const std::vector<std::string>& named);
/// Which of them the list of an installed material means: all that are, or are called as, one of those named.
std::vector<std::string> namedByInstalled(const Project& project, const std::vector<std::string>& named);

/// The declarations among which an address's key is found; empty when unknown.
api::ParameterList declarationsOf(const Project& project, const PluginRegistry* plugins, const Address& address);
const api::ParameterDeclaration* declarationOf(const Project& project, const PluginRegistry* plugins,
                                               const Address& address);
/// A value brought to the type that its declaration stores: a number for a response and back.
Value conformed(Value value, const api::ParameterDeclaration& declaration);
/// What a reset goes to: the installed material's value for material properties, else the declaration's default.
Value defaultOf(const Project& project, const PluginRegistry* plugins, const Address& address);
/// Explicit value or default.
Value valueAt(const Project& project, const PluginRegistry* plugins, const Address& address);
/// Defaults of all properties of a scene material, for rows that show what changed.
ParameterSet materialDefaults(const Project& project, const PluginRegistry* plugins, const std::string& material);
/// "" or why a project with this value would not hold together: out of its hard range, a solidus above the liquidus,
/// more particles than a scene may have or the memory holds.
std::string problemWith(const Project& project, const PluginRegistry* plugins, const Address& address,
                        const Value& value);
/// Whether a constraint plugin ties matter together; one that is not installed counts, one that acts between neighbours
/// does not.
bool holdsTogether(const std::string& plugin, const PluginRegistry* plugins);
/// The constraint plugin that takes in frozen matter (api::kHoldsFrozen), first by id; "" where none is installed. What
/// is sketched as a solid is held by it too.
std::string frozenStructure(const PluginRegistry& plugins);
/// Whether a body has a constraint of this plugin.
bool uses(const Body& body, const std::string& plugin);
/// The constraint plugin that holds a body together, or kNoStructure.
std::string structureOf(const Body& body, const PluginRegistry* plugins);
/// One address of each list of parameters that the project has, without a key (of materials' properties: with the first
/// of them), in the order of the outliner. None of probes, which change nothing of the scene.
std::vector<Address> parameterLists(const Project& project);
/// Addresses of every declared parameter of the project, in the order of the outliner.
std::vector<Address> allAddresses(const Project& project, const PluginRegistry* plugins);

}  // namespace ps
