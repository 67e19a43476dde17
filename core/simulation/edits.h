// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/command.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace ps {

/// What edits have touched, so that each part is compiled once, however many edits come at a time.
struct Touched {
  std::set<Owner> owners{};
  std::set<std::string> materials{};  ///< SceneMaterial::id
  bool allMaterials = false;
  bool room = false;  ///< there may be more particles after the next reset
};
/// Takes one edit of a project back.
using UndoEdit = std::function<void(Project&)>;

enum class When {
  NextFrame,
  NextReset,
  IfFixed,  ///< at the next frame if the body was born fixed, else at the next reset
  Never,    ///< the address or the value has no place in this project
};
/// Writes a value into a project and notes what it touches and how to take it back.
When writeValue(Project& project, const SetParameter& edit, Touched& touched, std::vector<UndoEdit>& undo);

/// Materials in the order of the living ones: particles carry indices of materials, and as long as they live, each
/// keeps its place, one that has left the document too, for undo may bring back matter of it. New ones come last.
std::vector<SceneMaterial> inTheirPlaces(const std::vector<SceneMaterial>& living,
                                         const std::vector<SceneMaterial>& wanted);

}  // namespace ps
