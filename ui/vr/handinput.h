// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace ps::vr {

inline constexpr size_t kLeft = 0, kRight = 1;
inline constexpr double kTip = 0.06;  ///< m before where a hand aims from: there its brush is

/// What the hands are to their wearer: the main one draws, undoes and chooses, the other one erases, holds the palette,
/// plays and goes.
struct HandRoles {
  size_t main = kRight;
  bool alone = false;  ///< the main one alone is used: it brings the palette as well
  size_t other() const { return kLeft + kRight - main; }
  size_t goes() const { return alone ? main : other(); }  ///< whose stick takes its wearer somewhere
  bool operator==(const HandRoles&) const = default;
};

/// Where something is, in the floor's space; metres.
struct HandPose {
  Vector3 position{0, 0, 0};
  Quaternion orientation = Quaternion::Identity();
};

inline constexpr size_t kJoints = 26;  ///< of a bare hand
struct HandJoint {
  Vector3 position{0, 0, 0};  ///< m
  double radius = 0;          ///< m, to the skin
};
using HandJoints = std::array<HandJoint, kJoints>;

/// What a controller says at a time. Buttons are named after what they do (suggestions.h says which they are).
struct HandInput {
  std::optional<HandPose> grip;   ///< of the palm; nothing while the controller is asleep or out of sight
  std::optional<HandPose> aim;    ///< -z points where the hand does
  double draw = 0, hold = 0;      ///< how far trigger and grip are pressed, 0..1
  double steerX = 0, steerY = 0;  ///< stick or pad, -1..1, right and forward
  std::string_view profile;       ///< what it holds: of OpenXR, as suggestions() have it, or of handlabels.h; "": none
  bool bare = false;              ///< nothing: whoever reads hands tells how far it pinches and holds
  bool pad = false;               ///< a pad steers, which means something where it is pressed
  std::optional<HandJoints> joints;  ///< of a bare hand that is seen, in the floor's space
  bool points = false;               ///< a bare hand, of which the index alone is straight
  bool steerPressed = false, first = false, second = false;
  bool menu = false;  ///< asks for the palette
};

/// What a controller shall let feel.
struct Vibration {
  double amplitude = 0.5;  ///< 0..1
  double frequency = 0;    ///< Hz; 0 leaves it to the controller
  double duration = 0.01;  ///< s; 0 for the shortest that it can
};

}  // namespace ps::vr
