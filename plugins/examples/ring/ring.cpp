// SPDX-License-Identifier: MIT
#include "ring.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace {

using namespace ps::api;

constexpr double kThickness = 0.3;
constexpr double kMostCells = 500;  // from the centre to the rim; beyond it one stamp would fill the memory

constexpr ParameterDeclaration kParameters[] = {
    {"thickness", "Thickness", "", "", ParameterKind::Number, Scale::Linear, kThickness, 0.05, 1, 0, 1, "%", 100, 0, "",
     "Brush", "Thickness of the ring as a share of its radius; it never gets thinner than what holds together.",
     "wedding ring 10 %, doughnut 60 %", ""}};

/// Radius of the ring's tube in m; at least half a cell's diagonal, so that the ring has no gaps.
double tubeOf(const StrokeContext& context) {
  const double share = context.parameters.size > 0 ? context.parameters[0] : kThickness;
  return std::max(0.5 * share * context.radius, 0.5 * std::sqrt(3.0) * context.spacing);
}

struct Range {
  int32_t first, last;
};
Range rangeOf(double centre, double origin, double reach, double spacing) {
  const double c = (centre - origin) / spacing, r = reach / spacing;
  if (!(std::abs(c) < 1e9)) throw std::range_error("the stroke runs out of the lattice");
  if (!(r <= kMostCells)) throw std::length_error("the ring is more than 1000 particles wide: make it smaller");
  return {static_cast<int32_t>(std::ceil(c - r)), static_cast<int32_t>(std::floor(c + r))};
}

/// Whether an offset in m from the stamp's middle lies within the tube.
bool inside(const Double3& d, const Double3& up, double radius, double tube) {
  const double height = d.x * up.x + d.y * up.y + d.z * up.z;
  const double squared = d.x * d.x + d.y * d.y + d.z * d.z - height * height;
  const double off = std::sqrt(std::max(0.0, squared)) - radius;
  return off * off + height * height <= tube * tube;
}

}  // namespace

Ring::Ring()
    : Described({"Ring",
                 "Stamps a ring that lies flat: all cells whose centres are within the tube around a circle of the "
                 "brush's radius. It knows the lattice only, not what stands in the way.",
                 listOf(kParameters)}) {}

void Ring::stroke(const StrokeContext& context, EditKind kind, const List<StrokeSample>& samples,
                  EditSink& sink) const {
  const double tube = tubeOf(context), reach = context.radius + tube;
  std::vector<Cell> cells;
  for (size_t s = 0; s < samples.count; ++s) {
    const StrokeSample sample = samples.at(s);
    const Range x = rangeOf(sample.position.x, context.origin.x, reach, context.spacing);
    const Range y = rangeOf(sample.position.y, context.origin.y, reach, context.spacing);
    const Range z = rangeOf(sample.position.z, context.origin.z, reach, context.spacing);
    cells.clear();
    for (int32_t k = z.first; k <= z.last; ++k)
      for (int32_t j = y.first; j <= y.last; ++j)
        for (int32_t i = x.first; i <= x.last; ++i) {
          const Double3 offset{i * context.spacing + context.origin.x - sample.position.x,
                               j * context.spacing + context.origin.y - sample.position.y,
                               k * context.spacing + context.origin.z - sample.position.z};
          if (inside(offset, context.up, context.radius, tube)) cells.push_back({i, j, k});
        }
    sink.submit(kind, {cells.data(), cells.size()});
  }
}

Double3 Ring::extent(const StrokeContext& context) const noexcept {
  const double reach = context.radius + tubeOf(context);
  return {reach, reach, reach};
}
