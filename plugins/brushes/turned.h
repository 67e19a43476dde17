// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/parameter.h>

namespace ps::brushes {

/// The declaration of a turn about the stroke's up direction, in rad; `help` says what turns.
constexpr api::ParameterDeclaration rotation(double most, const char* help, const char* example) {
  constexpr double kPi = 3.14159265358979323846;
  return {"rotation",
          "Rotation",
          "",
          "rad",
          api::ParameterKind::Number,
          api::Scale::Linear,
          0,
          -most,
          most,
          -2 * kPi,
          2 * kPi,
          "°",
          180 / kPi,
          0,
          "",
          "Brush",
          help,
          example,
          ""};
}

}  // namespace ps::brushes
