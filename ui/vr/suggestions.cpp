// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/suggestions.h"

#include <algorithm>

namespace ps::vr {
namespace {

/// With a stick, X and Y on the left and A and B on the right.
Suggestion likeTouch(std::string_view profile, std::string_view extension, bool ring,
                     std::string_view hold = "/input/squeeze/value") {
  return {profile,
          "/input/trigger/value",
          hold,
          "/input/thumbstick",
          "/input/thumbstick/click",
          "/input/x/click",
          "/input/y/click",
          "/input/a/click",
          "/input/b/click",
          extension,
          false,
          "",
          ring};
}

}  // namespace

// A part may carry one action only, so that none does two things at once.
const std::vector<Suggestion>& suggestions() {
  static const std::vector<Suggestion> kSuggestions = {
      {"/interaction_profiles/khr/simple_controller", "/input/select/click", "", "", "", "", "", "", "", "", false,
       "/input/menu/click"},
      {"/interaction_profiles/htc/vive_controller", "/input/trigger/value", "/input/squeeze/click", "/input/trackpad",
       "/input/trackpad/click", "/input/menu/click", "", "/input/menu/click", "", "", false, "", true},
      likeTouch("/interaction_profiles/oculus/touch_controller", "", true),
      // Its squeeze/value is that of a touch, which a hand around it always is.
      {"/interaction_profiles/valve/index_controller", "/input/trigger/value", "/input/squeeze/force",
       "/input/thumbstick", "/input/thumbstick/click", "/input/a/click", "/input/b/click", "/input/a/click",
       "/input/b/click"},
      {"/interaction_profiles/microsoft/motion_controller", "/input/trigger/value", "/input/squeeze/click",
       "/input/thumbstick", "/input/thumbstick/click", "/input/trackpad/click", "/input/menu/click",
       "/input/trackpad/click", "/input/menu/click", "", false, "", true},
      {"/interaction_profiles/samsung/odyssey_controller", "/input/trigger/value", "/input/squeeze/click",
       "/input/thumbstick", "/input/thumbstick/click", "/input/trackpad/click", "/input/menu/click",
       "/input/trackpad/click", "/input/menu/click", "XR_EXT_samsung_odyssey_controller", false, "", true},
      likeTouch("/interaction_profiles/hp/mixed_reality_controller", "XR_EXT_hp_mixed_reality_controller", true),
      likeTouch("/interaction_profiles/facebook/touch_controller_pro", "XR_FB_touch_controller_pro", false),
      likeTouch("/interaction_profiles/meta/touch_controller_plus", "XR_META_touch_controller_plus", false),
      likeTouch("/interaction_profiles/bytedance/pico_neo3_controller", "XR_BD_controller_interaction", true),
      likeTouch("/interaction_profiles/bytedance/pico4_controller", "XR_BD_controller_interaction", true),
      // One has no squeeze/value, the other not in its first revision.
      likeTouch("/interaction_profiles/htc/vive_cosmos_controller", "XR_HTC_vive_cosmos_controller_interaction", true,
                "/input/squeeze/click"),
      likeTouch("/interaction_profiles/htc/vive_focus3_controller", "XR_HTC_vive_focus3_controller_interaction", true,
                "/input/squeeze/click"),
      {"/interaction_profiles/microsoft/hand_interaction", "/input/select/value", "/input/squeeze/value", "", "", "",
       "", "", "", "XR_MSFT_hand_interaction", true},
      {"/interaction_profiles/ext/hand_interaction_ext", "/input/pinch_ext/value", "/input/grasp_ext/value", "", "", "",
       "", "", "", "XR_EXT_hand_interaction", true},
  };
  return kSuggestions;
}

const Suggestion* suggested(std::string_view profile) {
  for (const Suggestion& one : suggestions())
    if (one.profile == profile) return &one;
  return nullptr;
}

ControllerParts partsOf(std::string_view profile, size_t hand) {
  const Suggestion* of = suggested(profile);
  if (!of || of->bareHand) return {};
  ControllerParts parts;
  parts.stick = of->steer == "/input/thumbstick";
  parts.pad = of->steer == "/input/trackpad";
  parts.ring = of->ring;
  for (const std::string_view button : {of->first(hand), of->second(hand), of->menu})
    parts.buttons += button.empty() ? 0 : 1;
  return parts;
}

std::vector<std::string> extensionsOfControllers() {
  std::vector<std::string> names;
  for (const Suggestion& suggestion : suggestions()) {
    const bool known = std::find(names.begin(), names.end(), suggestion.extension) != names.end();
    if (!suggestion.extension.empty() && !known) names.emplace_back(suggestion.extension);
  }
  return names;
}

}  // namespace ps::vr
