// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <openxr/openxr.h>

#include <array>
#include <string_view>

namespace ps::scripted {

/// How a bare hand holds its fingers; "": it is not seen.
inline constexpr std::string_view kHandShapes[] = {"", "relaxed", "pinch", "fist", "point"};

struct HandJoint {
  XrPosef pose{};
  float radius = 0;  ///< m
};
using HandJoints = std::array<HandJoint, XR_HAND_JOINT_COUNT_EXT>;

/// Of a left (0) or right hand in one of those shapes, about its palm: fingers lead along -z, the back of the hand
/// along y. A hand as long as 190 mm.
HandJoints jointsOf(std::string_view shape, size_t hand);

}  // namespace ps::scripted
