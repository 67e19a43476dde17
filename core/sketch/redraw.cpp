// SPDX-License-Identifier: Apache-2.0
#include "core/sketch/redraw.h"

#include "core/base/error.h"
#include "core/sketch/smoothing.h"
#include "core/sketch/stroke.h"

namespace ps {

namespace {

/// What the sketch holds already stops it as others do.
CellSet floodedIn(const VoxelCanvas& canvas, const SketchGrid& grid, const CellSet& seeds, const Vector3& gravity,
                  const FreeOf& freeOf, const BarrierOf& barrierOf) {
  const CellSet own = canvas.cells();
  const FreeOf free = [&](const SketchGrid& lattice, const CellSet& cells) {
    CellSet outside = cells;
    outside.remove(own.cells());
    return freeOf(lattice, outside);
  };
  return flooded(grid, seeds, {}, gravity, free, kMaxStrokeCells, barrierOf);
}

}  // namespace

VoxelShape redrawn(const VoxelShape& shape, double spacing, const FreeOf& freeOf, const BrushOf& brushOf,
                   const Vector3& gravity, const MatterBeside& matter, const BarrierOf& barrierOf) {
  VoxelShape out = shape;
  if (out.spacing != spacing) out.origin = Vector3::Constant(spacing / 2);
  out.spacing = spacing;
  VoxelCanvas canvas;
  MatterWithin within;
  if (matter)
    within = [&](const Vector3& centre, double radius) {
      out.runs = canvas.runs();
      return matter(out, centre, radius);
    };
  for (const VoxelShape::Stroke& stroke : shape.strokes) {
    if (stroke.hidden) continue;
    const api::BrushPlugin* brush = brushOf(stroke.brush);
    if (!brush) throw InputError("the brush \"" + stroke.brush + "\" is not installed");
    const SketchGrid grid = gridOf(out);
    const StrokeEdits edits = replayStroke(*brush, stroke, grid, within);
    canvas.erase(edits.removed);
    canvas.paint(freeOf(grid, edits.added), stroke.palette);
    if (!edits.filled.empty())
      canvas.paint(floodedIn(canvas, grid, edits.filled, gravity, freeOf, barrierOf), stroke.palette);
    const Smoothed smooth = edits.smoothed.empty() ? Smoothed{} : smoothed(canvas, edits.smoothed);
    canvas.erase(smooth.emptied);
    for (const auto& [palette, cells] : smooth.filled) canvas.paint(freeOf(grid, cells), palette);
    const bool colours = !edits.coloured.empty();
    if (!colours && edits.painted.empty()) continue;
    out.runs = canvas.runs();
    const std::string coat = colours ? colourOf(*brush, setupOf(*brush, stroke, grid))
                                     : out.palette.at(static_cast<size_t>(stroke.palette)).material;
    const Repainted painted = repainted(out, colours ? edits.coloured : edits.painted, coat);
    out.palette.insert(out.palette.end(), painted.added.begin(), painted.added.end());
    replaceRuns(out, painted.after);
    canvas = VoxelCanvas(out.runs);
  }
  out.runs = canvas.runs();
  return out;
}

}  // namespace ps
