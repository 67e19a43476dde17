// SPDX-License-Identifier: Apache-2.0
#include "balls.h"

namespace ps::brushes {

void submitBalls(const api::StrokeContext& context, api::EditKind kind, const api::List<api::StrokeSample>& samples,
                 api::EditSink& sink) {
  std::vector<api::Cell>& cells = roomForCells();
  for (size_t s = 0; s < samples.count; ++s) {
    const api::StrokeSample sample = samples.at(s);
    const double radius = pressedRadius(context, 0, kPressureSize, sample.pressure);
    // Centres on the rim count; the allowance is far above rounding and far below a cell.
    const double limit = radius * radius * (1 + 1e-9);
    cells.clear();
    stamp(
        context, sample.position, {radius, radius, radius},
        [&](const api::Double3& d) { return d.x * d.x + d.y * d.y + d.z * d.z <= limit; }, cells);
    sink.submit(kind, {cells.data(), cells.size()});
  }
}

}  // namespace ps::brushes
