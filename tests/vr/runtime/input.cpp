// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/functions.h"
#include "tests/vr/runtime/sources.h"
#include "tests/vr/runtime/timeline.h"

#include <algorithm>
#include <cmath>

// What actions are at (OpenXR specification 1.0, section 11.5): all of it is read at xrSyncActions(), and stands until
// the next.
namespace ps::scripted {
namespace {

/// Of the sets that are active, by hand and component, the highest priority that wants a component.
using Priorities = std::map<std::pair<size_t, std::string>, uint32_t>;

float inputOf(const HandState& hand, std::string_view component) {
  const auto exact = hand.inputs.find(component);
  if (exact != hand.inputs.end()) return exact->second;
  for (const std::string_view part : {"/value", "/force", "/click"}) {  // of "/input/trigger" alone
    const auto it = hand.inputs.find(std::string(component) + std::string(part));
    if (it != hand.inputs.end()) return it->second;
  }
  return 0;
}

// As the specification combines several sources: any pressed button, the number furthest from 0, the longest vector.
XrVector2f strongest(const Instance& instance, XrActionType type, const std::vector<Source>& sources) {
  constexpr float kPressed = 0.5f;
  XrVector2f best{0, 0};
  for (const Source& source : sources) {
    const HandState hand = instance.script.hand(source.hand, double(instance.frame));
    XrVector2f value{inputOf(hand, source.component), 0};
    if (type == XR_ACTION_TYPE_VECTOR2F_INPUT)
      value = {inputOf(hand, source.component + "/x"), inputOf(hand, source.component + "/y")};
    if (type == XR_ACTION_TYPE_BOOLEAN_INPUT) value.x = value.x > kPressed ? 1 : 0;
    if (std::hypot(value.x, value.y) > std::hypot(best.x, best.y)) best = value;
  }
  return best;
}

void update(Instance& instance, const Action& action, ActionState& state, const std::vector<Source>& sources) {
  const XrVector2f value = strongest(instance, action.type, sources);
  state.changed = state.active && !sources.empty() && (value.x != state.value.x || value.y != state.value.y);
  if (state.changed) state.changeTime = timeOf(instance, instance.frame);
  state.active = !sources.empty();
  state.value = value;
}

void deactivate(Instance& instance) {
  instance.actions.each([](XrAction, Action& action) { action.states.clear(); });
}

bool isActive(const XrActionsSyncInfo& info, XrActionSet set, const std::string* hand, const Paths& paths) {
  for (uint32_t i = 0; i < info.countActiveActionSets; ++i) {
    const XrActiveActionSet& active = info.activeActionSets[i];
    if (active.actionSet != set) continue;
    if (active.subactionPath == XR_NULL_PATH || !hand || paths.textOf(active.subactionPath) == *hand) return true;
  }
  return false;
}

Priorities prioritiesOf(Instance& instance, const XrActionsSyncInfo& info) {
  Priorities priorities;
  instance.actions.each([&](XrAction handle, const Action& action) {
    if (!isActive(info, action.set, nullptr, instance.paths)) return;
    const uint32_t own = instance.actionSets.at(action.set).priority;
    for (const Source& source : sourcesOf(instance, handle, -1)) {
      uint32_t& highest = priorities[{source.hand, source.component}];
      highest = std::max(highest, own);
    }
  });
  return priorities;
}

void syncAction(Instance& instance, const XrActionsSyncInfo& info, const Priorities& priorities, XrAction handle,
                Action& action) {
  std::vector<XrPath> parts = action.subactions;
  parts.push_back(XR_NULL_PATH);
  for (const XrPath part : parts) {
    const std::string* text = part == XR_NULL_PATH ? nullptr : &instance.paths.textOf(part);
    std::vector<Source> sources;
    if (isActive(info, action.set, text, instance.paths))
      sources = sourcesOf(instance, handle, text ? handOf(*text) : -1);
    const uint32_t own = instance.actionSets.at(action.set).priority;
    std::erase_if(sources, [&](const Source& source) { return priorities.at({source.hand, source.component}) > own; });
    update(instance, action, action.states[part], sources);
  }
}

/// The state that is asked for, and the type checked.
const ActionState& stateOf(Instance& instance, XrSession handle, const XrActionStateGetInfo* info, XrActionType type) {
  sessionOf(instance, handle);
  Action& action = instance.actions.at(typed(info, XR_TYPE_ACTION_STATE_GET_INFO).action);
  require(instance.actionSets.at(action.set).attached, XR_ERROR_ACTIONSET_NOT_ATTACHED,
          action.name + ": its action set is not attached");
  require(action.type == type, XR_ERROR_ACTION_TYPE_MISMATCH, action.name + ": is an action of another type");
  subactionHand(instance, action, info->subactionPath);
  return action.states[info->subactionPath];
}

template <class State>
void fill(const ActionState& from, State& to) {
  to.isActive = from.active ? XR_TRUE : XR_FALSE;
  to.changedSinceLastSync = from.changed ? XR_TRUE : XR_FALSE;
  to.lastChangeTime = from.active ? from.changeTime : 0;
}

}  // namespace

XrResult syncActions(Instance& instance, XrSession handle, const XrActionsSyncInfo* info) {
  const Session& session = sessionOf(instance, handle);
  typed(info, XR_TYPE_ACTIONS_SYNC_INFO);
  require(session.actionsAttached, XR_ERROR_ACTIONSET_NOT_ATTACHED, "no action set is attached");
  for (uint32_t i = 0; i < info->countActiveActionSets; ++i) {
    const XrActiveActionSet& active = info->activeActionSets[i];
    require(instance.actionSets.at(active.actionSet).attached, XR_ERROR_ACTIONSET_NOT_ATTACHED,
            "an action set is not attached to the session");
    if (active.subactionPath != XR_NULL_PATH) instance.paths.textOf(active.subactionPath);
  }
  reportProfiles(instance);
  if (session.state != XR_SESSION_STATE_FOCUSED) {
    deactivate(instance);
    return XR_SESSION_NOT_FOCUSED;
  }
  const Priorities priorities = prioritiesOf(instance, *info);
  instance.actions.each(
      [&](XrAction action, Action& object) { syncAction(instance, *info, priorities, action, object); });
  return XR_SUCCESS;
}

XrResult getActionStateBoolean(Instance& instance, XrSession handle, const XrActionStateGetInfo* info,
                               XrActionStateBoolean* state) {
  const ActionState& known = stateOf(instance, handle, info, XR_ACTION_TYPE_BOOLEAN_INPUT);
  fill(known, typed(state, XR_TYPE_ACTION_STATE_BOOLEAN));
  state->currentState = known.value.x != 0 ? XR_TRUE : XR_FALSE;
  return XR_SUCCESS;
}

XrResult getActionStateFloat(Instance& instance, XrSession handle, const XrActionStateGetInfo* info,
                             XrActionStateFloat* state) {
  const ActionState& known = stateOf(instance, handle, info, XR_ACTION_TYPE_FLOAT_INPUT);
  fill(known, typed(state, XR_TYPE_ACTION_STATE_FLOAT));
  state->currentState = known.value.x;
  return XR_SUCCESS;
}

XrResult getActionStateVector2f(Instance& instance, XrSession handle, const XrActionStateGetInfo* info,
                                XrActionStateVector2f* state) {
  const ActionState& known = stateOf(instance, handle, info, XR_ACTION_TYPE_VECTOR2F_INPUT);
  fill(known, typed(state, XR_TYPE_ACTION_STATE_VECTOR2F));
  state->currentState = known.value;
  return XR_SUCCESS;
}

XrResult getActionStatePose(Instance& instance, XrSession handle, const XrActionStateGetInfo* info,
                            XrActionStatePose* state) {
  const ActionState& known = stateOf(instance, handle, info, XR_ACTION_TYPE_POSE_INPUT);
  typed(state, XR_TYPE_ACTION_STATE_POSE).isActive = known.active ? XR_TRUE : XR_FALSE;
  return XR_SUCCESS;
}

}  // namespace ps::scripted
