// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/handinput.h"

namespace ps::vr {

/// How a hand is held whose joints nobody tells, as what it does shows.
enum class HandShape { Relaxed, Pointing, Pinching, Fist };

/// `nearPanel`: it is about to press something.
HandShape shapeOf(const HandInput& input, bool nearPanel);
/// Of a hand whose grip is known, in the grip's space, m.
HandJoints posedJoints(size_t hand, const HandPose& grip, HandShape shape);

}  // namespace ps::vr
