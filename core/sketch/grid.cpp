// SPDX-License-Identifier: Apache-2.0
#include "core/sketch/grid.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

int32_t indexOn(double coordinate, double origin, double spacing) {
  constexpr double kReach = 1 << 30;
  const double index = std::floor((coordinate - origin) / spacing + 0.5);
  // The comparison sends NaN to the end as well: a conversion of NaN to an integer is undefined.
  if (!(index < kReach)) return 1 << 30;
  return static_cast<int32_t>(std::max(index, -kReach));
}

}  // namespace

api::Cell SketchGrid::cellAt(const Vector3& point) const {
  const Vector3 own = pose.isNothing() ? point : pose.inverse().of(point);
  return {indexOn(own[0], origin[0], spacing), indexOn(own[1], origin[1], spacing),
          indexOn(own[2], origin[2], spacing)};
}

Vector3 SketchGrid::centreOf(const api::Cell& cell) const {
  const Vector3 own(cell.x * spacing + origin[0], cell.y * spacing + origin[1], cell.z * spacing + origin[2]);
  return pose.isNothing() ? own : pose.of(own);
}

}  // namespace ps
