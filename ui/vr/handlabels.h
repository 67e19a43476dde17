// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/handinput.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ps::vr {

/// A part of what a hand holds, by the name that its maker gives it, and what it does in the scene.
struct HandLabel {
  std::string part, does;
};

/// In place of a profile: a hand that mouse and keyboard lead, and a bare one of which nobody but its joints tells.
inline constexpr std::string_view kMouse = "mouse", kJointsAlone = "joints";

/// What the parts of a controller, of a bare hand, or of mouse and keyboard do; none of a profile that is not
/// suggested.
std::vector<HandLabel> labelsOf(std::string_view profile, size_t hand, const HandRoles& roles = {});

}  // namespace ps::vr
