// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/tool.h"

// What lies under a pointer, and lengths of the scene.
namespace ps {

struct Surface {
  Vector3 point{0, 0, 0};   ///< m
  Vector3 normal{0, 0, 0};  ///< unit; zero in the air
};

/// What the pointer's ray meets first: matter, else the floor within the bounds, else the air at the depth one looks
/// at. Nothing where the ray runs away from all of them.
std::optional<Surface> surfaceUnder(const Pointer& pointer, const Environment& environment);
/// Unit vector away from the matter that is shown around a point of its surface, from farther around than a Surface
/// tells it and along no axis but where it is one within 3 degrees.
Vector3 facingAt(const Pointer& pointer, const Vector3& point);
/// Where the pointer's ray meets matter first that is shown.
std::optional<Vector3> matterOn(const Pointer& pointer);
/// m, of the highest level wall, or of the bounds.
double floorHeight(const Environment& environment);
/// m, of the matter that is shown straight below a point, else of the floor.
double heightBelow(const Pointer& pointer, const Vector3& point, const Environment& environment);
/// m, of the particles as they are shown; `fallback` where there are none.
double shownSpacing(const Pointer& pointer, double fallback);

}  // namespace ps
