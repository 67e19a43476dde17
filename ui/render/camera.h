// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/ray.h"
#include "ui/render/renderer.h"

#include <optional>

// Pure functions on Camera: no context, no widgets. Pixels are device pixels, (0, 0) is the upper left corner, y runs
// down; `width` and `height` are those of the picture.
namespace ps {

/// Orthonormal, in world coordinates; `forward` points into the picture. Defined for every angle, straight down
/// included.
struct CameraFrame {
  Vector3 eye, right, up, forward;
};
CameraFrame frameOf(const Camera& camera);

double nearPlane(const Camera& camera);  ///< m
double farPlane(const Camera& camera);   ///< m
Matrix4 viewMatrix(const Camera& camera);
/// Perspective with depth -1..1; `fieldOfView` is the vertical one.
Matrix4 projectionMatrix(const Camera& camera, int width, int height);

/// From the eye; the direction has unit length.
Ray rayThrough(const Camera& camera, int width, int height, double x, double y);
/// Pixel x, pixel y and distance along the view direction in m, or nothing for a point behind the near plane.
std::optional<Vector3> project(const Camera& camera, int width, int height, const Vector3& world);
/// Size of a pixel at `depth` metres along the view direction, m.
double pixelSize(const Camera& camera, int height, double depth);

/// Turns around the target: degrees to the right and up; elevation stays within +-90.
void orbit(Camera& camera, double azimuth, double elevation);
/// Moves sideways so that what is at the target's depth follows the mouse by (dx, dy) pixels.
void pan(Camera& camera, int height, double dx, double dy);
/// Multiplies the distance by `factor`; the point under pixel (x, y) at the target's depth stays under it.
/// The distance stays within 1 mm and 1 km.
void dollyTo(Camera& camera, int width, int height, double x, double y, double factor);
/// Same angles, nearest distance from which the sphere around the box is whole in the picture.
void frameAll(Camera& camera, int width, int height, const Vector3& minimum, const Vector3& maximum);

/// Index of the nearest particle that the ray through the pixel hits, by its sphere; nothing when it hits none.
/// Static particles count.
std::optional<size_t> pickParticle(const Snapshot& snapshot, const Camera& camera, int width, int height, double x,
                                   double y);
/// Where a ray meets a plane, or nothing when it is parallel or behind the origin.
std::optional<Vector3> meetPlane(const Ray& ray, const Vector3& point, const Vector3& normal);

}  // namespace ps
