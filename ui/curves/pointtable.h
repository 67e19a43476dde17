// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/pieces.h"

#include <phasesketch/parameter.h>

#include <QtCore/QString>

#include <vector>

namespace ps {

/// Points of a curve that somebody copied from a table.
struct PastedTable {
  std::vector<CurvePoint> points;  ///< ascending in x, in stored units
  QString problem;                 ///< "" or one sentence that says what is wrong with the text
};

/// Rows of two columns, divided by tabs, semicolons, spaces or commas, with points or commas in the numbers. A number
/// without a unit is of the heading's above its column, "T [K]", or else in the unit that people see.
PastedTable readTable(const QString& text, const api::ParameterDeclaration& x, const api::ParameterDeclaration& y);

}  // namespace ps
