// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/handinput.h"
#include "ui/vr/session.h"

#include <array>
#include <map>
#include <optional>

namespace ps::vr {

struct Suggestion;

HandPose poseOf(const XrPosef& pose);

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
  enum class Holds { Nothing, Controller, BareHand };  ///< or the runtime reads a bare hand as if it held one
  Holds holds(size_t hand) const;
  void vibrate(size_t hand, const Vibration& vibration);

 private:
  XrAction make(const char* name, const char* label, XrActionType type);
  void makeActions();
  void suggest();
  void attach();
  XrActionStateGetInfo stateInfo(XrAction action, size_t hand) const;
  bool pressed(XrAction action, size_t hand) const;
  const Suggestion* held(size_t hand) const;  ///< nullptr: nothing that is suggested for
  XrPath profile(size_t hand) const;
  double number(XrAction action, size_t hand) const;
  std::optional<HandPose> locate(XrSpace space, XrTime time) const;

  Runtime& m_runtime;
  Session& m_session;
  std::array<XrPath, 2> m_paths;
  std::map<XrPath, const Suggestion*> m_suggested;
  XrActionSet m_set = XR_NULL_HANDLE;
  XrAction m_grip = XR_NULL_HANDLE, m_aim = XR_NULL_HANDLE, m_draw = XR_NULL_HANDLE, m_hold = XR_NULL_HANDLE;
  XrAction m_steer = XR_NULL_HANDLE, m_steerPress = XR_NULL_HANDLE, m_first = XR_NULL_HANDLE, m_second = XR_NULL_HANDLE;
  XrAction m_menu = XR_NULL_HANDLE, m_feel = XR_NULL_HANDLE;
  std::array<XrSpace, 2> m_gripSpaces{}, m_aimSpaces{};
};

}  // namespace ps::vr
