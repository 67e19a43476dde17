// SPDX-License-Identifier: Apache-2.0
#include "ui/document/strokerecord.h"

#include "core/geometry/solidfill.h"
#include "core/scene/pose.h"
#include "core/scene/solidform.h"
#include "core/simulation/lattice.h"
#include "core/sketch/cellset.h"
#include "core/sketch/symmetry.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace ps {
namespace {

CellSet cellSet(const std::vector<CellIndex>& cells) {
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
  voxels.spacing = spacing;
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

/// Along its own axes, as it is filled, but for the lattice's stretch.
VoxelShape voxelsOf(const SolidShape& solid, const Body& body, double spacing) {
  const SolidCells filled = fillSolid(solid, spacing);
  const SolidForm form(solid);
  VoxelShape voxels;
  voxels.origin = filled.first;
  voxels.rotation = form.rotation();
  (form.isTurned() ? voxels.shift : voxels.origin) += form.middle();
  voxels.spacing = spacing;
  voxels.palette.push_back({body.material, numberOf(body.parameters, bodyParameters(), "temperature"), {}});
  voxels.runs = encodeRuns(cellSet(filled.cells), 0);
  return voxels;
}

void withSpacing(VoxelShape& voxels, double spacing) {
  VoxelCanvas canvas;
  for (size_t palette = 0; palette < voxels.palette.size(); ++palette) {
    const int entry = static_cast<int>(palette);
    canvas.paint(cellSet(resampled(cellsOf(voxels, entry), voxels.spacing, spacing)), entry);
  }
  voxels.origin = resampledOrigin(voxels, spacing);
  voxels.spacing = spacing;
  voxels.runs = canvas.runs();
}

Body* find(Project& project, const std::string& id) {
  const auto found =
      std::find_if(project.bodies.begin(), project.bodies.end(), [&](const Body& body) { return body.id == id; });
  return found == project.bodies.end() ? nullptr : &*found;
}

void apply(Project& project, const BodyEdit& edit, bool forward) {
  const std::optional<Body>& wanted = forward ? edit.after : edit.before;
  Body* body = find(project, edit.id);
  if (body && wanted) {
    *body = *wanted;
  } else if (body) {
    project.bodies.erase(project.bodies.begin() + (body - project.bodies.data()));
  } else if (wanted) {
    const size_t place = std::min(edit.index, project.bodies.size());
    project.bodies.insert(project.bodies.begin() + static_cast<std::ptrdiff_t>(place), *wanted);
  }
}

/// What an edit has put at the ends of both lists, or takes from there again.
void note(VoxelShape& voxels, const std::vector<VoxelShape::Paint>& paints,
          const std::vector<VoxelShape::Stroke>& strokes, bool forward) {
  const auto one = [forward](auto& list, const auto& more) {
    if (forward)
      list.insert(list.end(), more.begin(), more.end());
    else
      list.resize(list.size() - std::min(list.size(), more.size()));
  };
  one(voxels.palette, paints);
  one(voxels.strokes, strokes);
}

void apply(Project& project, const CellsEdit& edit, bool forward) {
  Body* body = find(project, edit.id);
  auto* voxels = body ? std::get_if<VoxelShape>(&body->shape) : nullptr;
  if (!voxels) return;
  VoxelCanvas canvas(voxels->runs);
  const VoxelCanvas changed(edit.cells);
  if (forward == edit.erase) {
    canvas.erase(changed.cells());
  } else {
    canvas.restore(changed);
  }
  voxels->runs = canvas.runs();
  note(*voxels, edit.added, edit.strokes, forward);
}

void apply(Project& project, const RepaintEdit& edit, bool forward) {
  Body* body = find(project, edit.id);
  auto* voxels = body ? std::get_if<VoxelShape>(&body->shape) : nullptr;
  if (!voxels) return;
  const auto& [before, after, added] = edit.cells;
  replaceRuns(*voxels, forward ? after : before);
  note(*voxels, added, edit.strokes, forward);
}

/// Where cells lie, with a rim of one cell.
struct CellBounds {
  CellBounds(const VoxelShape& lattice, const std::vector<CellIndex>& cells) {
    constexpr int kMost = std::numeric_limits<int>::max();
    CellIndex low{kMost, kMost, kMost}, high{-kMost, -kMost, -kMost};
    for (const CellIndex& c : cells) {
      for (size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], c[k] - 1);
        high[k] = std::max(high[k], c[k] + 1);
      }
    }
    BodyBounds drawn;
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<size_t>(k);
      drawn.minimum[k] = lattice.origin[k] + (low[axis] - 0.5) * lattice.spacing;
      drawn.maximum[k] = lattice.origin[k] + (high[axis] + 0.5) * lattice.spacing;
    }
    box = carriedBounds(drawn, poseOf(lattice));
  }
  /// A box about a place; no centre of what it is around lies farther out.
  bool meets(const Vector3& centre, const Vector3& size) const {
    return ((centre + size / 2).array() >= box.minimum.array()).all() &&
           ((centre - size / 2).array() <= box.maximum.array()).all();
  }
  bool holds(const Vector3& p) const {
    return (p.array() >= box.minimum.array()).all() && (p.array() <= box.maximum.array()).all();
  }
  BodyBounds box;  ///< m
};

