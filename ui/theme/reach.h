// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtGui/QPointingDevice>

#include <algorithm>

namespace ps {

/// Logical pixels around a small thing within which the pointer takes hold of it: `precise` of a mouse or a pen. A
/// finger, and a hand in a headset, which points as one, has 13: twice that are 2.5 degrees on the board there.
inline double reachOf(const QPointerEvent& event, double precise) {
  constexpr double kFinger = 13;
  return event.pointerType() == QPointingDevice::PointerType::Finger ? std::max(kFinger, precise) : precise;
}

}  // namespace ps
