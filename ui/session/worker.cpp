// SPDX-License-Identifier: Apache-2.0
#include "ui/session/worker.h"

#include "core/base/log.h"

#include <future>
#include <string>

namespace ps {

Worker::Worker() : m_thread([this](const std::stop_token& stop) { loop(stop); }) {}

Worker::~Worker() {
  m_thread.request_stop();
  m_thread.join();
}

void Worker::run(std::function<void()> job) {
  {
    const std::lock_guard lock(m_mutex);
    m_jobs.push_back(std::move(job));
  }
  m_wake.notify_one();
}

void Worker::wait() {
  std::promise<void> done;
  run([&done] { done.set_value(); });
  done.get_future().wait();
}

void Worker::loop(const std::stop_token& stop) {
  for (;;) {
    std::function<void()> job;
    {
      std::unique_lock lock(m_mutex);
      if (!m_wake.wait(lock, stop, [this] { return !m_jobs.empty(); })) return;
      job = std::move(m_jobs.front());
      m_jobs.pop_front();
    }
    try {
      job();
    } catch (const std::exception& error) {
      log(LogLevel::Error, std::string("Background work failed: ") + error.what());
    }
  }
}

}  // namespace ps
