// SPDX-License-Identifier: Apache-2.0
#include "ui/document/redrawing.h"

#include "core/plugin_host/registry.h"
#include "core/scene/pose.h"
#include "core/sketch/redraw.h"
#include "core/sketch/stroke.h"
#include "ui/document/strokerecord.h"

#include <vector>

namespace ps {

VoxelShape redrawnIn(const Project& project, const std::string& body, const VoxelShape& sketch, double spacing,
                     const PluginRegistry& plugins) {
  const auto freeOf = [&](const SketchGrid& grid, const CellSet& cells) {
    std::vector<api::Cell> inside;
    for (const api::Cell& cell : cells.cells()) {
      if (isInScene(project.environment, grid, cell)) inside.push_back(cell);
    }
    VoxelShape lattice = latticeOf(sketch);
    lattice.origin = grid.origin, lattice.spacing = grid.spacing;
    std::vector<api::Cell> free;
    for (const auto& [x, y, z] : freeAtStart(project, body, lattice, CellSet(inside).indices()))
      free.push_back({x, y, z});
    return CellSet(free);
  };
  const auto brushOf = [&](const std::string& id) { return plugins.brush(id); };
  return redrawn(sketch, spacing, freeOf, brushOf, project.environment.gravity);
}

size_t cellCount(const VoxelShape& sketch) {
  size_t cells = 0;
  for (const VoxelShape::Run& run : sketch.runs) cells += static_cast<size_t>(run.length);
  return cells;
}

size_t cellsBeyond(const VoxelShape& sketch, const VoxelShape& other) {
  CellSet cells = VoxelCanvas(sketch.runs).cells();
  cells.remove(VoxelCanvas(other.runs).cells().cells());
  return cells.cells().size();
}

}  // namespace ps
