// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <cstddef>
#include <string>

namespace ps {

class PluginRegistry;

/// The sketch of one of a project's bodies drawn again from its strokes, on a lattice of `spacing` m (see redrawn()):
/// what it draws stays within the scene, and free of what other bodies hold at the start. From any thread. Throws
/// InputError where a stroke cannot be drawn.
VoxelShape redrawnIn(const Project& project, const std::string& body, const VoxelShape& sketch, double spacing,
                     const PluginRegistry& plugins);

size_t cellCount(const VoxelShape& sketch);
/// Cells of a sketch that another one has not.
size_t cellsBeyond(const VoxelShape& sketch, const VoxelShape& other);

}  // namespace ps
