// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "rotation.h"

#include <array>

namespace ps::constraint {

/// rotationOf() for `count` matrices, one in each lane (Highway): q[k] becomes what rotationOf(a[k], q[k], exact)
/// gives, to the last bit.
void findRotations(const Matrix* a, Quaternion* q, size_t count, double exact);

/// Shapes that are found at once, each in a lane.
constexpr size_t kShapeLanes = 8;
using ShapeLanes = std::array<double, kShapeLanes>;
using ShapeVectors = std::array<ShapeLanes, 3>;

/// Points of sum of masses 1, whose moments are given.
struct alignas(64) ShapeFits {
  ShapeVectors centre, restCentre;      ///< m
  std::array<ShapeVectors, 3> moments;  ///< m2, of x r^T, about the origins; afterwards rotation times scale
  std::array<ShapeLanes, 4> rotation;   ///< x, y, z, w: from where to start; afterwards the one that fits best
  ShapeLanes scale;                     ///< of the undeformed shape
  ShapeVectors offset;                  ///< m, out: where the undeformed frame's origin goes
};
/// rotationOf() for the shapes in the first `count` lanes. What stands in the others does not matter.
void fitShapes(ShapeFits& fits, size_t count, double exact);

}  // namespace ps::constraint
