// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <openxr/openxr.h>

namespace ps::scripted {

/// Where something is and how it is turned: a rigid motion. Metres; unit quaternions.
inline constexpr XrPosef kNoMotion{{0, 0, 0, 1}, {0, 0, 0}};

XrVector3f rotated(const XrQuaternionf& turn, const XrVector3f& vector);
/// First `inner`, then `outer`: the pose in the world of what has the pose `inner` in something at `outer`.
XrPosef combined(const XrPosef& outer, const XrPosef& inner);
XrPosef inverse(const XrPosef& pose);
/// From a (t = 0) to b (t = 1): straight, and turning at one speed by the shorter way.
XrPosef between(const XrPosef& a, const XrPosef& b, float t);
/// Whether the quaternion's length is 1 within a hundredth, which is what runtimes have to accept.
bool isUnit(const XrQuaternionf& turn);
/// The axis times the angle in radians, of the shorter way.
XrVector3f rotationVector(const XrQuaternionf& turn);

}  // namespace ps::scripted
