// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/vr/runtime/graphics.h"
#include "tests/vr/runtime/handles.h"
#include "tests/vr/runtime/log.h"
#include "tests/vr/runtime/paths.h"
#include "tests/vr/runtime/script.h"

#include <openxr/openxr.h>

#include <array>
#include <chrono>
#include <cstring>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

// All that the runtime knows while an instance lives. The functions of the API are grouped in files by what they deal
// with (frame.cpp, swapchain.cpp ...); each gets the Instance and throws Refusal when the client breaks the
// specification. One lock guards everything (call.h): a test runtime has no need to be fast, and no state that is half
// changed can be seen.
namespace ps::scripted {

struct ActionSet {
  std::string name, localizedName;
  uint32_t priority = 0;
  bool attached = false;
};

/// Of one hand, or of all together (the path 0).
struct ActionState {
  bool active = false, changed = false;
  XrVector2f value{0, 0};  ///< booleans and numbers have the first alone
  XrTime changeTime = 0;
};

struct Action {
  XrActionSet set = XR_NULL_HANDLE;
  std::string name, localizedName;
  XrActionType type = XR_ACTION_TYPE_BOOLEAN_INPUT;
  std::vector<XrPath> subactions;
  std::map<XrPath, ActionState> states;  ///< as of the last xrSyncActions()
};

struct Space {
  std::optional<XrReferenceSpaceType> reference;
  XrAction action = XR_NULL_HANDLE;
  XrPath subaction = XR_NULL_PATH;
  XrPosef offset = kNoMotion;
};

struct Swapchain {
  XrSwapchainCreateInfo info{};
  std::vector<GLuint> textures;
  std::deque<uint32_t> acquired;     ///< the oldest first
  bool waited = false;               ///< for the oldest
  std::optional<uint32_t> released;  ///< the newest
  uint32_t next = 0;                 ///< to be acquired
};

/// What a profile's components are bound to: action and path, "/user/hand/left/input/trigger/value".
using Bindings = std::vector<std::pair<XrAction, std::string>>;

struct HandTracker {
  size_t hand = 0;
};

struct PredictedFrame {
  int64_t frame;
  XrTime time;
};

struct Session {
  XrSessionState state = XR_SESSION_STATE_UNKNOWN;
  bool running = false, exitRequested = false, actionsAttached = false, lost = false;
  bool frameWaited = false, frameBegun = false;
  std::deque<PredictedFrame> predicted;  ///< the newest last
  GraphicsBinding graphics;
  Handles<XrSpace, Space> spaces;
  Handles<XrSwapchain, Swapchain> swapchains;
  Handles<XrHandTrackerEXT, HandTracker> handTrackers;
  std::array<std::string, 2> reportedProfile;  ///< which the client was told of
};

/// What the script says of a function: it gives this result so many times.
struct Failure {
  XrResult result = XR_ERROR_RUNTIME_FAILURE;
  int64_t times = 0;
  int64_t after = 0;  ///< calls that go well before
};

/// The function of the API whose next call hangs.
struct Hang {
  std::string function;
  std::chrono::milliseconds lasts{0};
};

/// From the frame on, frames have this period, and the frame has this time.
struct Clock {
  int64_t frame = 0;
  XrTime time = 1'000'000'000;     ///< ns; never 0, which is no valid time
  XrDuration period = 11'111'111;  ///< ns
};

struct Instance {
  Instance(Script theScript, const std::string& scriptFile, const std::string& logFile)
      : script(std::move(theScript)), laterScript(scriptFile.empty() ? "" : scriptFile + ".later"), log(logFile) {}

  Script script;
  std::string laterScript;  ///< a file that a test may bring while its client is at it; "": none
  Log log;
  std::set<std::string, std::less<>> extensions;
  Paths paths;
  std::deque<XrEventDataBuffer> events;
  bool graphicsAsked = false;  ///< xrGetOpenGLGraphicsRequirementsKHR() was called, as it must be

  Clock clock;
  int64_t frame = -1;  ///< that was waited for last
  size_t nextEvent = 0;
  std::chrono::steady_clock::time_point due;  ///< the next frame, where frames last as long as they say
  XrSessionState allowed = XR_SESSION_STATE_FOCUSED;
  std::map<std::string, Failure, std::less<>> failures;
  std::optional<Hang> hangs;
  std::string stealsContext;                           ///< the function whose calls leave no context current
  XrResult death = XR_SUCCESS;                         ///< what every call gives from now on
  std::array<std::string, 2> profile;                  ///< of the controllers that are there, "" for none
  XrPosef localOrigin = {{0, 0, 0, 1}, {0, 1.6f, 0}};  ///< in the stage

  Handles<XrActionSet, ActionSet> actionSets;
  Handles<XrAction, Action> actions;
  std::map<std::string, Bindings, std::less<>> suggested;  ///< by profile
  std::optional<Session> session;
  XrSession sessionHandle = XR_NULL_HANDLE;
  size_t texturesAlive = 0;
};

inline bool has(const Instance& instance, std::string_view extension) {
  return instance.extensions.count(extension) > 0;
}

/// Throws Refusal XR_ERROR_HANDLE_INVALID.
inline Session& sessionOf(Instance& instance, XrSession handle) {
  require(instance.session && handle == instance.sessionHandle, XR_ERROR_HANDLE_INVALID, "there is no such session");
  return *instance.session;
}
/// The session behind a handle that belongs to one. Throws Refusal XR_ERROR_HANDLE_INVALID.
inline Session& openSession(Instance& instance) { return sessionOf(instance, instance.sessionHandle); }

/// An empty structure of a type of OpenXR.
template <class Structure>
Structure structure(XrStructureType type) {
  Structure empty{};
  empty.type = type;
  return empty;
}

/// Puts an event of OpenXR where xrPollEvent() finds it.
template <class Event>
void post(Instance& instance, const Event& event) {
  XrEventDataBuffer buffer{};
  static_assert(sizeof event <= sizeof buffer);
  std::memcpy(&buffer, &event, sizeof event);
  instance.events.push_back(buffer);
}

}  // namespace ps::scripted
