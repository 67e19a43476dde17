// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/progress.h"

namespace ps {

/// In a loop of many steps, none of which counts by itself: now and then whether to go on. Throws Cancelled.
inline void askAt(size_t step) {
  if (step % kProgressSlice == 0) advance(0);
}

}  // namespace ps
