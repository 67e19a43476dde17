// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/ray.h"

#include <optional>

namespace ps {

/// The plane that the pointer draws on.
struct DrawingPlane {
  Vector3 point{0, 0, 0};   ///< m
  Vector3 normal{0, 1, 0};  ///< towards the viewer; any length but zero
};

/// Where a ray meets the plane, in m. Nothing when it runs away from the plane, along it (within 0.06 degrees), or
/// meets it farther than `reach` m away: a pointer above the horizon draws nothing.
std::optional<Vector3> meet(const Ray& ray, const DrawingPlane& plane, double reach = 1e4);

/// The plane through `point` that suits a view direction: level while the camera looks down or up by more than 15
/// degrees, otherwise the upright plane across the axis (x or z) along which the camera looks most. Its unit normal
/// faces the camera.
DrawingPlane drawingPlaneFor(const Vector3& point, const Vector3& viewDirection);

}  // namespace ps
