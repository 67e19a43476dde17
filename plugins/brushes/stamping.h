// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "borrowed.h"

#include <phasesketch/brush.h>

#include <vector>

namespace ps::brushes {

/// Largest brush, in cells from its centre to its rim; beyond it a stroke would fill the memory.
inline constexpr double kMaxCells = 500;

/// Value of a brush's parameter, or `fallback` when the host sent fewer.
double parameter(const api::StrokeContext& context, size_t index, double fallback);

/// Whether the cell of an offset in m from the middle of the stamp belongs to it.
using Inside = Borrowed<bool(const api::Double3&)>;

/// Appends the cells whose centres satisfy `inside` within a box of half extents `extent` (m) around a place. Throws
/// std::length_error for a box beyond kMaxCells, std::range_error for a place out of the lattice's reach.
void cellsAround(const api::StrokeContext& context, const api::Double3& place, const api::Double3& extent,
                 const Inside& inside, std::vector<api::Cell>& cells);
/// Likewise, and always the cell that holds the sample itself: a brush smaller than a cell still draws.
void stamp(const api::StrokeContext& context, const api::Double3& sample, const api::Double3& extent,
           const Inside& inside, std::vector<api::Cell>& cells);
/// The cell whose cube holds a place; one on a face belongs to the higher one. Throws std::range_error like these.
api::Cell cellAt(const api::StrokeContext& context, const api::Double3& place);
/// Room for the cells of a call of stroke(), empty: each thread keeps its own from call to call, so that strokes
/// allocate nothing from sample to sample.
std::vector<api::Cell>& roomForCells();
/// In spacings, far above rounding: of a place on a face it must not waver which of two cells is meant.
inline constexpr double kHair = 1e-9;
/// Whether the cell at an offset from a place lies within `half` of it, both in m: half open, as in cellAt().
inline bool reaches(double offset, double half, double hair) { return offset > -half + hair && offset <= half + hair; }

/// The declaration by which a light touch makes a brush smaller; to be read by pressedRadius().
constexpr api::ParameterDeclaration pressureSize(double fallback, const char* help) {
  return {"pressure_size",
          "Pen pressure",
          "",
          "",
          api::ParameterKind::Number,
          api::Scale::Linear,
          fallback,
          0,
          1,
          0,
          1,
          "%",
          100,
          0,
          "",
          "Brush",
          help,
          "0 % the same size always, 100 % from a single particle to full size",
          ""};
}
/// m, at a pressure of 0 .. 1; `index` of that declaration.
double pressedRadius(const api::StrokeContext& context, size_t index, double fallback, double pressure);

}  // namespace ps::brushes
