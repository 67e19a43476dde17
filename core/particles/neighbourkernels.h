// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ps {

/// Particles in order of cell, as the search reads them; a slot is a place in that order. The coordinate arrays hold 16
/// entries more than there are slots.
struct SearchGrid {
  const float *x, *y, *z;     ///< m
  const uint32_t* cell;       ///< cell of each slot, x fastest
  const uint32_t* cellStart;  ///< first slot of each cell; one entry more than there are cells
  int cells[3];
  float radiusSquared;  ///< m2
  float period[3];      ///< m, 0 along an open axis; else coordinates lie within one box, at least 3 cells long
};

/// Writes to the front of `found` the slots closer than the radius to each slot of [first, last), ascending, without
/// the slot itself, and their number to counts[slot - first]. `found` grows where it must, and is never shorter after.
void searchSlots(const SearchGrid& grid, size_t first, size_t last, uint32_t* counts, std::vector<uint32_t>& found);

}  // namespace ps
