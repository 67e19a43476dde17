// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/handlabels.h"

#include "ui/vr/suggestions.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ps::vr {
namespace {

/// "/input/trigger/value" is "Trigger".
std::string nameOf(std::string_view part) {
  constexpr std::pair<std::string_view, std::string_view> kNames[] = {{"trigger", "Trigger"},
                                                                      {"squeeze", "Grip"},
                                                                      {"thumbstick", "Stick"},
                                                                      {"trackpad", "Pad"},
                                                                      {"menu", "Menu"},
                                                                      {"select", "Select"},
                                                                      {"a", "A"},
                                                                      {"b", "B"},
                                                                      {"x", "X"},
                                                                      {"y", "Y"}};
  const size_t from = std::string_view("/input/").size();
  const std::string_view key = part.substr(from, part.find('/', from) - from);
  const auto found =
      std::find_if(std::begin(kNames), std::end(kNames), [&](const auto& one) { return one.first == key; });
  return std::string(found == std::end(kNames) ? key : found->second);
}

/// As VrHands and Moving take it.
void addSteering(std::vector<HandLabel>& labels, const Suggestion& of, bool main, bool alone) {
  if (of.steer.empty()) return;
  const std::string name = nameOf(of.steer);
  const bool pad = of.steer == "/input/trackpad";
  if (alone && !of.hold.empty())
    labels.push_back(
        {nameOf(of.hold) + ", " + name, pad ? "forward: go there; aside: turn" : "forward: go there; aside: scale"});
  if (!pad) {
    labels.push_back({name, main ? "up, down: size; aside: turn" : "forward: go there"});
    if (main) labels.push_back({name + " pressed", "next material; menu of a panel"});
  } else if (main) {
    labels.push_back({name, "middle: next material"});
    labels.push_back({"", "up, down: size; aside: shape"});
  } else {
    labels.push_back({name, "forward: go there; aside: turn"});
  }
}

/// What a trigger does on a panel and off it, and with the grip.
const char* pulled(bool main) { return main ? "draw, press" : "erase, press"; }
const char* pulledHeld(bool main) { return main ? "erase" : "draw"; }

const char* held(bool alone) { return alone ? "hold" : "hold; both hands: the scene"; }

/// As the window of a trial takes them, whichever hand they lead.
std::vector<HandLabel> keys(bool main) {
  return {{"Left button", pulled(main)},
          {"Shift", "hold"},
          {"Shift, left button", pulledHeld(main)},
          {"G", "both hands: the scene"},
          {"Wheel", "reach"},
          {"X, C", "roll; both: level"},
          {"Up, down", "size"},
          {"Left, right", "turn"},
          {"N", "next material"},
          {"F", "go where the other hand points"},
          {"Space", "play, pause"},
          {"R", "make real"},
          {"U", "undo"},
          {"P", "board"},
          {"M", "palette"},
          {"Tab", "the other hand"}};
}

std::vector<HandLabel> ofBareHand(bool main, bool alone) {
  std::vector<HandLabel> labels{{"Pinch", pulled(main)}, {"Fist", held(alone)}, {"Fist, Pinch", pulledHeld(main)}};
  if (!main || alone) labels.push_back({"Index, then Pinch", "point; go there"});
  return labels;
}

}  // namespace

std::vector<HandLabel> labelsOf(std::string_view profile, size_t hand, const HandRoles& roles) {
  const bool main = hand == roles.main;
  if (profile == kMouse) return keys(main);
  if (profile == kJointsAlone) return ofBareHand(main, roles.alone);
  std::vector<HandLabel> labels;
  const Suggestion* of = suggested(profile);
  if (!of) return labels;
  if (of->bareHand) return ofBareHand(main, roles.alone);
  labels.push_back({nameOf(of->draw), pulled(main)});
  if (!of->hold.empty()) {
    const std::string hold = nameOf(of->hold);
    labels.push_back({hold, held(roles.alone)});
    labels.push_back({hold + ", " + labels.front().part, pulledHeld(main)});
  }
  addSteering(labels, *of, main, roles.alone);
  const std::string_view first = of->first(hand), second = of->second(hand);
  const char* const does[] = {main ? "undo" : "play, pause", main ? "board" : "make real"};
  if (!first.empty()) labels.push_back({nameOf(first), does[0]});
  // One button for both: for half a second it is the second.
  if (!first.empty() && second.empty()) labels.push_back({nameOf(first) + " held", does[1]});
  if (!second.empty()) labels.push_back({nameOf(second), does[1]});
  if (!of->menu.empty()) labels.push_back({nameOf(of->menu), "palette"});
  return labels;
}

}  // namespace ps::vr
