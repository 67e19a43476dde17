// SPDX-License-Identifier: Apache-2.0
#include "ui/document/strokerecord.h"

#include "core/simulation/lattice.h"
#include "core/sketch/cellset.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace ps {
namespace {

CellSet cellSet(const std::vector<std::array<int, 3>>& cells) {
  std::vector<api::Cell> list;
  list.reserve(cells.size());
  for (const auto& c : cells) list.push_back({c[0], c[1], c[2]});
  return CellSet(list);
}

/// The same matter as a box makes at the start, as cells.
VoxelShape voxelsOf(const BoxShape& box, const Body& body, double spacing) {
  const std::vector<api::Double3> points = boxLattice(box, spacing);
  VoxelShape voxels;
  voxels.origin = {points.front().x, points.front().y, points.front().z};
  voxels.palette.push_back({body.material, numberOf(body.parameters, bodyParameters(), "temperature"), {}});
  std::vector<api::Cell> cells;
  cells.reserve(points.size());
  for (const api::Double3& p : points) {
    cells.push_back({static_cast<int32_t>(std::lround((p.x - voxels.origin[0]) / spacing)),
                     static_cast<int32_t>(std::lround((p.y - voxels.origin[1]) / spacing)),
                     static_cast<int32_t>(std::lround((p.z - voxels.origin[2]) / spacing))});
  }
  voxels.runs = encodeRuns(CellSet(cells), 0);
  return voxels;
}

}  // namespace

void applyEdits(Project& project, const std::vector<BodyEdit>& edits, bool forward) {
  const auto apply = [&](const BodyEdit& edit) {
    const std::optional<Body>& wanted = forward ? edit.after : edit.before;
    const auto found = std::find_if(project.bodies.begin(), project.bodies.end(),
                                    [&](const Body& body) { return body.id == edit.id; });
    if (found != project.bodies.end() && wanted) {
      *found = *wanted;
    } else if (found != project.bodies.end()) {
      project.bodies.erase(found);
    } else if (wanted) {
      const size_t place = std::min(edit.index, project.bodies.size());
      project.bodies.insert(project.bodies.begin() + static_cast<std::ptrdiff_t>(place), *wanted);
    }
  };
  if (forward) {
    std::for_each(edits.begin(), edits.end(), apply);
  } else {
    std::for_each(edits.rbegin(), edits.rend(), apply);
  }
}

Body withCells(Body body, const std::vector<std::array<int, 3>>& cells, int palette, const VoxelShape::Stroke& stroke) {
  auto& voxels = std::get<VoxelShape>(body.shape);
  VoxelCanvas canvas(voxels.runs);
  canvas.paint(cellSet(cells), palette);
  voxels.runs = canvas.runs();
  voxels.strokes.push_back(stroke);
  return body;
}

std::optional<Body> withoutCells(Body body, const VoxelShape& lattice, const std::vector<std::array<int, 3>>& cells,
                                 double spacing, bool& changed) {
  VoxelShape voxels = std::get<VoxelShape>(asVoxels(body, spacing).shape);
  const SketchGrid eraser{lattice.origin, spacing};
  const SketchGrid own{voxels.origin, spacing};
  const CellSet wanted = cellSet(cells);
  VoxelCanvas canvas(voxels.runs);
  std::vector<api::Cell> hit;
  for (const VoxelCanvas::Entry& entry : canvas.entries()) {
    if (wanted.contains(eraser.cellAt(own.centreOf(entry.cell)))) hit.push_back(entry.cell);
  }
  changed = !hit.empty();
  if (!changed) return body;
  canvas.erase(CellSet(hit));
  if (canvas.empty()) return std::nullopt;
  voxels.runs = canvas.runs();
  body.shape = voxels;
  return body;
}

std::vector<std::array<int, 3>> freeAtStart(const Project& project, const std::string& body, const VoxelShape& lattice,
                                            const std::vector<std::array<int, 3>>& cells) {
  const double spacing = numberOf(project.solver.parameters, solverParameters(), "particle_spacing");
  const SketchGrid grid{lattice.origin, spacing};
  std::map<std::array<int, 3>, std::vector<std::array<double, 3>>> taken;  // by cell, as neighbours are looked up
  for (const Body& other : project.bodies) {
    if (other.id == body) continue;
    const auto voxels = std::get<VoxelShape>(asVoxels(other, spacing).shape);
    const SketchGrid own{voxels.origin, spacing};
    for (const VoxelShape::Run& run : voxels.runs) {
      for (int k = 0; k < run.length; ++k) {
        const auto centre = own.centreOf({run.x + k, run.y, run.z});
        const api::Cell c = grid.cellAt(centre);
        taken[{c.x, c.y, c.z}].push_back(centre);
      }
    }
  }
  const auto isFree = [&](const std::array<int, 3>& cell) {
    const auto centre = grid.centreOf({cell[0], cell[1], cell[2]});
    for (int offset = 0; offset < 27; ++offset) {
      const auto found = taken.find({cell[0] + offset % 3 - 1, cell[1] + offset / 3 % 3 - 1, cell[2] + offset / 9 - 1});
      if (found == taken.end()) continue;
      for (const auto& p : found->second) {
        if (std::hypot(p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]) < 0.9 * spacing) return false;
      }
    }
    return true;
  };
  std::vector<std::array<int, 3>> free;
  std::copy_if(cells.begin(), cells.end(), std::back_inserter(free), isFree);
  return free;
}

Body asVoxels(Body body, double spacing) {
  if (const auto* box = std::get_if<BoxShape>(&body.shape)) body.shape = voxelsOf(*box, body, spacing);
  return body;
}

std::vector<std::vector<std::array<int, 3>>> missingCells(const Body& body, const std::optional<Body>& without) {
  const auto* voxels = std::get_if<VoxelShape>(&body.shape);
  if (!voxels) return {};
  VoxelCanvas canvas(voxels->runs);
  if (without) {
    if (const auto* rest = std::get_if<VoxelShape>(&without->shape)) canvas.erase(VoxelCanvas(rest->runs).cells());
  }
  std::vector<std::vector<std::array<int, 3>>> byPalette(voxels->palette.size());
  for (const VoxelCanvas::Entry& entry : canvas.entries()) {
    byPalette[static_cast<size_t>(entry.palette)].push_back({entry.cell.x, entry.cell.y, entry.cell.z});
  }
  return byPalette;
}

}  // namespace ps
