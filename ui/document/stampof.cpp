// SPDX-License-Identifier: Apache-2.0
#include "ui/document/stampof.h"

#include "core/sketch/cellset.h"
#include "ui/document/strokerecord.h"

namespace ps {

VoxelShape::Stamp stampOf(const Body& body, double spacing) {
  VoxelShape::Stamp stamp;
  stamp.spacing = spacing;
  const Body cells = asVoxels(body, spacing);
  const auto& voxels = std::get<VoxelShape>(cells.shape);
  stamp.rotation = voxels.rotation;
  stamp.cells = encodeRuns(VoxelCanvas(voxels.runs).cells(), 0);
  return stamp;
}

}  // namespace ps
