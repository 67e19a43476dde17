// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/handinput.h"

namespace ps::vr {

/// As OpenXR counts joints: each finger from its root to its tip, the thumb first.
inline constexpr size_t kWristJoint = 1, kThumbTip = 5, kIndexTip = 10, kMiddleKnuckle = 12, kLittleTip = 25;

/// A bare hand as the headset sees it, in the floor's space.
struct SeenHand {
  HandJoints joints;
  HandPose palm;  ///< -z leads along the fingers, y to the back of the hand
};

/// How far thumb and index have come together, 0..1: a trigger.
double pinchOf(const SeenHand& hand);
/// How far all fingers but the thumb are closed, the least of them, 0..1: a grip. A hand that points makes no fist.
double fistOf(const SeenHand& hand);
/// Whether its index is straight while the three fingers beside it are closed.
bool pointsWith(const SeenHand& hand);

/// Of a hand whose grip is known, as SeenHand::palm.
HandPose palmOf(size_t hand, const HandPose& grip);

/// Has a hand's input say what its bare hand does: the tip of the index is where things are drawn and pressed.
/// `told`: who reads hands tells already where it aims and how far it pinches and holds; else that follows from joints.
void useBareHand(HandInput& input, size_t hand, const SeenHand& seen, bool told);

}  // namespace ps::vr
