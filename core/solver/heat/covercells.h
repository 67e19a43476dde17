// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/types.h>

#include <cstddef>
#include <cstdint>

// Directions to neighbours in cells: six faces of a cube, each of kCoverCells x kCoverCells. Found a vector of
// neighbours at a time (Highway), with the same roundings on every instruction set.
namespace ps {

/// Odd, so that neighbours along an axis meet the middle of a cell.
inline constexpr int kCoverCells = 33;
/// Faces lie at +x, -x, +y and so on; of the other two axes the later one runs fastest.
size_t coverCellOf(float x, float y, float z);

/// Neighbours that are asked for at once, and room for those that are found: as many, and a vector more.
inline constexpr size_t kCoverTile = 64, kCoverRoom = kCoverTile + 16;
/// Writes those of `list`, kCoverTile at most, whose squared distance in m2 from particle i is from `least` to `most`,
/// and their cells; returns how many.
size_t findCoverCells(const api::Float4* at, uint32_t i, const uint32_t* list, size_t count, float least, float most,
                      uint32_t* neighbour, uint32_t* cell);

}  // namespace ps
