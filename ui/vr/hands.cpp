// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/hands.h"

#include "ui/vr/suggestions.h"

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace ps::vr {
namespace {

constexpr const char* kHands[] = {"/user/hand/left", "/user/hand/right"};
constexpr double kNanosecond = 1e-9;  // s
constexpr std::string_view kPad = "/input/trackpad";

template <size_t N>
void write(char (&place)[N], const char* text) {
  std::snprintf(place, N, "%s", text);
}

}  // namespace

HandPose poseOf(const XrPosef& pose) {
  const auto& [q, p] = pose;
  return {{double(p.x), double(p.y), double(p.z)}, {double(q.w), double(q.x), double(q.y), double(q.z)}};
}

Hands::Hands(Runtime& runtime, Session& session)
    : m_runtime(runtime), m_session(session), m_paths{runtime.path(kHands[kLeft]), runtime.path(kHands[kRight])} {
  auto info = structure<XrActionSetCreateInfo>(XR_TYPE_ACTION_SET_CREATE_INFO);
  write(info.actionSetName, "sketch");
  write(info.localizedActionSetName, "Sketching");
  check(xrCreateActionSet(m_runtime.instance(), &info, &m_set), "xrCreateActionSet");
  try {
    makeActions();
    suggest();
    attach();
  } catch (...) {
    xrDestroyActionSet(m_set);
    throw;
  }
}

// The spaces go with the session, the actions with their set.
Hands::~Hands() { xrDestroyActionSet(m_set); }

XrAction Hands::make(const char* name, const char* label, XrActionType type) {
  auto info = structure<XrActionCreateInfo>(XR_TYPE_ACTION_CREATE_INFO);
  write(info.actionName, name);
  write(info.localizedActionName, label);
  info.actionType = type;
  info.countSubactionPaths = static_cast<uint32_t>(m_paths.size());
  info.subactionPaths = m_paths.data();
  XrAction action = XR_NULL_HANDLE;
  check(xrCreateAction(m_set, &info, &action), "xrCreateAction");
  return action;
}

void Hands::makeActions() {
  m_grip = make("grip", "Hand", XR_ACTION_TYPE_POSE_INPUT);
  m_aim = make("aim", "Where the hand points", XR_ACTION_TYPE_POSE_INPUT);
  m_draw = make("draw", "Draw and press", XR_ACTION_TYPE_FLOAT_INPUT);
  m_hold = make("hold", "Hold things", XR_ACTION_TYPE_FLOAT_INPUT);
  m_steer = make("steer", "Turn and choose", XR_ACTION_TYPE_VECTOR2F_INPUT);
  m_steerPress = make("steer_press", "Confirm the choice", XR_ACTION_TYPE_BOOLEAN_INPUT);
  m_first = make("first", "Undo, or play", XR_ACTION_TYPE_BOOLEAN_INPUT);
  m_second = make("second", "Board, or make real", XR_ACTION_TYPE_BOOLEAN_INPUT);
  m_menu = make("menu", "Palette", XR_ACTION_TYPE_BOOLEAN_INPUT);
  m_feel = make("feel", "Feel", XR_ACTION_TYPE_VIBRATION_OUTPUT);
}

void Hands::suggest() {
  for (const Suggestion& suggestion : suggestions()) {
    if (!suggestion.extension.empty() && !m_runtime.has(suggestion.extension)) continue;
    std::vector<XrActionSuggestedBinding> bindings;
    const auto bind = [&](XrAction action, size_t hand, std::string_view part) {
      if (!part.empty()) bindings.push_back({action, m_runtime.path(kHands[hand] + std::string(part))});
    };
    for (const size_t hand : {kLeft, kRight}) {
      bind(m_grip, hand, "/input/grip/pose");
      bind(m_aim, hand, "/input/aim/pose");
      bind(m_draw, hand, suggestion.draw);
      bind(m_hold, hand, suggestion.hold);
      bind(m_steer, hand, suggestion.steer);
      bind(m_steerPress, hand, suggestion.steerPress);
      bind(m_first, hand, suggestion.first(hand));
      bind(m_second, hand, suggestion.second(hand));
      bind(m_menu, hand, suggestion.menu);
      bind(m_feel, hand, suggestion.bareHand ? "" : "/output/haptic");
    }
    auto info = structure<XrInteractionProfileSuggestedBinding>(XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
    info.interactionProfile = m_runtime.path(std::string(suggestion.profile));
    m_suggested[info.interactionProfile] = &suggestion;
    info.countSuggestedBindings = static_cast<uint32_t>(bindings.size());
    info.suggestedBindings = bindings.data();
    // A runtime may not know a controller; the others are suggested all the same.
    const XrResult result = xrSuggestInteractionProfileBindings(m_runtime.instance(), &info);
    if (result != XR_ERROR_PATH_UNSUPPORTED) check(result, "xrSuggestInteractionProfileBindings");
  }
}

void Hands::attach() {
  auto info = structure<XrSessionActionSetsAttachInfo>(XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO);
  info.countActionSets = 1;
  info.actionSets = &m_set;
  check(xrAttachSessionActionSets(m_session.handle(), &info), "xrAttachSessionActionSets");
  for (const size_t hand : {kLeft, kRight}) {
    auto space = structure<XrActionSpaceCreateInfo>(XR_TYPE_ACTION_SPACE_CREATE_INFO);
    space.subactionPath = m_paths[hand];
    space.poseInActionSpace.orientation.w = 1;
    space.action = m_grip;
    check(xrCreateActionSpace(m_session.handle(), &space, &m_gripSpaces[hand]), "xrCreateActionSpace");
    space.action = m_aim;
    check(xrCreateActionSpace(m_session.handle(), &space, &m_aimSpaces[hand]), "xrCreateActionSpace");
  }
}

void Hands::sync() {
  const XrActiveActionSet active{m_set, XR_NULL_PATH};
  auto info = structure<XrActionsSyncInfo>(XR_TYPE_ACTIONS_SYNC_INFO);
  info.countActiveActionSets = 1;
  info.activeActionSets = &active;
  check(xrSyncActions(m_session.handle(), &info), "xrSyncActions");
}

XrActionStateGetInfo Hands::stateInfo(XrAction action, size_t hand) const {
  auto info = structure<XrActionStateGetInfo>(XR_TYPE_ACTION_STATE_GET_INFO);
  info.action = action;
  info.subactionPath = m_paths[hand];
  return info;
}

bool Hands::pressed(XrAction action, size_t hand) const {
  const XrActionStateGetInfo info = stateInfo(action, hand);
  auto state = structure<XrActionStateBoolean>(XR_TYPE_ACTION_STATE_BOOLEAN);
  check(xrGetActionStateBoolean(m_session.handle(), &info, &state), "xrGetActionStateBoolean");
  return state.isActive && state.currentState;
}

XrPath Hands::profile(size_t hand) const {
  auto state = structure<XrInteractionProfileState>(XR_TYPE_INTERACTION_PROFILE_STATE);
  check(xrGetCurrentInteractionProfile(m_session.handle(), m_paths[hand], &state), "xrGetCurrentInteractionProfile");
  return state.interactionProfile;
}

const Suggestion* Hands::held(size_t hand) const {
  const auto found = m_suggested.find(profile(hand));
  return found == m_suggested.end() ? nullptr : found->second;
}

Hands::Holds Hands::holds(size_t hand) const {
  if (profile(hand) == XR_NULL_PATH) return Holds::Nothing;
  const Suggestion* what = held(hand);
  return what && what->bareHand ? Holds::BareHand : Holds::Controller;
}

double Hands::number(XrAction action, size_t hand) const {
  const XrActionStateGetInfo info = stateInfo(action, hand);
  auto state = structure<XrActionStateFloat>(XR_TYPE_ACTION_STATE_FLOAT);
  check(xrGetActionStateFloat(m_session.handle(), &info, &state), "xrGetActionStateFloat");
  return state.isActive ? double(state.currentState) : 0;
}

std::optional<HandPose> Hands::locate(XrSpace space, XrTime time) const {
  auto location = structure<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
  check(xrLocateSpace(space, m_session.floor(), time, &location), "xrLocateSpace");
  constexpr XrSpaceLocationFlags kValid =
      XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
  if ((location.locationFlags & kValid) != kValid) return {};
  return poseOf(location.pose);
}

HandInput Hands::input(size_t hand, XrTime time) const {
  HandInput input;
  input.grip = locate(m_gripSpaces[hand], time);
  input.aim = locate(m_aimSpaces[hand], time);
  input.draw = number(m_draw, hand);
  input.hold = number(m_hold, hand);
  const XrActionStateGetInfo info = stateInfo(m_steer, hand);
  auto state = structure<XrActionStateVector2f>(XR_TYPE_ACTION_STATE_VECTOR2F);
  check(xrGetActionStateVector2f(m_session.handle(), &info, &state), "xrGetActionStateVector2f");
  if (state.isActive) input.steerX = double(state.currentState.x), input.steerY = double(state.currentState.y);
  if (const Suggestion* what = held(hand)) {
    input.profile = what->profile;
    input.bare = what->bareHand;
    input.pad = what->steer == kPad;
  }
  input.steerPressed = pressed(m_steerPress, hand);
  input.first = pressed(m_first, hand);
  input.second = pressed(m_second, hand);
  input.menu = pressed(m_menu, hand);
  return input;
}

void Hands::vibrate(size_t hand, const Vibration& vibration) {
  auto info = structure<XrHapticActionInfo>(XR_TYPE_HAPTIC_ACTION_INFO);
  info.action = m_feel;
  info.subactionPath = m_paths[hand];
  auto haptic = structure<XrHapticVibration>(XR_TYPE_HAPTIC_VIBRATION);
  haptic.amplitude = static_cast<float>(vibration.amplitude);
  haptic.frequency = static_cast<float>(vibration.frequency);
  haptic.duration = vibration.duration > 0 ? std::llround(vibration.duration / kNanosecond) : XR_MIN_HAPTIC_DURATION;
  check(xrApplyHapticFeedback(m_session.handle(), &info, reinterpret_cast<const XrHapticBaseHeader*>(&haptic)),
        "xrApplyHapticFeedback");
}

}  // namespace ps::vr
