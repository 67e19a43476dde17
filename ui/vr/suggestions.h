// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>
#include <vector>

namespace ps::vr {

/// On which parts of a controller the actions hang, "" where it has none for one. Parts are written without the hand:
/// "/input/trigger/value".
struct Suggestion {
  std::string_view profile;  ///< "/interaction_profiles/..."
  std::string_view draw, hold, steer, steerPress;
  std::string_view leftFirst, leftSecond, rightFirst, rightSecond;
};

/// Of the controllers that OpenXR 1.0 knows without extensions. Each has /input/grip/pose, /input/aim/pose and
/// /output/haptic as well.
const std::vector<Suggestion>& suggestions();

}  // namespace ps::vr
