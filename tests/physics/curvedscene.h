// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/solver/settings.h"

#include <cmath>
#include <numbers>
#include <vector>

/// What tests of curved walls share.
namespace curvedwalls {

using ps::Wall;
using ps::WallForm;

/// About the origin, without friction; a cylinder stands upright.
inline Wall curved(WallForm form, double radius, bool inside = true) {
  Wall wall;
  wall.form = form;
  wall.radius = radius;
  wall.inside = inside;
  wall.friction = 0;
  return wall;
}

/// Layers about the z axis, from `bottom` m on, of `count` rings each, a spacing apart; the first `first` spacings out.
inline std::vector<ps::api::Double3> rings(int first, int count, int layers, double spacing, double bottom) {
  std::vector<ps::api::Double3> points;
  for (int ring = first; ring < first + count; ++ring) {
    const double r = (ring + 0.5) * spacing;
    const int around = static_cast<int>(std::lround(2 * std::numbers::pi * r / spacing));
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * k / around;
      for (int z = 0; z < layers; ++z)
        points.push_back({r * std::cos(angle), r * std::sin(angle), bottom + (z + 0.5) * spacing});
    }
  }
  return points;
}

}  // namespace curvedwalls
