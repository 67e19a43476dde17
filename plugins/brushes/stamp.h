// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/brush.h>

#include <functional>
#include <vector>

namespace ps::brushes {

/// Largest brush, in cells from its centre to its rim; beyond it a stroke would fill the memory.
inline constexpr double kMaxCells = 500;

/// Value of a brush's parameter, or `fallback` when the host sent fewer.
double parameter(const api::StrokeContext& context, size_t index, double fallback);

/// Appends the cells whose centres satisfy `inside` (offset in m from the sample) within a box of half extents `extent`
/// (m) around the sample, and always the cell that holds the sample itself: a brush smaller than a cell still draws.
/// Throws std::length_error for a box beyond kMaxCells, std::range_error for a sample out of the lattice's reach.
void stamp(const api::StrokeContext& context, const api::Double3& sample, const api::Double3& extent,
           const std::function<bool(const api::Double3&)>& inside, std::vector<api::Cell>& cells);

}  // namespace ps::brushes
