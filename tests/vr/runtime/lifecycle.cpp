// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/lifecycle.h"

#include "tests/vr/runtime/names.h"
#include "tests/vr/runtime/timeline.h"

namespace ps::scripted {
namespace {

// The values of these states rise with how much the session shows.
static_assert(XR_SESSION_STATE_IDLE < XR_SESSION_STATE_READY &&
              XR_SESSION_STATE_READY < XR_SESSION_STATE_SYNCHRONIZED &&
              XR_SESSION_STATE_SYNCHRONIZED < XR_SESSION_STATE_VISIBLE &&
              XR_SESSION_STATE_VISIBLE < XR_SESSION_STATE_FOCUSED);

void enter(Instance& instance, XrSessionState state) {
  Session& session = *instance.session;
  session.state = state;
  auto event = structure<XrEventDataSessionStateChanged>(XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED);
  event.session = instance.sessionHandle;
  event.state = state;
  event.time = timeOf(instance, instance.frame);
  post(instance, event);
  instance.log.write({{"state", nameOf(state)}, {"frame", instance.frame}});
}

bool showsFrames(XrSessionState state) {
  return state == XR_SESSION_STATE_SYNCHRONIZED || state == XR_SESSION_STATE_VISIBLE ||
         state == XR_SESSION_STATE_FOCUSED;
}

void step(Instance& instance, int direction) {
  enter(instance, static_cast<XrSessionState>(instance.session->state + direction));
}

// Down to what is allowed, and out of the running states when nothing is or the client wants to leave.
void lower(Instance& instance) {
  const Session& session = *instance.session;
  const bool leaves = session.exitRequested || instance.allowed == XR_SESSION_STATE_IDLE;
  const XrSessionState lowest = leaves ? XR_SESSION_STATE_SYNCHRONIZED : instance.allowed;
  while (showsFrames(session.state) && session.state > lowest) step(instance, -1);
  if (leaves && (showsFrames(session.state) || (session.state == XR_SESSION_STATE_READY && session.running)))
    enter(instance, XR_SESSION_STATE_STOPPING);
}

void becomeReady(Instance& instance) {
  const bool idle = instance.session->state == XR_SESSION_STATE_IDLE;
  if (idle && instance.allowed != XR_SESSION_STATE_IDLE) enter(instance, XR_SESSION_STATE_READY);
}

}  // namespace

void allow(Instance& instance, XrSessionState state) {
  if (state == XR_SESSION_STATE_LOSS_PENDING || state == XR_SESSION_STATE_EXITING) {
    if (!instance.session) return;
    if (state == XR_SESSION_STATE_LOSS_PENDING) {
      enter(instance, state);
    } else {
      exitRequested(instance);
    }
    return;
  }
  instance.allowed = state;
  if (!instance.session || instance.session->state == XR_SESSION_STATE_LOSS_PENDING) return;
  lower(instance);
  becomeReady(instance);
}

void sessionCreated(Instance& instance) {
  enter(instance, XR_SESSION_STATE_IDLE);
  becomeReady(instance);
}

void frameSubmitted(Instance& instance) {
  const XrSessionState state = instance.session->state;
  if (state == XR_SESSION_STATE_READY || (showsFrames(state) && state < instance.allowed)) step(instance, 1);
}

void exitRequested(Instance& instance) {
  instance.session->exitRequested = true;
  lower(instance);
}

void sessionEnded(Instance& instance) {
  enter(instance, XR_SESSION_STATE_IDLE);
  if (instance.session->exitRequested) {
    enter(instance, XR_SESSION_STATE_EXITING);
  } else {
    becomeReady(instance);
  }
}

}  // namespace ps::scripted
