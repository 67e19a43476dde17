// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <cstdint>
#include <vector>

namespace ps {

class PluginRegistry;

/// What a slider that is dragged costs a running scene.
struct Drag {
  uint64_t particles = 0;
  uint64_t edits = 0;                ///< sent
  double editsPerSecond = 0;         ///< sent
  uint64_t applied = 0, baked = 0;   ///< made by the engine's thread, and tables of materials baked by them
  double framesAlone = 0;            ///< per second, of the scene left alone
  double framesDragged = 0;          ///< per second
  double bakeMilliseconds = 0;       ///< one table
  double editMilliseconds = 0;       ///< of the engine's thread per applied edit, the tables that it baked included
  std::vector<double> milliseconds;  ///< of the dragged frames
};

/// Plays a scene and drags a material's viscosity at 250 edits a second, in turns with the scene left alone, until
/// about `frames` frames of each have passed. Throws InputError when the project cannot be opened.
Drag measureDrag(const Project& project, PluginRegistry& plugins, const std::string& material, long frames);

}  // namespace ps