/// Centres of a body's matter at the start, within bounds.
std::vector<Vector3> centresWithin(const Body& body, double spacing, const CellBounds& bounds) {
  std::vector<Vector3> centres;
  const auto add = [&](const Vector3& p) {
    if (bounds.holds(p)) centres.push_back(p);
  };
  if (const auto* box = std::get_if<BoxShape>(&body.shape)) {
    if (!bounds.meets(box->center, box->size)) return centres;
    for (const api::Double3& p : boxLattice(*box, spacing)) add({p.x, p.y, p.z});
    return centres;
  }
  if (const auto* solid = std::get_if<SolidShape>(&body.shape)) {
    const SolidForm form(*solid);
    if (!bounds.meets(form.middle(), form.extent())) return centres;
    for (const api::Double3& p : latticePlaces(*solid, spacing)) add({p.x, p.y, p.z});
    return centres;
  }
  const auto walk = [&](const VoxelShape& voxels) {
    const SketchGrid grid = gridOf(voxels);
    for (const VoxelShape::Run& run : voxels.runs) {
      const auto first = grid.centreOf({run.x, run.y, run.z});
      if (!grid.pose.turns() && (first[1] < bounds.box.minimum[1] || first[1] > bounds.box.maximum[1] ||
                                 first[2] < bounds.box.minimum[2] || first[2] > bounds.box.maximum[2]))
        continue;
      for (int k = 0; k < run.length; ++k) add(grid.centreOf({run.x + k, run.y, run.z}));
    }
  };
  const auto& voxels = std::get<VoxelShape>(body.shape);
  if (voxels.spacing == spacing) {
    walk(voxels);
  } else {
    walk(std::get<VoxelShape>(asVoxels(body, spacing).shape));
  }
  return centres;
}

/// Those of a sketch's cells whose centres lie in cells of another lattice, as idsInCells() has it.
CellSet cellsWithin(const VoxelShape& voxels, const VoxelShape& lattice, const std::vector<CellIndex>& cells,
                    const CellBounds& bounds) {
  const SketchGrid wide = wideGridOf(lattice), grid = gridOf(voxels);
  const CellSet wanted = cellSet(cells);
  std::vector<api::Cell> hit;
  const VoxelCanvas canvas(voxels.runs);
  for (const VoxelCanvas::Entry& entry : canvas.entries()) {
    const auto centre = grid.centreOf(entry.cell);
    if (bounds.holds(centre) && wanted.contains(wide.cellAt(centre))) hit.push_back(entry.cell);
  }
  return CellSet(hit);
}

