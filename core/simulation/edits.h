// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/command.h"

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace ps {

class PluginRegistry;

/// What edits have touched, so that each part is compiled once, however many edits come at a time.
struct Touched {
  std::set<Owner> owners{};
  std::set<std::string> materials{};  ///< SceneMaterial::id
  bool allMaterials = false;
};
/// Takes one edit of a project back.
using UndoEdit = std::function<void(Project&)>;

/// Notes the part that the value of an address is compiled into.
void touch(const Address& address, Touched& touched);

/// Writes a value into a project and notes what it touches and how to take it back. Returns when it acts, as its
/// declaration says; nothing where the address or the value has no place in this project.
std::optional<api::ActsAt> writeValue(Project& project, const PluginRegistry& plugins, const SetParameter& edit,
                                      Touched& touched, std::vector<UndoEdit>& undo);

/// Materials in the order of the living ones: particles carry indices of materials, and as long as they live, each
/// keeps its place, one that has left the document too, for undo may bring back matter of it. New ones come last.
std::vector<SceneMaterial> inTheirPlaces(const std::vector<SceneMaterial>& living,
                                         const std::vector<SceneMaterial>& wanted);

}  // namespace ps
