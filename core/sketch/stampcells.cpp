// SPDX-License-Identifier: Apache-2.0
#include "core/sketch/stampcells.h"

#include "core/scene/pose.h"
#include "core/sketch/cellset.h"

#include <cmath>

namespace ps {

std::shared_ptr<const StampCells> stampCells(const VoxelShape::Stamp& stamp) {
  const CellSet set = VoxelCanvas(stamp.cells).cells();
  if (set.empty()) return nullptr;
  auto out = std::make_shared<StampCells>();
  out->cells.assign(set.cells().begin(), set.cells().end());
  out->spacing = stamp.spacing;
  Vector3 low = Vector3::Constant(HUGE_VAL), high = -low;
  for (const api::Cell& cell : out->cells) {
    low = low.cwiseMin(Vector3(cell.x, cell.y, cell.z));
    high = high.cwiseMax(Vector3(cell.x, cell.y, cell.z));
  }
  out->middle = 0.5 * (low + high);
  out->half = 0.5 * (high - low) + Vector3::Constant(0.5);
  VoxelShape turned;
  turned.rotation = stamp.rotation;
  out->axes = poseOf(turned).turn.toRotationMatrix();
  return out;
}

}  // namespace ps
