// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/renderer.h"
#include "ui/vr/handinput.h"
#include "ui/vr/headsetlink.h"

namespace ps::vr {

/// A wand as long as a hand, with a point of the brush's colour. `hand` is in the scene, of which `scale` m are one of
/// the room.
void addWand(Props& props, const HandPose& hand, double scale, const std::array<float, 3>& colour, bool dark);
/// A bare hand by its joints, in the scene; the index's tip has the brush's colour.
void addHand(Props& props, const HandJoints& joints, const std::array<float, 3>& colour, bool dark);
/// A beam from the wand's tip to `length` m from where the hand aims, and a dot at its end.
void addBeam(Props& props, const HandPose& hand, double scale, double length, const std::array<float, 3>& colour);
/// What a dab of the brush would fill there.
void addVolume(Props& props, const Vector3& centre, const BrushVolume& brush);

}  // namespace ps::vr
