// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/handinput.h"

#include <string>
#include <string_view>
#include <vector>

namespace ps::vr {

/// On which parts of a controller the actions hang, "" where it has none for one. Parts are written without the hand:
/// "/input/trigger/value".
struct Suggestion {
  std::string_view profile;  ///< "/interaction_profiles/..."
  std::string_view draw, hold, steer, steerPress;
  std::string_view leftFirst, leftSecond, rightFirst, rightSecond;
  std::string_view extension = "";  ///< that brings it
  bool bareHand = false;            ///< it is no controller, and cannot vibrate
  std::string_view menu = "";       ///< brings the palette
  bool ring = false;                ///< by which it is seen, as the hand's model has it

  std::string_view first(size_t hand) const { return hand == kLeft ? leftFirst : rightFirst; }
  std::string_view second(size_t hand) const { return hand == kLeft ? leftSecond : rightSecond; }
};

/// Of controllers, and of bare hands that the headset sees: a pinch is a trigger, a fist a grip. Each has
/// /input/grip/pose and /input/aim/pose as well.
const std::vector<Suggestion>& suggestions();
/// The one for a profile; nullptr: there is none.
const Suggestion* suggested(std::string_view profile);

/// What a model of a controller has on its back and around it; nothing of bare hands and of what is not suggested.
struct ControllerParts {
  bool stick = false, pad = false, ring = false;
  int buttons = 0;
};
ControllerParts partsOf(std::string_view profile, size_t hand);

/// What brings the ones that OpenXR 1.0 does not know by itself.
std::vector<std::string> extensionsOfControllers();

}  // namespace ps::vr
