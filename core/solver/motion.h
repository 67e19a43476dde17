// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/types.h>

namespace ps {

/// How a fixed body is led: straight on, and turning about a point that goes with it.
struct BodyMotion {
  api::Double3 centre{0, 0, 0};    ///< m, of the turn, where the body is when it is led for the first time
  api::Double3 velocity{0, 0, 0};  ///< m/s
  api::Double3 spin{0, 0, 0};      ///< rad/s
  double start = 0, stop = 1e9;    ///< s of the scene's time: before and after it stands
};

}  // namespace ps
