// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/renderer.h"
#include "ui/vr/handinput.h"
#include "ui/vr/headsetlink.h"

namespace ps::vr {

struct ControllerParts;

struct HandColours {
  std::array<float, 3> tip{};  ///< sRGB, of the brush
  bool dark = true;            ///< of the theme
};

/// A wand as long as a hand, with a point of the brush's colour, and on it what the controller has. `hand` is in the
/// scene, of which `scale` m are one of the room.
void addController(Props& props, const HandPose& hand, double scale, const HandColours& colours,
                   const ControllerParts& parts);
/// A bare hand by its joints, in the scene; the index's tip has the brush's colour.
void addHand(Props& props, const HandJoints& joints, const HandColours& colours);
/// A beam from the wand's tip to `length` m from where the hand aims, and a dot at its end.
void addBeam(Props& props, const HandPose& hand, double scale, double length, const std::array<float, 3>& colour);
/// What a dab of the brush would fill there.
void addVolume(Props& props, const Vector3& centre, const BrushVolume& brush);

}  // namespace ps::vr
