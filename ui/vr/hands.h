// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"
#include "ui/vr/session.h"

#include <Eigen/Geometry>
#include <array>
#include <optional>

namespace ps::vr {

inline constexpr size_t kLeft = 0, kRight = 1;

/// Where something is, in the floor's space; metres.
struct HandPose {
  Vector3 position{0, 0, 0};
  Quaternion orientation = Quaternion::Identity();
};

/// What a controller says at a time. Buttons are named after what they do (suggestions.h says which they are).
struct HandInput {
  std::optional<HandPose> grip;   ///< of the palm; nothing while the controller is asleep or out of sight
  std::optional<HandPose> aim;    ///< -z points where the hand does
  Vector3 velocity{0, 0, 0};      ///< of the grip, m/s; 0 where it is not known
  double draw = 0, hold = 0;      ///< how far trigger and grip are pressed, 0..1
  double steerX = 0, steerY = 0;  ///< stick or pad, -1..1, right and forward
  bool steerPressed = false, first = false, second = false;
};

/// What a controller shall let feel.
struct Vibration {
  double amplitude = 0.5;  ///< 0..1
  double frequency = 0;    ///< Hz; 0 leaves it to the controller
  double duration = 0.01;  ///< s; 0 for the shortest that it can
};

/// The actions of both hands. Calls throw Failure.
class Hands {
 public:
  /// Makes the actions, suggests what they hang on, and attaches them to the session.
  Hands(Runtime& runtime, Session& session);
  ~Hands();
  Hands(const Hands&) = delete;
  Hands& operator=(const Hands&) = delete;

  /// Reads both controllers; once a frame. While the session has not the focus, hands are still and nowhere.
  void sync();
  HandInput input(size_t hand, XrTime time) const;
  void vibrate(size_t hand, const Vibration& vibration);

 private:
  XrAction make(const char* name, const char* label, XrActionType type);
  void makeActions();
  void suggest();
  void attach();
  XrActionStateGetInfo stateInfo(XrAction action, size_t hand) const;
  bool pressed(XrAction action, size_t hand) const;
  double number(XrAction action, size_t hand) const;
  std::optional<HandPose> locate(XrSpace space, XrTime time, Vector3* velocity) const;

  Runtime& m_runtime;
  Session& m_session;
  std::array<XrPath, 2> m_paths;
  XrActionSet m_set = XR_NULL_HANDLE;
  XrAction m_grip = XR_NULL_HANDLE, m_aim = XR_NULL_HANDLE, m_draw = XR_NULL_HANDLE, m_hold = XR_NULL_HANDLE;
  XrAction m_steer = XR_NULL_HANDLE, m_steerPress = XR_NULL_HANDLE, m_first = XR_NULL_HANDLE, m_second = XR_NULL_HANDLE;
  XrAction m_feel = XR_NULL_HANDLE;
  std::array<XrSpace, 2> m_gripSpaces{}, m_aimSpaces{};
};

}  // namespace ps::vr
