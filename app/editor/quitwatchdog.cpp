// SPDX-License-Identifier: Apache-2.0
#include "app/editor/quitwatchdog.h"

#include "core/base/callee.h"
#include "core/plugin_host/crashwatch.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

namespace ps {

void quitWithin(std::chrono::milliseconds patience) {
  std::thread([patience] {
    std::this_thread::sleep_for(patience / 2);
    const std::vector<OngoingCall> before = ongoingCalls();
    std::this_thread::sleep_for(patience / 2);
    for (const OngoingCall& call : ongoingCalls()) {
      if (std::find(before.begin(), before.end(), call) == before.end()) continue;  // a frame that is slow, no more
      const char* follows = putInQuarantine(call.id) ? "; it is in quarantine" : "";
      std::fprintf(stderr, "phasesketch: the plugin '%s' did not come back from its work%s.\n", call.id.c_str(),
                   follows);
    }
    std::fputs("phasesketch: its work did not end in time; the program has been ended.\n", stderr);
    std::_Exit(3);
  }).detach();
}

}  // namespace ps
