// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <string>
#include <thread>

namespace ps {

/// Watches, from a thread of its own, for plugins that do not come back from a call. Time is counted in looks, so that
/// a program that was stopped accuses nobody.
class CallWatch {
 public:
  using Tell = std::function<void(const std::string& id)>;
  /// `late` is told once of each call that lasts longer than `patience`, in s; `back` when such a call has returned
  /// after all. Both on the watching thread.
  CallWatch(double patience, Tell late, Tell back = {});

 private:
  std::jthread m_thread;
};

}  // namespace ps
