// SPDX-License-Identifier: Apache-2.0
#include "sphere.h"

#include "stamp.h"

namespace {

using ps::api::Double3;

constexpr double kPressureSize = 0.5;
constexpr ps::api::ParameterDeclaration kParameters[] = {ps::brushes::pressureSize(
    kPressureSize, "How far a light touch of the pen makes the ball smaller; a mouse always presses fully.")};

}  // namespace

SphereBrush::SphereBrush()
    : Described({"Sphere",
                 "Draws a round strand: every cell whose centre is within the radius of the stroke is filled, or "
                 "emptied. It knows the lattice only, not what stands in the way; occupied cells are left as they are.",
                 ps::api::listOf(kParameters)}) {}

void SphereBrush::stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                         const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const {
  std::vector<ps::api::Cell> cells;
  for (size_t s = 0; s < samples.count; ++s) {
    const ps::api::StrokeSample sample = samples.at(s);
    const double radius = ps::brushes::pressedRadius(context, 0, kPressureSize, sample.pressure);
    // Centres on the rim count; the allowance is far above rounding and far below a cell.
    const double limit = radius * radius * (1 + 1e-9);
    cells.clear();
    ps::brushes::stamp(
        context, sample.position, {radius, radius, radius},
        [&](const Double3& d) { return d.x * d.x + d.y * d.y + d.z * d.z <= limit; }, cells);
    sink.submit(kind, {cells.data(), cells.size()});
  }
}

ps::api::Double3 SphereBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return {context.radius, context.radius, context.radius};
}