/// What a sketch keeps of strokes that went over it on another lattice: where they went on its own. A body that was
/// drawn by none keeps none.
std::vector<VoxelShape::Stroke> strokesOn(const VoxelShape& voxels, const VoxelShape& lattice,
                                          const std::vector<VoxelShape::Stroke>& strokes) {
  if (voxels.strokes.empty()) return {};
  if (voxels.rotation == lattice.rotation && voxels.shift == lattice.shift) return strokes;
  const RigidMove move = poseOf(voxels).inverse().after(poseOf(lattice));
  std::vector<VoxelShape::Stroke> own;
  for (const VoxelShape::Stroke& stroke : strokes) {
    for (VoxelShape::Stroke& part : carried(stroke, move)) own.push_back(std::move(part));
  }
  return own;
}

}  // namespace

void applyEdits(Project& project, const std::vector<SceneEdit>& edits, bool forward) {
  const auto one = [&](const SceneEdit& edit) {
    std::visit([&](const auto& change) { apply(project, change, forward); }, edit);
  };
  if (forward) {
    std::for_each(edits.begin(), edits.end(), one);
  } else {
    std::for_each(edits.rbegin(), edits.rend(), one);
  }
}

const std::string& bodyOf(const SceneEdit& edit) {
  return std::visit([](const auto& change) -> const std::string& { return change.id; }, edit);
}

SceneEdit paintEdit(const Project& project, const Body& painted, const std::vector<CellIndex>& cells, int palette,
                    const VoxelShape::Stroke& stroke) {
  const auto found = std::find_if(project.bodies.begin(), project.bodies.end(),
                                  [&](const Body& body) { return body.id == painted.id; });
  if (found == project.bodies.end()) {
    Body made = painted;
    auto& voxels = std::get<VoxelShape>(made.shape);
    VoxelCanvas canvas(voxels.runs);
    canvas.paint(cellSet(cells), palette);
    voxels.runs = canvas.runs();
    voxels.strokes.push_back(stroke);
    return BodyEdit{painted.id, std::nullopt, std::move(made), project.bodies.size()};
  }
  CellsEdit edit{painted.id, false, {}, {stroke}};
  const auto& voxels = std::get<VoxelShape>(found->shape);
  // Another hand may have given it other entries since.
  const VoxelShape::Paint& paint = std::get<VoxelShape>(painted.shape).palette.at(static_cast<size_t>(palette));
  const auto entry = std::find(voxels.palette.begin(), voxels.palette.end(), paint);
  if (entry == voxels.palette.end()) edit.added.push_back(paint);
  edit.strokes.front().palette = static_cast<int>(entry - voxels.palette.begin());
  VoxelCanvas canvas(voxels.runs);
  edit.cells = encodeRuns(canvas.paint(cellSet(cells), palette), edit.strokes.front().palette);
  return edit;
}

std::optional<SceneEdit> eraseEdit(const Body& body, size_t index, const VoxelShape& lattice,
                                   const std::vector<CellIndex>& cells,
                                   const std::vector<VoxelShape::Stroke>& strokes) {
  const CellBounds bounds(lattice, cells);
  if (centresWithin(body, lattice.spacing, bounds).empty()) return std::nullopt;
  const auto* own = std::get_if<VoxelShape>(&body.shape);
  const bool stays = own && own->spacing == lattice.spacing;
  std::optional<Body> rest;
  if (!stays) rest = asVoxels(body, lattice.spacing);
  const VoxelShape& voxels = stays ? *own : std::get<VoxelShape>(rest->shape);
  const CellSet hit = cellsWithin(voxels, lattice, cells, bounds);
  if (hit.empty()) return std::nullopt;
  VoxelCanvas canvas(voxels.runs);
  const VoxelCanvas erased = canvas.erase(hit);
  if (canvas.empty()) return BodyEdit{body.id, body, std::nullopt, index};
  std::vector<VoxelShape::Stroke> noted = strokesOn(voxels, lattice, strokes);
  if (stays) return CellsEdit{body.id, true, erased.runs(), std::move(noted)};
  auto& left = std::get<VoxelShape>(rest->shape);
  left.runs = canvas.runs();
  left.strokes.insert(left.strokes.end(), noted.begin(), noted.end());
  return BodyEdit{body.id, body, std::move(rest), index};
}

