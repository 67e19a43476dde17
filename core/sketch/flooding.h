// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/sketch/cellset.h"

#include <functional>

namespace ps {

/// Those of some cells of a lattice that may be filled: not where others are, nor outside of the scene.
using FreeOf = std::function<CellSet(const SketchGrid& grid, const CellSet& cells)>;

/// Of cells that nothing runs into: what stops it there.
enum class Barrier { Matter, Wall, SceneEdge };
using BarrierOf = std::function<Barrier(const SketchGrid& grid, const api::Cell& cell)>;
/// What of a scene alone stops it: the end of its bounds counts as an edge where no wall stands before it and the scene
/// does not repeat itself.
Barrier barrierIn(const Environment& environment, const SketchGrid& grid, const api::Cell& cell);

/// Cells that one stroke lets run full while somebody draws: what can be drawn at a time.
inline constexpr size_t kMostFlooded = 32768;

/// What runs full from `seeds`: the free ones of them, and from each all free cells that are reached through the faces
/// of free ones, none of them higher against `gravity` (m/s2; zero: y is up) than that seed. A seed that is not free
/// stands for the cell above it: the pointer meets the bottom of a hollow in the matter that it is made of. Seeds that
/// stand in `filled`, or in what an earlier one has filled, add nothing, so that it comes to the same however a stroke
/// was cut into pieces that rise. What it fills is not in `filled`. Throws InputError where both would be more than
/// `most`: it runs out, or is too large. Where `barrierOf` says what stops it, a hollow that is open is refused
/// likewise: one from which it would run to an edge of the scene, or to the walls of the room through a gap of one or
/// two cells or over a rim that it stands above by less than the hollow is deep. A tray of walls fills, and so does
/// what is open on to a place that has no such wall; a ring on the floor with a wide door cannot be told from its room.
/// Advances the thread's progress by each cell that it comes to, and throws Cancelled.
CellSet flooded(const SketchGrid& grid, const CellSet& seeds, const CellSet& filled, const Vector3& gravity,
                const FreeOf& freeOf, size_t most = kMostFlooded, const BarrierOf& barrierOf = {});

}  // namespace ps
