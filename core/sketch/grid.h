// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/rigidmove.h"
#include "core/math/vector.h"

#include <phasesketch/brush.h>

#include <compare>

namespace ps {

/// Order of cells everywhere in this room: by z, then y, then x, so that rows along x lie together.
constexpr std::strong_ordering compareCells(const api::Cell& a, const api::Cell& b) {
  if (const auto z = a.z <=> b.z; z != 0) return z;
  if (const auto y = a.y <=> b.y; y != 0) return y;
  return a.x <=> b.x;
}
constexpr bool sameCell(const api::Cell& a, const api::Cell& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// A cubic lattice of cells of edge `spacing` (m, > 0); cell (0, 0, 0) is centred at `origin` (m), and all of it stands
/// where the pose takes it.
struct SketchGrid {
  Vector3 origin{0, 0, 0};
  double spacing = 0.02;
  RigidMove pose{};

  /// The cell whose cube holds the point: p = floor((Q - C)/dx + 1/2), on each axis of the lattice. A point on a face
  /// belongs to the cell of the higher index. Points farther away than 2^30 cells (and NaN) are taken to the last cell
  /// in reach.
  api::Cell cellAt(const Vector3& point) const;
  /// Centre of a cell in m: Q = p dx + C, as the pose takes it.
  Vector3 centreOf(const api::Cell& cell) const;
};

}  // namespace ps
