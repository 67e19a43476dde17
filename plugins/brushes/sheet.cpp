// SPDX-License-Identifier: Apache-2.0
#include "sheet.h"

#include "stamp.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ps::brushes {

void stampSheets(const api::StrokeContext& context, const Frame& frame, double reach,
                 const api::List<api::StrokeSample>& samples, api::EditKind kind,
                 const std::function<bool(double side, double front)>& inside, api::EditSink& sink) {
  const double dx = context.spacing, hair = 1e-9 * dx;
  const double half = dx / 2 * std::max({std::abs(frame.up.x), std::abs(frame.up.y), std::abs(frame.up.z)});
  const Double3 extent = extentOf(frame, {dx, reach, reach});
  std::vector<api::Cell> cells;
  alongWay(context, samples, 0, [&](const Section& section) {
    cells.clear();
    const auto within = [&](const Double3& d) {
      const double height = dot(d, frame.up);
      return height >= -half - hair && height < half - hair && inside(dot(d, frame.side), dot(d, frame.front));
    };
    stamp(context, section.centre, extent, within, cells);
    sink.submit(kind, {cells.data(), cells.size()});
  });
}

}  // namespace ps::brushes
