// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

class Session;

/// s at the right end of all that lies along time: the duration, or what was recorded, keyed or marked beyond.
double timeAxisEnd(Session& session, double duration);

/// Between the ends of rows, in logical pixels.
struct TimeAxis {
  int left = 0, right = 0;  ///< margins
};

}  // namespace ps