std::vector<SceneEdit> repaintEdits(const Body& body, size_t index, const VoxelShape& lattice,
                                    const std::vector<CellIndex>& cells, const std::string& material,
                                    const std::vector<VoxelShape::Stroke>& strokes) {
  const CellBounds bounds(lattice, cells);
  if (centresWithin(body, lattice.spacing, bounds).empty()) return {};
  const auto* own = std::get_if<VoxelShape>(&body.shape);
  std::optional<Body> whole;
  if (!own || own->spacing != lattice.spacing) whole = asVoxels(body, lattice.spacing);
  const VoxelShape& voxels = whole ? std::get<VoxelShape>(whole->shape) : *own;
  RepaintEdit edit{body.id, repainted(voxels, cellsWithin(voxels, lattice, cells, bounds), material), {}};
  if (edit.cells.after.empty()) return {};
  edit.strokes = strokesOn(voxels, lattice, strokes);
  for (VoxelShape::Stroke& stroke : edit.strokes) stroke.palette = edit.cells.after.front().palette;
  std::vector<SceneEdit> edits;
  if (whole) edits.emplace_back(BodyEdit{body.id, body, std::move(whole), index});
  edits.emplace_back(std::move(edit));
  return edits;
}

std::vector<std::vector<CellIndex>> takenCells(const SceneEdit& edit, double spacing) {
  VoxelCanvas taken;
  if (const auto* cells = std::get_if<CellsEdit>(&edit)) {
    if (cells->erase) taken = VoxelCanvas(cells->cells);
  } else if (const auto* bodies = std::get_if<BodyEdit>(&edit); bodies && bodies->before) {
    taken = VoxelCanvas(std::get<VoxelShape>(asVoxels(*bodies->before, spacing).shape).runs);
    if (bodies->after) taken.erase(VoxelCanvas(std::get<VoxelShape>(bodies->after->shape).runs).cells());
  }
  std::vector<std::vector<CellIndex>> byPalette;
  for (const VoxelCanvas::Entry& entry : taken.entries()) {
    const auto palette = static_cast<size_t>(entry.palette);
    if (palette >= byPalette.size()) byPalette.resize(palette + 1);
    byPalette[palette].push_back({entry.cell.x, entry.cell.y, entry.cell.z});
  }
  return byPalette;
}

std::vector<CellIndex> freeAtStart(const Project& project, const std::string& body, const VoxelShape& lattice,
                                   const std::vector<CellIndex>& cells) {
  const CellBounds bounds(lattice, cells);
  std::vector<Vector3> places;
  for (const Body& other : project.bodies) {
    if (other.id == body) continue;
    const std::vector<Vector3> centres = centresWithin(other, lattice.spacing, bounds);
    places.insert(places.end(), centres.begin(), centres.end());
  }
  OccupiedPlaces occupied(0.9 * lattice.spacing, places.size());
  for (const Vector3& p : places) occupied.add(double3Of(p));
  const SketchGrid grid = gridOf(lattice);
  std::vector<CellIndex> free;
  std::copy_if(cells.begin(), cells.end(), std::back_inserter(free), [&](const CellIndex& c) {
    return occupied.isFree(double3Of(grid.centreOf({c[0], c[1], c[2]})));
  });
  return free;
}

Body asVoxels(Body body, double spacing) {
  if (const auto* box = std::get_if<BoxShape>(&body.shape)) {
    body.shape = voxelsOf(*box, body, spacing);
  } else if (const auto* solid = std::get_if<SolidShape>(&body.shape)) {
    body.shape = voxelsOf(*solid, body, spacing);
  } else if (auto& voxels = std::get<VoxelShape>(body.shape); voxels.spacing != spacing) {
    withSpacing(voxels, spacing);
  }
  return body;
}

}  // namespace ps
