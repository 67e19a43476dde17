// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/ray.h"
#include "ui/render/renderer.h"

#include <optional>

// Pure functions on Camera and Eye: no context, no widgets. Pixels are device pixels, (0, 0) is the upper left corner,
// y runs down; `width` and `height` are those of the picture.
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

/// Where a picture is seen from and through which window: a camera, an eye of a headset, a mirror, a thumbnail.
struct Eye {
  Matrix4 view;        ///< world to eye: turned and moved only; the eye looks along -z, y is up
  Matrix4 projection;  ///< perspective with depth -1..1; its window need not be centred on the line of sight
};
Eye eyeOf(const Camera& camera, int width, int height);
/// An eye through whose window one sees from `left` to `right` and from `down` to `up`: tangents of the angles to the
/// line of sight, as headsets give them. Planes in m.
Eye eyeThrough(const Matrix4& view, double left, double right, double down, double up, double near, double far);
Vector3 placeOf(const Eye& eye);   ///< in the world, m
double nearPlane(const Eye& eye);  ///< m

/// From the eye; the direction has unit length.
Ray rayThrough(const Eye& eye, int width, int height, double x, double y);
Ray rayThrough(const Camera& camera, int width, int height, double x, double y);
/// Pixel x, pixel y and distance along the view direction in m, or nothing for a point behind the near plane.
std::optional<Vector3> project(const Eye& eye, int width, int height, const Vector3& world);
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

/// Index of the nearest particle that the ray hits, by its sphere; nothing when it hits none. Static particles count,
/// what a section cuts away does not.
std::optional<size_t> pickParticle(const Snapshot& snapshot, const Ray& ray,
                                   const std::optional<Section>& section = std::nullopt);
/// The same for the ray through a pixel.
std::optional<size_t> pickParticle(const Snapshot& snapshot, const Camera& camera, int width, int height, double x,
                                   double y);

}  // namespace ps
