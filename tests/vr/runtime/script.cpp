// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/script.h"

#include "tests/vr/runtime/profiles.h"
#include "tests/vr/runtime/scriptreader.h"

#include <algorithm>
#include <utility>

namespace ps::scripted {

const std::vector<std::string>& knownExtensions() {
  static const std::vector<std::string> kExtensions = {"XR_KHR_opengl_enable",
                                                       "XR_MNDX_egl_enable",
                                                       "XR_KHR_composition_layer_depth",
                                                       "XR_KHR_visibility_mask",
                                                       "XR_FB_display_refresh_rate",
                                                       "XR_EXT_local_floor",
                                                       "XR_EXT_hp_mixed_reality_controller",
                                                       "XR_HTC_vive_cosmos_controller_interaction",
                                                       "XR_HTC_vive_focus3_controller_interaction",
                                                       "XR_FB_touch_controller_pro",
                                                       "XR_META_touch_controller_plus",
                                                       "XR_BD_controller_interaction",
                                                       "XR_EXT_samsung_odyssey_controller",
                                                       "XR_MSFT_hand_interaction",
                                                       "XR_EXT_hand_interaction",
                                                       "XR_EXT_hand_tracking"};
  return kExtensions;
}

Script::Script(const std::string& path) {
  profile.fill(std::string(interactionProfiles().front().path));
  extensions = knownExtensions();
  formats = swapchainFormats();
  if (!path.empty()) ScriptReader(path).read(*this);
}

void Script::goOn(Script&& later, int64_t begin) {
  m_begin = begin;
  m_head = std::move(later.m_head);
  m_grip = std::move(later.m_grip);
  m_aim = std::move(later.m_aim);
  m_hands = std::move(later.m_hands);
  m_pictures.clear();
  for (const int64_t frame : later.m_pictures) m_pictures.insert(frame + begin);
  events = std::move(later.events);
  for (ScriptEvent& event : events) event.frame += double(begin);
}

XrPosef Script::at(const Track& track, double frame, const XrPosef& otherwise) {
  if (track.empty()) return otherwise;
  const auto after =
      std::upper_bound(track.begin(), track.end(), frame, [](double f, const Key& key) { return f < key.frame; });
  if (after == track.begin()) return track.front().pose;
  const auto before = after - 1;
  if (after == track.end()) return before->pose;
  return between(before->pose, after->pose, float((frame - before->frame) / (after->frame - before->frame)));
}

// Of somebody who stands and holds both hands in front.
XrPosef Script::head(double frame) const { return at(m_head, frame - double(m_begin), {{0, 0, 0, 1}, {0, 1.6f, 0}}); }
XrPosef Script::grip(size_t hand, double frame) const {
  return at(m_grip[hand], frame - double(m_begin), {{0, 0, 0, 1}, {hand == 0 ? -0.2f : 0.2f, 1.3f, -0.4f}});
}
XrPosef Script::aim(size_t hand, double frame) const {
  return at(m_aim[hand], frame - double(m_begin), grip(hand, frame));
}

HandState Script::hand(size_t hand, double frame) const {
  HandState state;
  for (const HandKey& key : m_hands[hand]) {
    if (key.frame > frame - double(m_begin)) break;
    state.active = key.active.value_or(state.active);
    state.tracked = key.tracked.value_or(state.tracked);
    state.shape = key.shape.value_or(state.shape);
    for (const auto& [component, value] : key.inputs) state.inputs[component] = value;
  }
  return state;
}

}  // namespace ps::scripted
