// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"
#include "core/scene/project.h"

#include <phasesketch/brush.h>

#include <memory>
#include <vector>

namespace ps {

/// The shape that a stroke stamps, as its brush gets it.
struct StampCells {
  std::vector<api::Cell> cells;        ///< in the order of compareCells()
  double spacing = 0;                  ///< m
  Vector3 middle{0, 0, 0};             ///< in cells, of the box around them
  Vector3 half{0, 0, 0};               ///< in cells, half its edges
  Matrix3 axes = Matrix3::Identity();  ///< unit vectors along its lattice, as columns
};

/// nullptr of a shape without cells. Throws InputError for runs that cover a cell twice.
std::shared_ptr<const StampCells> stampCells(const VoxelShape::Stamp& stamp);

}  // namespace ps
