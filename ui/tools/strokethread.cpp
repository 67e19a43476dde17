// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/strokethread.h"

#include "core/base/callee.h"
#include "ui/tools/brushcall.h"

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace ps {

struct StrokeThread::Shared {
  using Job = std::function<std::vector<api::Cell>(StrokeMaker&)>;

  std::string brush;
  std::unique_ptr<StrokeMaker> maker;  // of the thread alone
  bool alone = false;                  // no thread was to be had: jobs are done where they are asked for
  std::mutex mutex;
  std::condition_variable asked, came;
  std::function<void()> ready;
  std::deque<Job> jobs;
  std::vector<api::Cell> cells;
  std::exception_ptr problem;
  size_t done = 0;
  bool busy = false, ends = false;

  size_t open() const { return jobs.size() + (busy ? 1 : 0); }
  void doNext(std::unique_lock<std::mutex>& lock) {
    const Job job = std::move(jobs.front());
    jobs.pop_front();
    busy = true;
    lock.unlock();
    std::vector<api::Cell> fresh;
    std::exception_ptr failed;
    try {
      const CalleeScope callee(brush.c_str());
      fresh = job(*maker);
    } catch (...) {
      failed = std::current_exception();
    }
    lock.lock();
    busy = false;
    ++done;
    cells.insert(cells.end(), fresh.begin(), fresh.end());
    if (failed) {
      problem = failed;
      ends = true;
      jobs.clear();
    }
    came.notify_all();
    if (ready && (failed || !fresh.empty())) ready();
  }
  void work() {
    std::unique_lock lock(mutex);
    while (!ends) {
      asked.wait(lock, [this] { return ends || !jobs.empty(); });
      if (!ends) doNext(lock);
    }
  }
};

StrokeThread::StrokeThread(std::string brush, std::unique_ptr<StrokeMaker> maker, std::function<void()> ready)
    : m_shared(std::make_shared<Shared>()) {
  m_shared->brush = std::move(brush);
  m_shared->maker = std::move(maker);
  m_shared->ready = std::move(ready);
  try {
    std::thread([shared = m_shared] { shared->work(); }).detach();
  } catch (const std::system_error&) {
    m_shared->alone = true;
  }
}

StrokeThread::~StrokeThread() {
  {
    const std::lock_guard lock(m_shared->mutex);
    m_shared->ready = nullptr;
    m_shared->ends = true;
    m_shared->jobs.clear();
  }
  m_shared->asked.notify_all();
  if (!m_left) wait();
}

void StrokeThread::ask(std::function<std::vector<api::Cell>(StrokeMaker&)> job) {
  std::unique_lock lock(m_shared->mutex);
  if (m_shared->ends) return;
  m_shared->jobs.push_back(std::move(job));
  if (m_shared->alone) return m_shared->doNext(lock);
  lock.unlock();
  m_shared->asked.notify_all();
}

void StrokeThread::add(const api::StrokeSample& raw) {
  ask([raw](StrokeMaker& maker) { return maker.add(raw); });
}

void StrokeThread::lift() {
  ask([](StrokeMaker& maker) { return maker.lift(); });
}

std::vector<api::Cell> StrokeThread::take() {
  const std::lock_guard lock(m_shared->mutex);
  if (m_shared->cells.empty() && m_shared->problem) std::rethrow_exception(std::exchange(m_shared->problem, nullptr));
  return std::exchange(m_shared->cells, {});
}

bool StrokeThread::wait() {
  std::unique_lock lock(m_shared->mutex);
  size_t before = m_shared->done;
  for (int look = 0; look < kBrushLooks; ++look) {
    if (m_shared->came.wait_for(lock, kBrushLook, [this] { return m_shared->open() == 0; })) return true;
    if (std::exchange(before, m_shared->done) != m_shared->done) look = 0;
  }
  leave();
  return false;
}

std::pair<size_t, size_t> StrokeThread::progress() const {
  const std::lock_guard lock(m_shared->mutex);
  return {m_shared->open(), m_shared->done};
}

}  // namespace ps
