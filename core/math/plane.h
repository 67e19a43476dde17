// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"

namespace ps {

/// Where normal . p = offset; what lies on the normal's side is above it.
struct Plane {
  Vector3 normal;     ///< unit vector
  double offset = 0;  ///< m
  double heightOf(const Vector3& p) const { return normal.dot(p) - offset; }
};

}  // namespace ps
