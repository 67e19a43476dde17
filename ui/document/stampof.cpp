// SPDX-License-Identifier: Apache-2.0
#include "ui/document/stampof.h"

#include "core/geometry/solidfill.h"
#include "core/parameters/parameterset.h"
#include "core/sketch/cellset.h"
#include "ui/document/strokerecord.h"

namespace ps {

VoxelShape::Stamp stampOf(const Body& body, double spacing) {
  VoxelShape::Stamp stamp;
  stamp.spacing = spacing;
  if (const auto* solid = std::get_if<SolidShape>(&body.shape)) {
    for (const auto& [axis, key] : {std::pair(0, "rotation_x"), {1, "rotation_y"}, {2, "rotation_z"}})
      stamp.rotation[axis] = numberOf(solid->parameters, solidParameters(), key);
    std::vector<api::Cell> cells;
    for (const std::array<int, 3>& c : fillSolid(*solid, spacing).cells) cells.push_back({c[0], c[1], c[2]});
    stamp.cells = encodeRuns(CellSet(cells), 0);
    return stamp;
  }
  const Body cells = asVoxels(body, spacing);
  const auto& voxels = std::get<VoxelShape>(cells.shape);
  stamp.rotation = voxels.rotation;
  stamp.cells = encodeRuns(VoxelCanvas(voxels.runs).cells(), 0);
  return stamp;
}

}  // namespace ps
