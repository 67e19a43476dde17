// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>

namespace ps {

/// Particles in order of cell, as the search reads them; a slot is a place in that order. The arrays by slot hold 16
/// entries more than there are slots.
struct SearchGrid {
  const float *x, *y, *z;     ///< m, by slot
  const uint32_t* order;      ///< index of the particle in each slot
  const uint32_t* slotOf;     ///< slot of each particle, by index
  const uint32_t* cell;       ///< cell of each particle, by index; x fastest
  const uint32_t* cellStart;  ///< first slot of each cell; one entry more than there are cells
  int cells[3];
  double low[3], perMetre[3];  ///< where the first cell begins, m; cells of one metre
  float radiusSquared;         ///< m2
  float period[3];             ///< m, 0 along an open axis; else coordinates lie within one box, at least 3 cells long
};

/// Where the lists of some particles go.
struct ListRoom {
  uint32_t first, count;  ///< entries of `index` that there are for them; multiples of 16, or none at all
  uint32_t* index;
  uint32_t *begin, *last, *end;  ///< by particle
  uint32_t dummy;                ///< fills lists up
};

/// Writes the lists of the particles [first, last), one after another: the indices of those closer than the radius, in
/// order of slot and without the particle itself, filled up to a multiple of 16. Returns how many entries they need:
/// where that is more than there are, the lists are not whole.
size_t searchLists(const SearchGrid& grid, size_t first, size_t last, const ListRoom& room);

}  // namespace ps
