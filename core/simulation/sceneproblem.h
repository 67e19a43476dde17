// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/scene/project.h"

#include <string>
#include <utility>
#include <vector>

namespace ps {

class PluginRegistry;

/// No scene can be made of a project. The message says what is wrong, where, and what to do.
class SceneError : public InputError {
 public:
  SceneError(const std::string& what, Address wrong) : InputError(what), culprit(std::move(wrong)) {}
  const Address culprit;  ///< whose value has to change
};

/// "" or why no scene could be made of a project in which one parameter has another value that is in its range: too
/// many particles, more than the memory holds, a periodic box too small for their reach, a temperature gradient that
/// leads below 1 K. Found without building, and only what that parameter can bring about: it may be asked of every
/// value of a drag.
std::string problemOfSceneWith(const Project& project, const PluginRegistry* plugins, const Address& address,
                               const Value& value);
/// "" or why a body, with this temperature at its start, would be below 1 K somewhere; `spacing` of its particles, m.
std::string coldProblem(const Body& body, double temperature, double spacing);
/// Along which axes a scene repeats itself too soon for the reach of its particles, and how that is said.
std::vector<std::pair<size_t, std::string>> periodProblems(const Project& project, double spacing, double reach);
/// Throws SceneError for more particles than a scene may have.
void requireFewer(double particles);
/// Throws SceneError for a project of more particles than a scene may have, or than `memory` holds.
void requireRoom(const Project& project, const PluginRegistry& plugins, const Memory& memory);
/// Throws SceneError where a scene of `living` particles cannot take `more` of `bytesEach`.
void requireRoomFor(double living, double more, double bytesEach, const Memory& memory);
/// Throws SceneError where the reach of the particles is too long for a scene that repeats itself.
void requirePeriods(const Project& project);

}  // namespace ps
