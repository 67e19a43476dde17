// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/functions.h"
#include "tests/vr/runtime/profiles.h"
#include "tests/vr/runtime/sources.h"
#include "tests/vr/runtime/timeline.h"

#include <algorithm>

// Which actions hang on which parts of which controllers (OpenXR specification 1.0, section 11.4).
namespace ps::scripted {
namespace {

void checkBinding(Instance& instance, const InteractionProfile& profile, const XrActionSuggestedBinding& binding) {
  const Action& action = instance.actions.at(binding.action);
  require(!instance.actionSets.at(action.set).attached, XR_ERROR_ACTIONSETS_ALREADY_ATTACHED,
          "bindings come before the action set is attached");
  const std::string& path = instance.paths.textOf(binding.binding);
  const std::string where = path + " of " + std::string(profile.path);
  const int hand = handOf(path);
  require(hand >= 0, XR_ERROR_PATH_UNSUPPORTED, where + ": is no hand's");
  const std::string_view component = componentOf(path);
  require(hasComponent(profile, static_cast<size_t>(hand), component), XR_ERROR_PATH_UNSUPPORTED,
          where + ": the controller has no such part");
  require(fits(profile, static_cast<size_t>(hand), component, action.type), XR_ERROR_PATH_UNSUPPORTED,
          where + ": is of another kind than the action " + action.name);
  const auto& allowed = action.subactions;
  const auto own = [&](XrPath subaction) { return handOf(instance.paths.textOf(subaction)) == hand; };
  require(allowed.empty() || std::any_of(allowed.begin(), allowed.end(), own), XR_ERROR_PATH_UNSUPPORTED,
          where + ": that hand is none of the action " + action.name);
}

}  // namespace

std::string profileOf(const Instance& instance, size_t hand) {
  const std::string& profile = instance.profile[hand];
  const bool awake = instance.script.hand(hand, double(instance.frame)).active;
  return awake && instance.suggested.count(profile) ? profile : "";
}

std::vector<Source> sourcesOf(const Instance& instance, XrAction action, int wanted) {
  std::vector<Source> sources;
  for (size_t hand = 0; hand < 2; ++hand) {
    if (wanted >= 0 && hand != static_cast<size_t>(wanted)) continue;
    const auto bindings = instance.suggested.find(profileOf(instance, hand));
    if (bindings == instance.suggested.end()) continue;
    for (const auto& [bound, path] : bindings->second)
      if (bound == action && handOf(path) == int(hand)) sources.push_back({hand, std::string(componentOf(path))});
  }
  return sources;
}

void reportProfiles(Instance& instance) {
  Session& session = *instance.session;
  const std::array<std::string, 2> now = {profileOf(instance, 0), profileOf(instance, 1)};
  if (now == session.reportedProfile) return;
  session.reportedProfile = now;
  auto event = structure<XrEventDataInteractionProfileChanged>(XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED);
  event.session = instance.sessionHandle;
  post(instance, event);
  instance.log.write({{"profiles", now}, {"frame", instance.frame}});
}

XrResult suggestInteractionProfileBindings(Instance& instance, XrInstance,
                                           const XrInteractionProfileSuggestedBinding* info) {
  typed(info, XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
  require(info->countSuggestedBindings > 0 && info->suggestedBindings, XR_ERROR_VALIDATION_FAILURE,
          "no binding is suggested");
  const std::string& path = instance.paths.textOf(info->interactionProfile);
  const InteractionProfile* profile = interactionProfile(path);
  require(profile && (profile->extension.empty() || has(instance, profile->extension)), XR_ERROR_PATH_UNSUPPORTED,
          path + ": is no interaction profile, or its extension was not enabled");
  Bindings bindings;
  nlohmann::json text = nlohmann::json::array();
  for (uint32_t i = 0; i < info->countSuggestedBindings; ++i) {
    const XrActionSuggestedBinding& binding = info->suggestedBindings[i];
    checkBinding(instance, *profile, binding);
    bindings.emplace_back(binding.action, instance.paths.textOf(binding.binding));
    text.push_back({instance.actions.at(binding.action).name, bindings.back().second});
  }
  instance.suggested[path] = std::move(bindings);
  instance.log.write({{"bindings", text}, {"profile", path}});
  return XR_SUCCESS;
}

XrResult attachSessionActionSets(Instance& instance, XrSession handle, const XrSessionActionSetsAttachInfo* info) {
  Session& session = sessionOf(instance, handle);
  typed(info, XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO);
  require(info->countActionSets > 0 && info->actionSets, XR_ERROR_VALIDATION_FAILURE, "no action set is attached");
  require(!session.actionsAttached, XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "a session's action sets are attached once");
  for (uint32_t i = 0; i < info->countActionSets; ++i) instance.actionSets.at(info->actionSets[i]);
  for (uint32_t i = 0; i < info->countActionSets; ++i) instance.actionSets.at(info->actionSets[i]).attached = true;
  session.actionsAttached = true;
  return XR_SUCCESS;
}

XrResult getCurrentInteractionProfile(Instance& instance, XrSession handle, XrPath user,
                                      XrInteractionProfileState* state) {
  const Session& session = sessionOf(instance, handle);
  typed(state, XR_TYPE_INTERACTION_PROFILE_STATE);
  require(session.actionsAttached, XR_ERROR_ACTIONSET_NOT_ATTACHED, "no action set is attached");
  const std::string& path = instance.paths.textOf(user);
  const auto hand = std::find(std::begin(kHands), std::end(kHands), path);
  require(hand != std::end(kHands), XR_ERROR_PATH_UNSUPPORTED, path + ": is neither hand");
  const std::string& profile = session.reportedProfile[static_cast<size_t>(hand - std::begin(kHands))];
  state->interactionProfile = profile.empty() ? XR_NULL_PATH : instance.paths.pathOf(profile);
  return XR_SUCCESS;
}

XrResult enumerateBoundSourcesForAction(Instance& instance, XrSession handle,
                                        const XrBoundSourcesForActionEnumerateInfo* info, uint32_t capacity,
                                        uint32_t* count, XrPath* paths) {
  sessionOf(instance, handle);
  const Action& action = instance.actions.at(typed(info, XR_TYPE_BOUND_SOURCES_FOR_ACTION_ENUMERATE_INFO).action);
  require(instance.actionSets.at(action.set).attached, XR_ERROR_ACTIONSET_NOT_ATTACHED,
          "the action's set is not attached");
  const std::vector<Source> sources = sourcesOf(instance, info->action, -1);
  return enumerate(sources.size(), capacity, count, paths, [&](size_t i, XrPath& path) {
    path = instance.paths.pathOf(std::string(kHands[sources[i].hand]) + sources[i].component);
  });
}

XrResult getInputSourceLocalizedName(Instance& instance, XrSession handle,
                                     const XrInputSourceLocalizedNameGetInfo* info, uint32_t capacity, uint32_t* count,
                                     char* text) {
  const Session& session = sessionOf(instance, handle);
  typed(info, XR_TYPE_INPUT_SOURCE_LOCALIZED_NAME_GET_INFO);
  require(session.actionsAttached, XR_ERROR_ACTIONSET_NOT_ATTACHED, "no action set is attached");
  require(info->whichComponents != 0, XR_ERROR_VALIDATION_FAILURE, "no part of the name is asked for");
  const std::string& path = instance.paths.textOf(info->sourcePath);
  return enumerate(std::string_view(path.c_str(), path.size() + 1), capacity, count, text);
}

}  // namespace ps::scripted
