// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace ps {

/// One thread for what would hold up the interface: files, exports, plugin start-up. Jobs run in order.
class Worker {
 public:
  Worker();
  /// Finishes what is queued.
  ~Worker();
  void run(std::function<void()> job);
  /// Blocks until all jobs queued so far are done.
  void wait();

 private:
  void loop(const std::stop_token& stop);
  std::mutex m_mutex;
  std::condition_variable_any m_wake;
  std::deque<std::function<void()>> m_jobs;
  std::jthread m_thread;
};

}  // namespace ps
