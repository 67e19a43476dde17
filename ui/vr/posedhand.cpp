// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/posedhand.h"

#include "ui/vr/barehand.h"

#include <cmath>
#include <iterator>

namespace ps::vr {
namespace {

constexpr double kHeld = 0.5;  // of a pinch's way, and of a fist's
// A hand of medium size, m: bones of a finger from its knuckle, and radii to the skin.
constexpr double kBones[] = {0.042, 0.026, 0.021};
constexpr double kKnuckles = -0.045, kRoots = 0.020, kWrist = 0.048;
constexpr double kThick = 0.011, kThin = 0.0085, kWristRadius = 0.022;
constexpr double kAcross[] = {-0.028, -0.006, 0.015, 0.034};  // of a right hand's fingers
constexpr double kShorter[] = {0.95, 1.05, 0.97, 0.78};
constexpr size_t kFinger = 5;  // joints

/// rad at each of a finger's joints.
struct Bends {
  double index, others;
};

Bends bendsOf(HandShape shape) {
  switch (shape) {
    case HandShape::Pointing:
      return {0.03, 1.4};
    case HandShape::Pinching:
      return {0.55, 0.35};
    case HandShape::Fist:
      return {1.4, 1.4};
    default:
      return {0.28, 0.32};
  }
}

/// From its root to its tip, bent towards the palm.
void setFinger(HandJoints& joints, size_t finger, double bend) {
  size_t joint = kThumbTip + 1 + kFinger * finger;
  const double across = kAcross[finger];
  joints[joint++] = {{0.4 * across, 0, kRoots}, kThick};
  Vector3 at(across, 0, kKnuckles);
  double angle = 0;
  for (size_t bone = 0; bone < std::size(kBones); ++bone) {
    angle += bend;
    joints[joint++] = {at, bone == 0 ? kThick : kThin};
    at += kShorter[finger] * kBones[bone] * Vector3(0, -std::sin(angle), -std::cos(angle));
  }
  joints[joint] = {at, kThin};
}

/// On the index's tip in a pinch, before closed fingers, beside the hand else.
Vector3 thumbTip(HandShape shape, const Vector3& index) {
  if (shape == HandShape::Pinching) return index - Vector3(0, 2 * kThin, 0);
  if (shape == HandShape::Fist || shape == HandShape::Pointing) return {0.002, -0.052, -0.052};
  return {-0.058, -0.02, -0.052};
}

}  // namespace

HandShape shapeOf(const HandInput& input, bool nearPanel) {
  if (input.hold > kHeld) return HandShape::Fist;
  if (input.draw > kHeld) return HandShape::Pinching;
  return nearPanel ? HandShape::Pointing : HandShape::Relaxed;
}

HandJoints posedJoints(size_t hand, const HandPose& grip, HandShape shape) {
  const auto [index, others] = bendsOf(shape);
  HandJoints joints;
  joints[0] = {{0, 0, 0}, kThick};
  joints[kWristJoint] = {{0, 0, kWrist}, kWristRadius};
  for (size_t finger = 0; finger < std::size(kAcross); ++finger)
    setFinger(joints, finger, finger == 0 ? index : others);
  const Vector3 root(-0.036, -0.012, 0), tip = thumbTip(shape, joints[kIndexTip].position);
  joints[2] = {{-0.02, -0.006, 0.03}, kThick};
  joints[3] = {root, kThick};
  joints[4] = {(root + tip) / 2 - Vector3(0.012, 0, 0), kThin};
  joints[kThumbTip] = {tip, kThin};
  const HandPose palm = palmOf(hand, grip);
  for (HandJoint& joint : joints) {
    if (hand == kLeft) joint.position.x() = -joint.position.x();
    joint.position = palm.position + palm.orientation * joint.position;
  }
  return joints;
}

}  // namespace ps::vr
