// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace ps::vr {

/// How a stay in the headset came to its end.
struct Ending {
  bool failed = false;
  std::string sentence;  ///< for whoever wears it; "" where it was left as asked
};

}  // namespace ps::vr
