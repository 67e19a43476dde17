// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/Qt>

namespace ps {

class Session;

/// s at the right end of all that lies along time: the duration, or what was recorded, keyed or marked beyond.
double timeAxisEnd(Session& session, double duration);

/// s, near a time that a double-click or a menu means: a tenth of a second, or where all is shorter than one second a
/// hundredth and less; with Ctrl a frame, with Shift any time. What is set acts at a frame: of frames that do not
/// divide a tenth the nearest one.
double timeToSet(Session& session, double seconds, Qt::KeyboardModifiers modifiers);

/// Between the ends of rows, in logical pixels.
struct TimeAxis {
  int left = 0, right = 0;  ///< margins
};

}  // namespace ps
