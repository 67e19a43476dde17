// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/sketch/cellset.h"
#include "core/sketch/flooding.h"
#include "core/sketch/nearmatter.h"

#include <phasesketch/brush.h>

#include <functional>
#include <string>

namespace ps {

/// A brush by its id; nullptr: there is none of that name.
using BrushOf = std::function<const api::BrushPlugin*(const std::string& id)>;

/// What a brush that sees matter sees within a radius (m) of a place while a sketch is drawn again, as far as it has
/// come.
using MatterBeside = std::function<SeenMatter(const VoxelShape& soFar, const Vector3& centre, double radius)>;

/// A sketch drawn again from its strokes alone, without hidden ones, in their order, on a lattice of `spacing` m: an
/// adding stroke fills the cells that are free, an erasing one empties them, one that paints makes those that are
/// filled of its material, one that smooths rounds what is there by then, and one that fills lets hollows run full
/// under `gravity` (m/s2). What cells it had and no stroke explains is gone. Without `matter` brushes see none, and
/// without `barrierOf` open hollows run full as well. Throws InputError where a brush is missing, or a stroke cannot be
/// drawn.
VoxelShape redrawn(const VoxelShape& shape, double spacing, const FreeOf& freeOf, const BrushOf& brushOf,
                   const Vector3& gravity = {0, -9.81, 0}, const MatterBeside& matter = {},
                   const BarrierOf& barrierOf = {});

}  // namespace ps
