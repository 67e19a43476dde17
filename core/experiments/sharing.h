// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <optional>
#include <string>
#include <vector>

// A project for others: in one file, with what a run of it comes to, so that they can see whether it does so with them.
namespace ps {

class PluginRegistry;

struct SharedCopy {
  Project project;
  std::vector<std::string> written;  ///< ids of materials of the scene whose values are in the project from now on
  std::vector<std::string> needed;   ///< ids of plugins that do not come with the program and that others must install
};

/// Materials that do not come with the program are written out: each becomes the standard one with its own values, and
/// behaves the same to the bit. One whose plugin's own parameters are animated, or that is not installed, stays what it
/// is. What the project said of an earlier end is left out.
SharedCopy copyForSharing(Project project, const PluginRegistry& plugins);

/// Number of the last frame of a run as long as the project is.
uint64_t lastFrameOf(const Project& project);

/// Runs a project to a frame, from the state that it holds or from its start, and says what it came to. The thread's
/// progress counts the frames. Throws Cancelled, SceneError where no scene can be made, and Error where the run fails.
/// `program`: what RunEnd::program says.
RunEnd runToEnd(const Project& project, PluginRegistry& plugins, uint64_t frame, const std::string& program);

/// "" where both are the same to the bit, else what differs, as people say it: "temperature 301.2 K instead of 300.9 K;
/// …". `noted`: what the project says.
std::string differences(const RunEnd& noted, const RunEnd& found);

}  // namespace ps
