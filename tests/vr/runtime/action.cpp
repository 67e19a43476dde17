// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/functions.h"
#include "tests/vr/runtime/profiles.h"
#include "tests/vr/runtime/sources.h"

#include <algorithm>

// Sets of actions and the actions in them (OpenXR specification 1.0, sections 11.2 and 11.3).
namespace ps::scripted {
namespace {

/// A text in an array of fixed size, whether or not it ends there.
template <size_t N>
std::string textIn(const char (&text)[N]) {
  return {text, std::find(text, text + N, '\0')};
}

void checkNames(const std::string& name, const std::string& localizedName) {
  require(!name.empty(), XR_ERROR_NAME_INVALID, "the name is empty");
  require(isPathLevel(name), XR_ERROR_PATH_FORMAT_INVALID, "\"" + name + "\" cannot be a part of a path");
  require(!localizedName.empty(), XR_ERROR_LOCALIZED_NAME_INVALID, name + ": has no name for people");
}

std::vector<XrPath> readSubactions(Instance& instance, const XrActionCreateInfo& info) {
  std::vector<XrPath> paths;
  for (uint32_t i = 0; i < info.countSubactionPaths; ++i) {
    const XrPath path = info.subactionPaths[i];
    const std::string& text = instance.paths.textOf(path);
    require(std::find(std::begin(kHands), std::end(kHands), text) != std::end(kHands), XR_ERROR_PATH_UNSUPPORTED,
            text + ": is neither hand");
    require(std::find(paths.begin(), paths.end(), path) == paths.end(), XR_ERROR_PATH_UNSUPPORTED,
            text + ": is named twice");
    paths.push_back(path);
  }
  return paths;
}

}  // namespace

int subactionHand(const Instance& instance, const Action& action, XrPath path) {
  if (path == XR_NULL_PATH) return -1;
  const std::string& text = instance.paths.textOf(path);
  require(std::find(action.subactions.begin(), action.subactions.end(), path) != action.subactions.end(),
          XR_ERROR_PATH_UNSUPPORTED, text + ": the action " + action.name + " does not declare it");
  return handOf(text);
}

XrResult createActionSet(Instance& instance, XrInstance, const XrActionSetCreateInfo* info, XrActionSet* made) {
  typed(info, XR_TYPE_ACTION_SET_CREATE_INFO);
  ActionSet set{textIn(info->actionSetName), textIn(info->localizedActionSetName), info->priority, false};
  checkNames(set.name, set.localizedName);
  instance.actionSets.each([&](XrActionSet, const ActionSet& other) {
    require(other.name != set.name, XR_ERROR_NAME_DUPLICATED, set.name + ": another set has this name");
    require(other.localizedName != set.localizedName, XR_ERROR_LOCALIZED_NAME_DUPLICATED,
            set.name + ": another set has its name for people");
  });
  wanted(made) = instance.actionSets.add(std::move(set));
  return XR_SUCCESS;
}

XrResult destroyActionSet(Instance& instance, XrActionSet handle) {
  instance.actionSets.at(handle);
  instance.actions.eraseIf([&](const Action& action) { return action.set == handle; });
  instance.actionSets.erase(handle);
  return XR_SUCCESS;
}

XrResult createAction(Instance& instance, XrActionSet set, const XrActionCreateInfo* info, XrAction* made) {
  typed(info, XR_TYPE_ACTION_CREATE_INFO);
  require(!instance.actionSets.at(set).attached, XR_ERROR_ACTIONSETS_ALREADY_ATTACHED,
          "actions are made before their set is attached");
  Action action;
  action.set = set;
  action.name = textIn(info->actionName);
  action.localizedName = textIn(info->localizedActionName);
  action.type = info->actionType;
  checkNames(action.name, action.localizedName);
  instance.actions.each([&](XrAction, const Action& other) {
    if (other.set != set) return;
    require(other.name != action.name, XR_ERROR_NAME_DUPLICATED, action.name + ": another action has this name");
    require(other.localizedName != action.localizedName, XR_ERROR_LOCALIZED_NAME_DUPLICATED,
            action.name + ": another action has its name for people");
  });
  action.subactions = readSubactions(instance, *info);
  wanted(made) = instance.actions.add(std::move(action));
  return XR_SUCCESS;
}

XrResult destroyAction(Instance& instance, XrAction handle) {
  instance.actions.at(handle);
  instance.actions.erase(handle);
  return XR_SUCCESS;
}

}  // namespace ps::scripted
