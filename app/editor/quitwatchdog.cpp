// SPDX-License-Identifier: Apache-2.0
#include "app/editor/quitwatchdog.h"

#include "core/base/callee.h"
#include "core/plugin_host/crashwatch.h"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

namespace ps {

void quitWithin(std::chrono::milliseconds patience) {
  std::thread([patience] {
    std::this_thread::sleep_for(patience);
    std::string names;
    for (const OngoingCall& call : ongoingCalls()) {
      putInQuarantine(call.id);
      names += " '" + call.id + "'";
    }
    std::fprintf(
        stderr,
        "phasesketch: the plugin%s did not come back from its work; the program has been ended, and the plugin "
        "is in quarantine.\n",
        names.c_str());
    std::_Exit(3);
  }).detach();
}

}  // namespace ps
