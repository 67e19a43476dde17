// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/sketch/cellset.h"

#include <phasesketch/brush.h>

#include <functional>
#include <string>

namespace ps {

/// A brush by its id; nullptr: there is none of that name.
using BrushOf = std::function<const api::BrushPlugin*(const std::string& id)>;

/// A sketch drawn again from its strokes alone, in their order, on a lattice of `spacing` m: an adding stroke fills the
/// cells that are free, an erasing one empties them. `taken`: cells of others on the same lattice, which stay free. What
/// cells it had and no stroke explains is gone. Throws InputError where a brush is missing, or a stroke cannot be drawn.
VoxelShape redrawn(const VoxelShape& shape, double spacing, const CellSet& taken, const BrushOf& brushOf);

}  // namespace ps
