// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/profiles.h"

#include <string>

namespace ps::scripted {
namespace {

// Calls use(component) for each that one hand has, until it returns true; whether it did.
template <class Use>
bool anyComponent(const InteractionProfile& profile, size_t hand, Use use) {
  for (std::string_view list : {profile.both, hand == 0 ? profile.left : profile.right}) {
    while (!list.empty()) {
      const size_t end = std::min(list.find(' '), list.size());
      if (end > 0 && use(list.substr(0, end))) return true;
      list.remove_prefix(std::min(end + 1, list.size()));
    }
  }
  return false;
}

}  // namespace

const std::vector<InteractionProfile>& interactionProfiles() {
  static const std::vector<InteractionProfile> kProfiles = {
      {"/interaction_profiles/khr/simple_controller", "",
       "/input/select/click /input/menu/click /input/grip/pose /input/aim/pose /output/haptic", "", ""},
      {"/interaction_profiles/htc/vive_controller", "",
       "/input/system/click /input/squeeze/click /input/menu/click /input/trigger/click /input/trigger/value "
       "/input/trackpad/x /input/trackpad/y /input/trackpad/click /input/trackpad/touch /input/grip/pose "
       "/input/aim/pose /output/haptic",
       "", ""},
      {"/interaction_profiles/oculus/touch_controller", "",
       "/input/squeeze/value /input/trigger/value /input/trigger/touch /input/thumbstick/x /input/thumbstick/y "
       "/input/thumbstick/click /input/thumbstick/touch /input/thumbrest/touch /input/grip/pose /input/aim/pose "
       "/output/haptic",
       "/input/x/click /input/x/touch /input/y/click /input/y/touch /input/menu/click",
       "/input/a/click /input/a/touch /input/b/click /input/b/touch /input/system/click"},
      {"/interaction_profiles/valve/index_controller", "",
       "/input/system/click /input/system/touch /input/a/click /input/a/touch /input/b/click /input/b/touch "
       "/input/squeeze/value /input/squeeze/force /input/trigger/click /input/trigger/value /input/trigger/touch "
       "/input/thumbstick/x /input/thumbstick/y /input/thumbstick/click /input/thumbstick/touch /input/trackpad/x "
       "/input/trackpad/y /input/trackpad/force /input/trackpad/touch /input/grip/pose /input/aim/pose /output/haptic",
       "", ""},
      {"/interaction_profiles/microsoft/motion_controller", "",
       "/input/menu/click /input/squeeze/click /input/trigger/value /input/thumbstick/x /input/thumbstick/y "
       "/input/thumbstick/click /input/trackpad/x /input/trackpad/y /input/trackpad/click /input/trackpad/touch "
       "/input/grip/pose /input/aim/pose /output/haptic",
       "", ""},
      {"/interaction_profiles/samsung/odyssey_controller", "XR_EXT_samsung_odyssey_controller",
       "/input/menu/click /input/squeeze/click /input/trigger/value /input/thumbstick/x /input/thumbstick/y "
       "/input/thumbstick/click /input/trackpad/x /input/trackpad/y /input/trackpad/click /input/trackpad/touch "
       "/input/grip/pose /input/aim/pose /output/haptic",
       "", ""},
      {"/interaction_profiles/facebook/touch_controller_pro", "XR_FB_touch_controller_pro",
       "/input/squeeze/value /input/trigger/value /input/trigger/touch /input/thumbstick/x /input/thumbstick/y "
       "/input/thumbstick/click /input/thumbstick/touch /input/thumbrest/touch /input/thumbrest/force "
       "/input/stylus_fb/force /input/grip/pose /input/aim/pose /output/haptic",
       "/input/x/click /input/x/touch /input/y/click /input/y/touch /input/menu/click",
       "/input/a/click /input/a/touch /input/b/click /input/b/touch /input/system/click"},
      {"/interaction_profiles/meta/touch_controller_plus", "XR_META_touch_controller_plus",
       "/input/squeeze/value /input/trigger/value /input/trigger/touch /input/trigger/force /input/thumbstick/x "
       "/input/thumbstick/y /input/thumbstick/click /input/thumbstick/touch /input/thumbrest/touch /input/grip/pose "
       "/input/aim/pose /output/haptic",
       "/input/x/click /input/x/touch /input/y/click /input/y/touch /input/menu/click",
       "/input/a/click /input/a/touch /input/b/click /input/b/touch /input/system/click"},
      {"/interaction_profiles/bytedance/pico_neo3_controller", "XR_BD_controller_interaction",
       "/input/menu/click /input/system/click /input/trigger/value /input/trigger/touch /input/squeeze/value "
       "/input/thumbstick/x /input/thumbstick/y /input/thumbstick/click /input/thumbstick/touch /input/grip/pose "
       "/input/aim/pose /output/haptic",
       "/input/x/click /input/x/touch /input/y/click /input/y/touch",
       "/input/a/click /input/a/touch /input/b/click /input/b/touch"},
      {"/interaction_profiles/bytedance/pico4_controller", "XR_BD_controller_interaction",
       "/input/system/click /input/trigger/value /input/trigger/touch /input/squeeze/value /input/thumbstick/x "
       "/input/thumbstick/y /input/thumbstick/click /input/thumbstick/touch /input/grip/pose /input/aim/pose "
       "/output/haptic",
       "/input/x/click /input/x/touch /input/y/click /input/y/touch /input/menu/click",
       "/input/a/click /input/a/touch /input/b/click /input/b/touch"},
      {"/interaction_profiles/htc/vive_focus3_controller", "XR_HTC_vive_focus3_controller_interaction",
       "/input/squeeze/click /input/squeeze/touch /input/trigger/click /input/trigger/touch /input/trigger/value "
       "/input/thumbstick/x /input/thumbstick/y /input/thumbstick/click /input/thumbstick/touch "
       "/input/thumbrest/touch /input/grip/pose /input/aim/pose /output/haptic",
       "/input/x/click /input/y/click /input/menu/click", "/input/a/click /input/b/click /input/system/click"},
      {"/interaction_profiles/hp/mixed_reality_controller", "XR_EXT_hp_mixed_reality_controller",
       "/input/menu/click /input/squeeze/value /input/trigger/value /input/thumbstick/x /input/thumbstick/y "
       "/input/thumbstick/click /input/grip/pose /input/aim/pose /output/haptic",
       "/input/x/click /input/y/click", "/input/a/click /input/b/click"},
      {"/interaction_profiles/htc/vive_cosmos_controller", "XR_HTC_vive_cosmos_controller_interaction",
       "/input/shoulder/click /input/squeeze/click /input/trigger/click /input/trigger/value /input/thumbstick/x "
       "/input/thumbstick/y /input/thumbstick/click /input/thumbstick/touch /input/grip/pose /input/aim/pose "
       "/output/haptic",
       "/input/x/click /input/y/click /input/menu/click", "/input/a/click /input/b/click /input/system/click"},
      {"/interaction_profiles/microsoft/hand_interaction", "XR_MSFT_hand_interaction",
       "/input/select/value /input/squeeze/value /input/grip/pose /input/aim/pose", "", ""},
      {"/interaction_profiles/ext/hand_interaction_ext", "XR_EXT_hand_interaction",
       "/input/pinch_ext/value /input/pinch_ext/ready_ext /input/pinch_ext/pose /input/aim_activate_ext/value "
       "/input/aim_activate_ext/ready_ext /input/grasp_ext/value /input/grasp_ext/ready_ext /input/poke_ext/pose "
       "/input/grip/pose /input/aim/pose",
       "", ""},
      {"/interaction_profiles/google/daydream_controller", "",
       "/input/select/click /input/trackpad/x /input/trackpad/y /input/trackpad/click /input/trackpad/touch "
       "/input/grip/pose /input/aim/pose",
       "", ""},
      {"/interaction_profiles/oculus/go_controller", "",
       "/input/system/click /input/trigger/click /input/back/click /input/trackpad/x /input/trackpad/y "
       "/input/trackpad/click /input/trackpad/touch /input/grip/pose /input/aim/pose",
       "", ""},
  };
  return kProfiles;
}

const InteractionProfile* interactionProfile(std::string_view path) {
  for (const InteractionProfile& profile : interactionProfiles())
    if (profile.path == path) return &profile;
  return nullptr;
}

bool hasComponent(const InteractionProfile& profile, size_t hand, std::string_view component) {
  return anyComponent(profile, hand, [&](std::string_view own) {
    return own == component || (own.starts_with(component) && own[component.size()] == '/' &&
                                component.find('/', 1) != std::string_view::npos);
  });
}

bool fits(const InteractionProfile& profile, size_t hand, std::string_view component, XrActionType type) {
  const bool pose = component.ends_with("/pose") || hasComponent(profile, hand, std::string(component) + "/pose");
  const bool output = component.starts_with("/output/");
  switch (type) {
    case XR_ACTION_TYPE_POSE_INPUT:
      return pose;
    case XR_ACTION_TYPE_VIBRATION_OUTPUT:
      return output;
    case XR_ACTION_TYPE_VECTOR2F_INPUT:
      return hasComponent(profile, hand, std::string(component) + "/x");
    default:
      return !pose && !output;
  }
}

}  // namespace ps::scripted
