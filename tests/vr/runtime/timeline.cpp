// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/timeline.h"

#include "tests/vr/runtime/lifecycle.h"
#include "tests/vr/runtime/limits.h"
#include "tests/vr/runtime/names.h"
#include "tests/vr/runtime/scriptreader.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <string>

namespace ps::scripted {
namespace {

using nlohmann::json;

void changeProfile(Instance& instance, const json& what) {
  const std::string profile = what["profile"];
  const std::string hand = what.value("hand", "");
  if (hand != "right") instance.profile[0] = profile;
  if (hand != "left") instance.profile[1] = profile;
}

// LOCAL gets another origin, as when its user holds the headset's button.
void recentre(Instance& instance, const json& what) {
  const XrPosef before = instance.localOrigin;
  instance.localOrigin = poseOf(what["recentre"]);
  if (!instance.session) return;
  auto event = structure<XrEventDataReferenceSpaceChangePending>(XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING);
  event.session = instance.sessionHandle;
  event.referenceSpaceType = XR_REFERENCE_SPACE_TYPE_LOCAL;
  event.changeTime = timeOf(instance, instance.frame);
  event.poseValid = XR_TRUE;
  event.poseInPreviousSpace = combined(inverse(before), instance.localOrigin);
  post(instance, event);
}

void loseInstance(Instance& instance) {
  auto event = structure<XrEventDataInstanceLossPending>(XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING);
  event.lossTime = timeOf(instance, instance.frame + 1);
  post(instance, event);
}

void changeMask(Instance& instance, float corners) {
  instance.script.hiddenCorners = corners;
  if (!instance.session || !has(instance, XR_KHR_VISIBILITY_MASK_EXTENSION_NAME)) return;
  for (uint32_t eye = 0; eye < kEyes; ++eye) {
    auto event = structure<XrEventDataVisibilityMaskChangedKHR>(XR_TYPE_EVENT_DATA_VISIBILITY_MASK_CHANGED_KHR);
    event.session = instance.sessionHandle;
    event.viewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    event.viewIndex = eye;
    post(instance, event);
  }
}

void apply(Instance& instance, const json& what) {
  const std::string kind = what["kind"];
  if (kind == "state") {
    allow(instance, *stateNamed(what["state"].get<std::string>()));
  } else if (kind == "fail") {
    instance.failures[what["fail"]] = {*resultNamed(what["result"].get<std::string>()),
                                       what.value("times", int64_t{-1}), what.value("after", int64_t{0})};
  } else if (kind == "dies") {
    instance.death = *resultNamed(what["dies"].get<std::string>());
  } else if (kind == "hangs") {
    instance.hangs = {what["hangs"], std::chrono::milliseconds(what["milliseconds"].get<int64_t>())};
  } else if (kind == "steals_context") {
    instance.stealsContext = what["steals_context"];
  } else if (kind == "session_lost") {
    if (instance.session) instance.session->lost = true;
  } else if (kind == "instance_loss") {
    loseInstance(instance);
  } else if (kind == "profile") {
    changeProfile(instance, what);
  } else if (kind == "recentre") {
    recentre(instance, what);
  } else if (kind == "refresh_rate") {
    changeRefreshRate(instance, what["refresh_rate"]);
  } else if (kind == "hidden_corners") {
    changeMask(instance, what["hidden_corners"]);
  } else if (kind == "events_lost") {
    auto event = structure<XrEventDataEventsLost>(XR_TYPE_EVENT_DATA_EVENTS_LOST);
    event.lostEventCount = what["events_lost"];
    post(instance, event);
  }
}

// The script that a test has brought meanwhile. It is put aside before it is read: another one may follow at any time.
void goOn(Instance& instance) {
  const std::string& brought = instance.laterScript;
  const std::string taken = brought + ".taken";
  if (brought.empty() || std::rename(brought.c_str(), taken.c_str()) != 0) return;
  try {
    instance.script.goOn(Script(taken), instance.frame);
    instance.nextEvent = 0;
    instance.log.write({{"later_script", "begun"}, {"frame", instance.frame}});
  } catch (const std::exception& error) {
    instance.log.write({{"later_script", error.what()}, {"frame", instance.frame}});
  }
  unlink(taken.c_str());
}

}  // namespace

XrTime timeOf(const Instance& instance, int64_t frame) {
  return instance.clock.time + (frame - instance.clock.frame) * instance.clock.period;
}

double frameOf(const Instance& instance, XrTime time) {
  return double(instance.clock.frame) + double(time - instance.clock.time) / double(instance.clock.period);
}

void changeRefreshRate(Instance& instance, float rate) {
  auto event = structure<XrEventDataDisplayRefreshRateChangedFB>(XR_TYPE_EVENT_DATA_DISPLAY_REFRESH_RATE_CHANGED_FB);
  event.fromDisplayRefreshRate = 1e9f / static_cast<float>(instance.clock.period);
  event.toDisplayRefreshRate = rate;
  instance.log.write({{"refresh_rate", rate}, {"frame", instance.frame}});
  instance.clock = {instance.frame, timeOf(instance, instance.frame), std::llround(1e9 / double(rate))};
  if (has(instance, XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME)) post(instance, event);
}

void nextFrame(Instance& instance) {
  ++instance.frame;
  goOn(instance);
  applyEvents(instance);
}

void applyEvents(Instance& instance) {
  const auto& events = instance.script.events;
  while (instance.nextEvent < events.size() && events[instance.nextEvent].frame <= double(instance.frame)) {
    const ScriptEvent& event = events[instance.nextEvent++];
    apply(instance, event.what);
  }
}

}  // namespace ps::scripted
