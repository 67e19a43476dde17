// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/joints.h"

#include <cmath>

namespace ps::scripted {
namespace {

constexpr float kFingerRadius = 0.008f, kPalmRadius = 0.012f;                      // m
constexpr float kFirst = 0.040f, kSecond = 0.025f, kThird = 0.020f;                // m, of a finger's bones
constexpr float kKnuckles = -0.045f, kWrist = 0.045f, kRoots = 0.025f;             // m along z
constexpr std::array<float, 4> kAcross = {-0.025f, 0.0f, 0.019f, 0.036f};          // m, of a right hand's knuckles
constexpr float kRelaxed = 0.26f, kBent = 1.4f, kPinched = 0.52f, kSpread = 0.3f;  // rad at each joint

struct Bends {
  float index, others;  ///< rad at each of three joints
};

Bends bendsOf(std::string_view shape) {
  if (shape == "pinch") return {kPinched, kSpread};
  if (shape == "fist") return {kBent, kBent};
  if (shape == "point") return {0, kBent};
  return {kRelaxed, kRelaxed};
}

XrPosef bent(float angle, const XrVector3f& place) {
  return {{-std::sin(angle / 2), 0, 0, std::cos(angle / 2)}, place};
}

/// Five joints of a finger, from its root.
void setFinger(HandJoints& joints, size_t first, float across, float bend) {
  joints[first] = {bent(0, {0.5f * across, 0, kRoots}), kPalmRadius};
  XrVector3f at{across, 0, kKnuckles};
  float angle = 0;
  size_t joint = first + 1;
  for (const float bone : {kFirst, kSecond, kThird}) {
    angle += bend;
    joints[joint++] = {bent(angle, at), kFingerRadius};
    at = {across, at.y - bone * std::sin(angle), at.z - bone * std::cos(angle)};
  }
  joints[joint] = {bent(angle, at), kFingerRadius};
}

/// Where the thumb's tip is: on the index's in a pinch, before the fingers in a fist, beside the hand else.
XrVector3f thumbOf(std::string_view shape, const XrVector3f& index) {
  if (shape == "pinch") return {index.x, index.y - 2 * kFingerRadius, index.z};
  if (shape == "fist" || shape == "point") return {0, -0.055f, -0.055f};
  return {-0.055f, -0.022f, -0.055f};
}

}  // namespace

HandJoints jointsOf(std::string_view shape, size_t hand) {
  const auto& [index, others] = bendsOf(shape);
  HandJoints joints;
  joints[XR_HAND_JOINT_PALM_EXT] = {bent(0, {0, 0, 0}), kPalmRadius};
  joints[XR_HAND_JOINT_WRIST_EXT] = {bent(0, {0, 0, kWrist}), 0.02f};
  constexpr size_t kJoints = XR_HAND_JOINT_MIDDLE_METACARPAL_EXT - XR_HAND_JOINT_INDEX_METACARPAL_EXT;
  for (size_t finger = 0; finger < kAcross.size(); ++finger)
    setFinger(joints, XR_HAND_JOINT_INDEX_METACARPAL_EXT + kJoints * finger, kAcross[finger],
              finger == 0 ? index : others);
  const XrVector3f tip = thumbOf(shape, joints[XR_HAND_JOINT_INDEX_TIP_EXT].pose.position), root{-0.035f, -0.012f, 0};
  const XrVector3f middle{(tip.x + root.x) / 2 - 0.012f, (tip.y + root.y) / 2, (tip.z + root.z) / 2};
  joints[XR_HAND_JOINT_THUMB_METACARPAL_EXT] = {bent(0, {-0.02f, -0.006f, 0.03f}), kPalmRadius};
  joints[XR_HAND_JOINT_THUMB_PROXIMAL_EXT] = {bent(0, root), kPalmRadius};
  joints[XR_HAND_JOINT_THUMB_DISTAL_EXT] = {bent(0, middle), kFingerRadius};
  joints[XR_HAND_JOINT_THUMB_TIP_EXT] = {bent(0, tip), kFingerRadius};
  for (HandJoint& joint : joints)
    if (hand == 0) joint.pose.position.x = -joint.pose.position.x;
  return joints;
}

}  // namespace ps::scripted
