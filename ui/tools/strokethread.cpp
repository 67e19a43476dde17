// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/strokethread.h"

#include "ui/tools/brushcall.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <span>
#include <system_error>
#include <thread>
#include <utility>

namespace ps {

struct StrokeThread::Shared {
  std::unique_ptr<StrokeMaker> maker;  // of the thread alone, but for what may be called from any
  bool alone = false;                  // no thread was to be had: all is done where it is asked for
  std::mutex mutex;
  std::condition_variable asked, came;
  std::function<void()> ready;
  std::vector<std::optional<api::StrokeSample>> waiting;  // nothing: the way is lifted there
  std::vector<api::StrokeSample> way;                     // of the thread alone
  std::vector<api::Cell> cells, fresh;                    // the latter of the thread alone
  std::exception_ptr problem;
  size_t places = 0;  // that have been drawn
  bool busy = false, ends = false;

  bool idle() const { return waiting.empty() && !busy; }
  /// All that waits up to where the way is lifted, at once: a brush that is slower than the hand catches up so.
  void doNext(std::unique_lock<std::mutex>& lock) {
    const auto lifted = std::find(waiting.begin(), waiting.end(), std::nullopt);
    const bool lifts = lifted != waiting.end();
    way.clear();
    fresh.clear();
    std::for_each(waiting.begin(), lifted, [&](const auto& place) { way.push_back(*place); });
    waiting.erase(waiting.begin(), lifts ? lifted + 1 : lifted);
    busy = true;
    lock.unlock();
    std::exception_ptr failed;
    const auto keep = [&](std::span<const api::Cell> more) { fresh.insert(fresh.end(), more.begin(), more.end()); };
    try {
      keep(maker->add(way));
      if (lifts) keep(maker->lift());
    } catch (...) {
      failed = std::current_exception();
    }
    lock.lock();
    busy = false;
    cells.insert(cells.end(), fresh.begin(), fresh.end());
    if (failed) {
      problem = failed;
      ends = true;
      waiting.clear();
    } else {
      places += way.size();
    }
    came.notify_all();
    if (ready && (failed || !fresh.empty())) ready();
  }
  void work() {
    std::unique_lock lock(mutex);
    while (!ends) {
      asked.wait(lock, [this] { return ends || !waiting.empty(); });
      if (!ends) doNext(lock);
    }
  }
};

StrokeThread::StrokeThread(std::unique_ptr<StrokeMaker> maker, std::function<void()> ready)
    : m_shared(std::make_shared<Shared>()) {
  m_shared->maker = std::move(maker);
  m_shared->ready = std::move(ready);
  try {
    std::thread([shared = m_shared] { shared->work(); }).detach();
  } catch (const std::system_error&) {
    m_shared->alone = true;
  }
}

StrokeThread::~StrokeThread() { drop(); }

bool StrokeThread::drop() {
  {
    const std::lock_guard lock(m_shared->mutex);
    m_shared->ready = nullptr;
    m_shared->ends = true;
    m_shared->waiting.clear();
  }
  m_shared->maker->cancel();
  m_shared->asked.notify_all();
  return m_left || wait();
}

void StrokeThread::ask(const std::optional<api::StrokeSample>& place) {
  std::unique_lock lock(m_shared->mutex);
  if (m_shared->ends) return;
  m_shared->waiting.push_back(place);
  if (m_shared->alone) return m_shared->doNext(lock);
  lock.unlock();
  m_shared->asked.notify_all();
}

void StrokeThread::add(const api::StrokeSample& raw) { ask(raw); }

void StrokeThread::lift() { ask(std::nullopt); }

std::vector<api::Cell> StrokeThread::take() {
  const std::lock_guard lock(m_shared->mutex);
  if (m_shared->cells.empty() && m_shared->problem) std::rethrow_exception(std::exchange(m_shared->problem, nullptr));
  return std::exchange(m_shared->cells, {});
}

bool StrokeThread::isIdle(std::chrono::milliseconds patience) {
  std::unique_lock lock(m_shared->mutex);
  return m_shared->came.wait_for(lock, patience, [this] { return m_shared->idle(); });
}

bool StrokeThread::wait() {
  std::unique_lock lock(m_shared->mutex);
  for (int look = 0; look < kBrushLooks; ++look) {
    if (m_shared->came.wait_for(lock, kBrushLook, [this] { return m_shared->idle(); })) return true;
    if (!m_shared->maker->asksBrush()) look = 0;  // what takes long is not the brush
  }
  leave();
  return false;
}

bool StrokeThread::asksBrush() const { return m_shared->maker->asksBrush(); }

double StrokeThread::filled() const { return m_shared->maker->filled(); }

bool StrokeThread::leavesScene() const { return m_shared->maker->leavesScene(); }

size_t StrokeThread::places() const {
  const std::lock_guard lock(m_shared->mutex);
  return m_shared->places;
}

}  // namespace ps
