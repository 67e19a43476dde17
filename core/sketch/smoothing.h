// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/sketch/cellset.h"

#include <map>

namespace ps {

/// What smoothing does to a sketch; no cell is in two of them.
struct Smoothed {
  CellSet emptied;
  std::map<int, CellSet> filled;  ///< by palette entry
  bool empty() const { return emptied.empty() && filled.empty(); }
};

/// A median filter over the 33 cells within two of each, of those in `cells`: one that most of them leave alone goes,
/// a free one that most of them surround is filled with what most of its neighbours are. A flat face, and what is one
/// particle thick, stays as it is: edges and bumps go, hollows close. What becomes of a cell depends on the sketch
/// alone, so that a stroke comes to the same however it was cut into pieces.
Smoothed smoothed(const VoxelCanvas& sketch, const CellSet& cells);

}  // namespace ps
