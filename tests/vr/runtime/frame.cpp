// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/call.h"
#include "tests/vr/runtime/functions.h"
#include "tests/vr/runtime/layers.h"
#include "tests/vr/runtime/lifecycle.h"
#include "tests/vr/runtime/limits.h"
#include "tests/vr/runtime/timeline.h"

#include <algorithm>
#include <chrono>

// The frame loop (OpenXR specification 1.0, section 10.7). xrWaitFrame() lets go of the lock while it waits, since
// another thread may have to begin the frame before.
namespace ps::scripted {
namespace {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

constexpr size_t kFramesInFlight = 3;         // that were waited for and may still be submitted
constexpr std::chrono::seconds kPatience{2};  // for another thread to begin the frame before

void waitForBegin(const Session& session) {
  Runtime& own = runtime();
  const bool begun = own.frameBegun.wait_for(own.mutex, kPatience, [&] {
    return !own.instance || !own.instance->session || !session.frameWaited || !session.running;
  });
  require(begun, XR_ERROR_RUNTIME_FAILURE, "xrWaitFrame() again, and nobody begins the frame before");
}

// Where frames last as long as they say: until the next one is due.
void waitForDisplay(Instance& instance) {
  const auto now = steady_clock::now();
  const nanoseconds period(instance.clock.period);
  instance.due = std::max(instance.due + period, now);
  std::condition_variable_any never;
  never.wait_until(runtime().mutex, instance.due, [] { return false; });
}

}  // namespace

XrResult waitFrame(Instance& instance, XrSession handle, const XrFrameWaitInfo* info, XrFrameState* state) {
  Session& session = sessionOf(instance, handle);
  if (info) typed(info, XR_TYPE_FRAME_WAIT_INFO);
  typed(state, XR_TYPE_FRAME_STATE);
  require(session.running, XR_ERROR_SESSION_NOT_RUNNING, "the session does not run");
  if (session.frameWaited) waitForBegin(session);
  require(runtime().instance && sessionOf(instance, handle).running, XR_ERROR_SESSION_NOT_RUNNING,
          "the session ended while a frame was waited for");
  if (instance.script.realTime) waitForDisplay(instance);
  session.frameWaited = true;
  nextFrame(instance);
  state->predictedDisplayTime = timeOf(instance, instance.frame);
  session.predicted.push_back({instance.frame, state->predictedDisplayTime});
  if (session.predicted.size() > kFramesInFlight) session.predicted.pop_front();
  state->predictedDisplayPeriod = instance.clock.period;
  state->shouldRender =
      session.state == XR_SESSION_STATE_VISIBLE || session.state == XR_SESSION_STATE_FOCUSED ? XR_TRUE : XR_FALSE;
  return XR_SUCCESS;
}

XrResult beginFrame(Instance& instance, XrSession handle, const XrFrameBeginInfo* info) {
  Session& session = sessionOf(instance, handle);
  if (info) typed(info, XR_TYPE_FRAME_BEGIN_INFO);
  require(session.running, XR_ERROR_SESSION_NOT_RUNNING, "the session does not run");
  require(session.frameWaited, XR_ERROR_CALL_ORDER_INVALID, "xrBeginFrame() without xrWaitFrame()");
  session.frameWaited = false;
  runtime().frameBegun.notify_all();
  const bool discarded = session.frameBegun;
  session.frameBegun = true;
  return discarded ? XR_FRAME_DISCARDED : XR_SUCCESS;
}

XrResult endFrame(Instance& instance, XrSession handle, const XrFrameEndInfo* info) {
  Session& session = sessionOf(instance, handle);
  typed(info, XR_TYPE_FRAME_END_INFO);
  require(session.running, XR_ERROR_SESSION_NOT_RUNNING, "the session does not run");
  require(session.frameBegun, XR_ERROR_CALL_ORDER_INVALID, "xrEndFrame() without xrBeginFrame()");
  require(info->displayTime > 0, XR_ERROR_TIME_INVALID, "the time of display is none");
  require(info->environmentBlendMode == XR_ENVIRONMENT_BLEND_MODE_OPAQUE, XR_ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED,
          "that blend mode was not among those that were listed");
  require(info->layerCount <= kMaximumLayers, XR_ERROR_LAYER_LIMIT_EXCEEDED, "there are too many layers");
  const nlohmann::json layers = readLayers(instance, *info);
  session.frameBegun = false;
  const auto predicted = std::find_if(session.predicted.begin(), session.predicted.end(),
                                      [&](const PredictedFrame& frame) { return frame.time == info->displayTime; });
  const bool known = predicted != session.predicted.end();
  if (!known)
    noteViolation(instance, "xrEndFrame", Refusal(XR_SUCCESS, "the time of display is not one that was predicted"));
  const int64_t shown = known ? predicted->frame : instance.frame;
  instance.log.write({{"frame", shown}, {"layers", layers}});
  if (instance.script.wantsPicture(shown)) takePictures(instance, *info, shown);
  frameSubmitted(instance);
  return XR_SUCCESS;
}

}  // namespace ps::scripted
