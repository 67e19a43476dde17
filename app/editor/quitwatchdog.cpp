// SPDX-License-Identifier: Apache-2.0
#include "app/editor/quitwatchdog.h"

#include <cstdio>
#include <cstdlib>
#include <thread>

namespace ps {

void quitWithin(std::chrono::milliseconds patience) {
  std::thread([patience] {
    std::this_thread::sleep_for(patience);
    std::fputs("phasesketch: a plugin did not come back from its work; the program has been ended.\n", stderr);
    std::_Exit(3);
  }).detach();
}

}  // namespace ps
