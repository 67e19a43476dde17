// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <openxr/openxr.h>

#include <string_view>
#include <vector>

namespace ps::scripted {

inline constexpr std::string_view kHands[] = {"/user/hand/left", "/user/hand/right"};

/// A kind of controller. Components are written without the hand, separated by blanks: "/input/trigger/value".
/// Source: OpenXR specification 1.0, section 6.4, and the extensions that are named.
struct InteractionProfile {
  std::string_view path;       ///< "/interaction_profiles/..."
  std::string_view extension;  ///< that brings it, "" for none
  std::string_view both, left, right;
};

const std::vector<InteractionProfile>& interactionProfiles();
/// nullptr where there is none of that path.
const InteractionProfile* interactionProfile(std::string_view path);
/// Whether the controller has this component, or is the parent of one that it has ("/input/trigger").
bool hasComponent(const InteractionProfile& profile, size_t hand, std::string_view component);
/// Whether an action of that type can be bound to the component: poses to poses, haptics to outputs, and numbers to
/// numbers of any kind, except two of them to what has only one.
bool fits(const InteractionProfile& profile, size_t hand, std::string_view component, XrActionType type);

}  // namespace ps::scripted
