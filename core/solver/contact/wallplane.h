// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/plane.h"
#include "core/solver/settings.h"

#include <span>
#include <vector>

namespace ps {

/// The face of a wall, or the plane `inset` m before it.
inline Plane planeOf(const Wall& wall, double inset = 0) { return {vectorOf(wall.normal), wall.offset + inset}; }

/// The planes on which the centres of particles lie that touch walls, into memory that is used again.
inline void findContactPlanes(std::span<const Wall> walls, double spacing, std::vector<Plane>& planes) {
  planes.clear();
  for (const Wall& wall : walls) planes.push_back(planeOf(wall, 0.5 * spacing));
}

/// The same as planeOf() for loops over particles, in single precision.
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

}  // namespace ps
