// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/halfspace.h"
#include "core/math/wallface.h"
#include "core/solver/settings.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace ps {

/// The faces on which the centres of particles lie that touch walls, into memory that is used again.
inline void findContactFaces(std::span<const Wall> walls, double spacing, std::vector<WallFace>& faces) {
  faces.clear();
  for (const Wall& wall : walls) faces.push_back(faceOf(wall, 0.5 * spacing));
}

/// How the face of a wall bends, for what half spaces are a first guess at.
inline Bend bendOf(const Wall& wall) {
  if (wall.form == WallForm::Plane) return {};
  return {wall.inside ? wall.radius : -wall.radius, wall.form == WallForm::Sphere ? 1.0 : 0.5};
}

/// A plane for loops over particles, in single precision.
struct WallPlane {
  float x = 0, y = 1, z = 0, offset = 0;  ///< unit normal into the scene; m
  float friction = 0;

  explicit WallPlane(const Wall& wall, double inset = 0)
      : x(static_cast<float>(wall.normal.x)),
        y(static_cast<float>(wall.normal.y)),
        z(static_cast<float>(wall.normal.z)),
        offset(static_cast<float>(wall.offset + inset)),
        friction(static_cast<float>(wall.friction)) {}
  explicit WallPlane(const Plane& plane)
      : x(static_cast<float>(plane.normal.x())),
        y(static_cast<float>(plane.normal.y())),
        z(static_cast<float>(plane.normal.z())),
        offset(static_cast<float>(plane.offset)) {}
  WallPlane() = default;
  /// m, negative behind it.
  float heightOf(const api::Float4& p) const { return x * p.x + y * p.y + z * p.z - offset; }
};

/// The face of a wall for loops over particles, in single precision.
struct WallSurface {
  WallPlane plane;                              ///< of a plane
  float centreX = 0, centreY = 0, centreZ = 0;  ///< m
  float axisX = 0, axisY = 0, axisZ = 0;        ///< unit vector of a cylinder; zero of a sphere
  float radius = 0;                             ///< m, of the face
  float side = 0;                               ///< 1 matter outside, -1 inside; 0: a plane

  WallSurface() = default;
  explicit WallSurface(const Wall& wall, double inset = 0) : plane(wall, inset) {
    if (wall.form == WallForm::Plane) return;
    const WallFace face = faceOf(wall, inset);
    const api::Float4 centre = float4Of(face.centre(), 0), axis = float4Of(face.axis(), 0);
    centreX = centre.x, centreY = centre.y, centreZ = centre.z;
    axisX = axis.x, axisY = axis.y, axisZ = axis.z;
    radius = static_cast<float>(face.radius());
    side = wall.inside ? -1.0f : 1.0f;
  }
  bool isCurved() const { return side != 0; }
  /// m, negative behind it.
  float heightOf(const api::Float4& p) const {
    if (!isCurved()) return plane.heightOf(p);
    const api::Float4 out = fromMiddle(p);
    return side * (out.w - radius);
  }
  /// The plane that touches it where it is nearest to a place.
  WallPlane at(const api::Float4& p) const {
    if (!isCurved()) return plane;
    const api::Float4 out = fromMiddle(p);
    WallPlane touching = plane;
    if (out.w > 0) {
      touching.x = side * out.x / out.w, touching.y = side * out.y / out.w, touching.z = side * out.z / out.w;
    } else {
      const Vector3 any = across();
      touching.x = side * static_cast<float>(any.x()), touching.y = side * static_cast<float>(any.y());
      touching.z = side * static_cast<float>(any.z());
    }
    touching.offset = touching.x * p.x + touching.y * p.y + touching.z * p.z - side * (out.w - radius);
    return touching;
  }
  /// From the centre, or straight from the axis, and in w how far that is, m.
  api::Float4 fromMiddle(const api::Float4& p) const {
    const float x = p.x - centreX, y = p.y - centreY, z = p.z - centreZ;
    const float along = axisX * x + axisY * y + axisZ * z;
    const float a = x - along * axisX, b = y - along * axisY, c = z - along * axisZ;
    return {a, b, c, std::sqrt(a * a + b * b + c * c)};
  }

 private:
  /// Some direction away from the middle.
  Vector3 across() const {
    const Vector3 axis(double{axisX}, double{axisY}, double{axisZ});
    return WallFace::cylinder(Vector3::Zero(), axis, 1, false).at(Vector3::Zero()).normal;
  }
};

}  // namespace ps
