// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"

namespace ps {

/// How something that draws is held.
struct Held {
  Held(double pressed) : pressure(pressed) {}  // NOLINT: a mouse says no more
  Held(double pressed, const Vector3& turned) : pressure(pressed), turn(turned) {}
  double pressure;        ///< 0 .. 1
  Vector3 turn{0, 0, 0};  ///< as in api::StrokeSample, against strokeAxes() of what is drawn on
};

}  // namespace ps
