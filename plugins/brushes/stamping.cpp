// SPDX-License-Identifier: Apache-2.0
#include "stamping.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ps::brushes {
namespace {

/// First and last cell of an interval along one axis.
struct Range {
  int32_t first, last;
};

constexpr double kReach = 1 << 30;

Range rangeOf(double centre, double origin, double extent, double spacing) {
  const double c = (centre - origin) / spacing, e = extent / spacing;
  if (!(std::abs(c) < kReach)) throw std::range_error("the stroke runs out of the lattice");
  if (!(e <= kMaxCells)) throw std::length_error("the brush is more than 1000 particles wide: make it smaller");
  return {static_cast<int32_t>(std::ceil(c - e)), static_cast<int32_t>(std::floor(c + e))};
}

int32_t cellAt(double place, double origin, double spacing) {
  const double c = (place - origin) / spacing;
  if (!(std::abs(c) < kReach)) throw std::range_error("the stroke runs out of the lattice");
  return static_cast<int32_t>(std::floor(c + 0.5));
}

}  // namespace

double parameter(const api::StrokeContext& context, size_t index, double fallback) {
  return index < context.parameters.size ? context.parameters[index] : fallback;
}

double pressedRadius(const api::StrokeContext& context, size_t index, double fallback, double pressure) {
  const double share = parameter(context, index, fallback);
  return context.radius * (1 - share * (1 - std::clamp(pressure, 0.0, 1.0)));
}

api::Cell cellAt(const api::StrokeContext& context, const api::Double3& place) {
  return {cellAt(place.x, context.origin.x, context.spacing), cellAt(place.y, context.origin.y, context.spacing),
          cellAt(place.z, context.origin.z, context.spacing)};
}

std::vector<api::Cell>& roomForCells() {
  constexpr size_t kMostKept = size_t{1} << 20;
  thread_local std::vector<api::Cell> room;
  room.clear();
  if (room.capacity() > kMostKept) room.shrink_to_fit();
  return room;
}

void cellsAround(const api::StrokeContext& context, const api::Double3& place, const api::Double3& extent,
                 const Inside& inside, std::vector<api::Cell>& cells) {
  const double dx = context.spacing;
  const Range x = rangeOf(place.x, context.origin.x, extent.x, dx);
  const Range y = rangeOf(place.y, context.origin.y, extent.y, dx);
  const Range z = rangeOf(place.z, context.origin.z, extent.z, dx);
  for (int32_t k = z.first; k <= z.last; ++k)
    for (int32_t j = y.first; j <= y.last; ++j)
      for (int32_t i = x.first; i <= x.last; ++i) {
        const api::Double3 offset{i * dx + context.origin.x - place.x, j * dx + context.origin.y - place.y,
                                  k * dx + context.origin.z - place.z};
        if (inside(offset)) cells.push_back({i, j, k});
      }
}

void stamp(const api::StrokeContext& context, const api::Double3& sample, const api::Double3& extent,
           const Inside& inside, std::vector<api::Cell>& cells) {
  cells.push_back(cellAt(context, sample));
  cellsAround(context, sample, extent, inside, cells);
}

}  // namespace ps::brushes
