// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/barehand.h"

#include "ui/vr/handlabels.h"

#include <algorithm>

namespace ps::vr {
namespace {

constexpr double kPinch = 0.010;              // m between the skins of thumb and index, from which they pinch
constexpr double kOpen = 1.0, kClosed = 0.6;  // of the palm's length, of fingertips from its middle
constexpr double kBent = 0.7;                 // from which fingers beside one that points count as closed
constexpr double kNoPinch = 0.5;              // of a fist, in which thumb and index meet too
constexpr size_t kFinger = 5;                 // joints

double between(const HandJoint& a, const HandJoint& b) { return (a.position - b.position).norm(); }

/// How far a finger is, 0..1.
double closed(const SeenHand& hand, size_t tip) {
  const HandJoint palm{hand.palm.position, 0};
  const double length = between(hand.joints[kWristJoint], hand.joints[kMiddleKnuckle]);
  if (!(length > 0)) return 0;
  return std::clamp((kOpen - between(hand.joints[tip], palm) / length) / (kOpen - kClosed), 0.0, 1.0);
}
/// The least of the three beside the index.
double closedBeside(const SeenHand& hand) {
  double least = 1;
  for (size_t tip = kIndexTip + kFinger; tip <= kLittleTip; tip += kFinger) least = std::min(least, closed(hand, tip));
  return least;
}

/// As OpenXR has the grip of a controller: -z to the thumb, x out of a left palm and into a right one.
HandPose gripOf(size_t hand, const HandPose& palm) {
  const Matrix3 own = palm.orientation.normalized().toRotationMatrix();
  const double side = hand == kLeft ? -1 : 1;
  Matrix3 axes;
  axes << side * own.col(1), own.col(2), side * own.col(0);
  return {palm.position, Quaternion(axes)};
}

}  // namespace

HandPose palmOf(size_t hand, const HandPose& grip) {
  const Matrix3 own = grip.orientation.normalized().toRotationMatrix();
  const double side = hand == kLeft ? -1 : 1;
  Matrix3 axes;
  axes << side * own.col(2), side * own.col(0), own.col(1);
  return {grip.position, Quaternion(axes)};
}

double pinchOf(const SeenHand& hand) {
  const HandJoint &thumb = hand.joints[kThumbTip], &index = hand.joints[kIndexTip];
  return std::clamp(1 - (between(thumb, index) - thumb.radius - index.radius) / kPinch, 0.0, 1.0);
}

double fistOf(const SeenHand& hand) { return std::min(closed(hand, kIndexTip), closedBeside(hand)); }

bool pointsWith(const SeenHand& hand) { return closed(hand, kIndexTip) == 0 && closedBeside(hand) > kBent; }

void useBareHand(HandInput& input, size_t hand, const SeenHand& seen, bool told) {
  input.joints = seen.joints;
  input.points = pointsWith(seen);
  if (input.profile.empty()) input.profile = kJointsAlone;
  if (!input.grip) input.grip = gripOf(hand, seen.palm);
  const Quaternion aims = input.aim ? input.aim->orientation : seen.palm.orientation;
  input.aim = HandPose{seen.joints[kIndexTip].position + aims * Vector3(0, 0, kTip), aims};
  if (told) return;
  input.hold = fistOf(seen);
  input.draw = input.hold > kNoPinch ? 0 : pinchOf(seen);
}

}  // namespace ps::vr
