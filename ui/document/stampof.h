// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

namespace ps {

/// The shape of a body as a brush stamps it, of cells with edges of `spacing` m: as it is made at the start, turned as
/// it stands. Of a mesh or another solid the cells that it is filled with, of a hollow one those of its surface.
VoxelShape::Stamp stampOf(const Body& body, double spacing);

}  // namespace ps
