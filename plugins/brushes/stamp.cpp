// SPDX-License-Identifier: Apache-2.0
#include "stamp.h"

#include <cmath>
#include <stdexcept>

namespace ps::brushes {
namespace {

/// First and last cell of an interval, and the cell of its centre, along one axis.
struct Range {
  int32_t first, last, centre;
};

Range rangeOf(double centre, double origin, double extent, double spacing) {
  constexpr double kReach = 1 << 30;
  const double c = (centre - origin) / spacing, e = extent / spacing;
  if (!(std::abs(c) < kReach)) throw std::range_error("the stroke runs out of the lattice");
  if (!(e <= kMaxCells)) throw std::length_error("the brush is more than 1000 particles wide: make it smaller");
  return {static_cast<int32_t>(std::ceil(c - e)), static_cast<int32_t>(std::floor(c + e)),
          static_cast<int32_t>(std::floor(c + 0.5))};
}

}  // namespace

double parameter(const api::StrokeContext& context, size_t index, double fallback) {
  return index < context.parameters.size ? context.parameters[index] : fallback;
}

void stamp(const api::StrokeContext& context, const api::Double3& sample, const api::Double3& extent,
           const std::function<bool(const api::Double3&)>& inside, std::vector<api::Cell>& cells) {
  const double dx = context.spacing;
  const Range x = rangeOf(sample.x, context.origin.x, extent.x, dx);
  const Range y = rangeOf(sample.y, context.origin.y, extent.y, dx);
  const Range z = rangeOf(sample.z, context.origin.z, extent.z, dx);
  cells.push_back({x.centre, y.centre, z.centre});
  for (int32_t k = z.first; k <= z.last; ++k)
    for (int32_t j = y.first; j <= y.last; ++j)
      for (int32_t i = x.first; i <= x.last; ++i) {
        const api::Double3 offset{i * dx + context.origin.x - sample.x, j * dx + context.origin.y - sample.y,
                                  k * dx + context.origin.z - sample.z};
        if (inside(offset)) cells.push_back({i, j, k});
      }
}

}  // namespace ps::brushes
