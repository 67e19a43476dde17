// SPDX-License-Identifier: Apache-2.0
#include "core/base/callwatch.h"

#include "core/base/callee.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <vector>

namespace ps {
namespace {

constexpr double kPause = 0.1;  // s between two looks

/// A call, and how often it was seen going on.
struct Watched {
  OngoingCall call;
  int looks = 0;
};

void watch(const std::stop_token& stop, double patience, const CallWatch::Tell& late, const CallWatch::Tell& back) {
  const double pause = std::min(kPause, patience / 4);
  const int most = static_cast<int>(patience / pause);
  std::mutex mutex;
  std::condition_variable_any wake;
  std::vector<Watched> seen;
  while (!stop.stop_requested()) {
    {
      std::unique_lock lock(mutex);
      wake.wait_for(lock, stop, std::chrono::duration<double>(pause), [] { return false; });
    }
    std::vector<Watched> now;
    for (OngoingCall& call : ongoingCalls()) now.push_back({std::move(call), 0});
    for (Watched& one : seen) {
      const auto still = std::find_if(now.begin(), now.end(), [&](const Watched& w) { return w.call == one.call; });
      if (still != now.end()) still->looks = one.looks + 1;
      if (still != now.end() && still->looks == most) late(one.call.id);
    }
    for (const Watched& one : seen) {  // of several threads in one plugin the last to come back counts
      const auto lateToo = [&](const Watched& w) { return w.call.id == one.call.id && w.looks >= most; };
      if (back && one.looks >= most && std::none_of(now.begin(), now.end(), lateToo)) back(one.call.id);
    }
    seen = std::move(now);
  }
}

}  // namespace

CallWatch::CallWatch(double patience, Tell late, Tell back)
    : m_thread([patience, late = std::move(late), back = std::move(back)](const std::stop_token& stop) {
        watch(stop, patience, late, back);
      }) {}

}  // namespace ps
