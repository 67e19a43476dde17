// SPDX-License-Identifier: Apache-2.0
#include "sheet.h"

#include "stamping.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ps::brushes {

void stampSheets(const api::StrokeContext& context, const Frame& upright, double how, double reach,
                 const api::List<api::StrokeSample>& samples, api::EditKind kind,
                 const Borrowed<bool(double side, double front)>& inside, api::EditSink& sink) {
  const double dx = context.spacing;
  std::vector<api::Cell>& cells = roomForCells();
  alongWay(context, samples, 0, [&](const Section& section) {
    const Frame frame = held(upright, section.turn, how);
    // Cells lie as in cellAt(), from whichever side one draws: by the component of up along the axis it is nearest to.
    const double steepest =
        std::max({frame.up.x, frame.up.y, frame.up.z}, [](double a, double b) { return std::abs(a) < std::abs(b); });
    const double half = dx / 2 * std::abs(steepest), side = std::copysign(1.0, steepest);
    cells.clear();
    const auto within = [&](const Double3& d) {
      return reaches(side * dot(d, frame.up), half, kHair * dx) && inside(dot(d, frame.side), dot(d, frame.front));
    };
    cellsAround(context, section.centre, extentOf(frame, {dx, reach, reach}), within, cells);
    if (cells.empty()) cells.push_back(cellAt(context, section.centre));  // smaller than a cell
    sink.submit(kind, {cells.data(), cells.size()});
  });
}

}  // namespace ps::brushes
