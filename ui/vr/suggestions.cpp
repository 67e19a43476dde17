// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/suggestions.h"

namespace ps::vr {

// A part may carry one action only, so that none does two things at once.
const std::vector<Suggestion>& suggestions() {
  static const std::vector<Suggestion> kSuggestions = {
      {"/interaction_profiles/khr/simple_controller", "/input/select/click", "", "", "", "", "/input/menu/click", "",
       "/input/menu/click"},
      {"/interaction_profiles/htc/vive_controller", "/input/trigger/value", "/input/squeeze/click", "/input/trackpad",
       "/input/trackpad/click", "/input/menu/click", "", "/input/menu/click", ""},
      {"/interaction_profiles/oculus/touch_controller", "/input/trigger/value", "/input/squeeze/value",
       "/input/thumbstick", "/input/thumbstick/click", "/input/x/click", "/input/y/click", "/input/a/click",
       "/input/b/click"},
      {"/interaction_profiles/valve/index_controller", "/input/trigger/value", "/input/squeeze/value",
       "/input/thumbstick", "/input/thumbstick/click", "/input/a/click", "/input/b/click", "/input/a/click",
       "/input/b/click"},
      {"/interaction_profiles/microsoft/motion_controller", "/input/trigger/value", "/input/squeeze/click",
       "/input/thumbstick", "/input/thumbstick/click", "/input/trackpad/click", "/input/menu/click",
       "/input/trackpad/click", "/input/menu/click"},
      {"/interaction_profiles/hp/mixed_reality_controller", "/input/trigger/value", "/input/squeeze/value",
       "/input/thumbstick", "/input/thumbstick/click", "/input/x/click", "/input/y/click", "/input/a/click",
       "/input/b/click", "XR_EXT_hp_mixed_reality_controller"},
      {"/interaction_profiles/htc/vive_cosmos_controller", "/input/trigger/value", "/input/squeeze/click",
       "/input/thumbstick", "/input/thumbstick/click", "/input/x/click", "/input/y/click", "/input/a/click",
       "/input/b/click", "XR_HTC_vive_cosmos_controller_interaction"},
      {"/interaction_profiles/microsoft/hand_interaction", "/input/select/value", "/input/squeeze/value", "", "", "",
       "", "", "", "XR_MSFT_hand_interaction", true},
      {"/interaction_profiles/ext/hand_interaction_ext", "/input/pinch_ext/value", "/input/grasp_ext/value", "", "", "",
       "", "", "", "XR_EXT_hand_interaction", true},
  };
  return kSuggestions;
}

std::vector<std::string> extensionsOfControllers() {
  std::vector<std::string> names;
  for (const Suggestion& suggestion : suggestions())
    if (!suggestion.extension.empty()) names.emplace_back(suggestion.extension);
  return names;
}

}  // namespace ps::vr
