// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/sketch/drawingplane.h"
#include "ui/tools/tool.h"

#include <optional>

// What can be said of a pointer's aim without a picture.
namespace ps {

/// Id of what is shown before it is there.
inline constexpr const char* kPreviewId = "?";

/// Whether it has left the place where it was pressed: by more than a click may wander.
bool wandered(const Pointer& pressed, const Pointer& now);
/// Where a place is seen from a pointer, in units of its fineness (pixels, of a mouse) right and up of where it aims.
/// Nothing behind it.
struct Aim {
  double x = 0, y = 0;
};
std::optional<Aim> aimTo(const Pointer& pointer, const Vector3& place);
/// Where a place lies in the picture of who looks along the pointer's `forward`, right and up of its middle, by the
/// tangents of the angles: what is straight across the picture is so in these. Nothing behind the viewer.
std::optional<Aim> inPicture(const Pointer& pointer, const Vector3& place);
/// How far from the aim a straight line between two places is seen, in the same units; infinite where it is behind.
double aimDistance(const Pointer& pointer, const Vector3& from, const Vector3& to);
/// The place of the line that is seen nearest to the aim, m. Nothing where an end of it is behind.
std::optional<Vector3> nearestPlace(const Pointer& pointer, const Vector3& from, const Vector3& to);

/// Upright, facing the viewer.
DrawingPlane uprightThrough(const Vector3& point, const Vector3& forward);

}  // namespace ps
