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

/// Values of kFollowing.
inline constexpr double kFollowsNothing = 0, kFollowsRotation = 1;
/// What a brush follows of how a pen or a hand is turned; see following().
inline constexpr api::ParameterDeclaration kFollowing = {
    "follows",
    "Follows the pen",
    "",
    "",
    api::ParameterKind::Choice,
    api::Scale::Linear,
    kFollowsRotation,
    0,
    2,
    0,
    2,
    "",
    1,
    0,
    "nothing|rotation|pose",
    "Brush",
    "Whether it turns with a pen or a hand: not at all, about the up direction as far as they are turned about it, or "
    "wholly, with the tilt of the pen and the pose of the hand. A mouse turns nothing.",
    "rotation: the barrel of a pen, pose: a hand in VR",
    ""};

}  // namespace ps::brushes
