// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <optional>

namespace ps {

/// A plane to draw on, apart from any camera type.
struct StrokePlane {
  Vec3 point{0, 0, 0};   ///< m
  Vec3 normal{0, 1, 0};  ///< unit vector towards the viewer
};

/// The plane through a point that suits a view direction (level when looking down or up, else upright).
StrokePlane strokePlaneThrough(const Vec3& point, const Vec3& viewDirection);
/// Where a ray meets it, m.
std::optional<Vec3> meetStrokePlane(const StrokePlane& plane, const Vec3& origin, const Vec3& direction);

}  // namespace ps
