// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace ps {

class PluginRegistry;

/// Matter as it stands in an engine, for a project of these bodies: `stream` is what Engine::save() wrote. Throws Error
/// for a state that is too large for a project.
std::shared_ptr<const ProjectState> projectState(std::span<const std::byte> stream, const std::vector<Body>& bodies);
/// "", or why a project with these plugins does not open at a state: it is damaged, a body came, went or has another
/// shape, or what its matter needs is not there any more. What else a scene is made of may change, as it may while it
/// runs.
std::string whyStateDoesNotFit(const ProjectState& state, const Project& project, const PluginRegistry& plugins);

}  // namespace ps
