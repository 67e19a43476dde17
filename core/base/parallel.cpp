// SPDX-License-Identifier: Apache-2.0
#include "core/base/parallel.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#if defined(__SANITIZE_THREAD__)
#include <atomic>
#include <exception>
#include <mutex>
#else
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace ps {
namespace {
int g_threads = 0;
/// For which another thread is woken: several times what that takes.
constexpr double kMicrosecondsPerThread = 15;

#if defined(__SANITIZE_THREAD__)
/// The first exception of a loop's threads.
class Caught {
 public:
  void keep() {
    const std::lock_guard lock(m_mutex);
    if (!m_error) m_error = std::current_exception();
  }
  void rethrow() const {
    if (m_error) std::rethrow_exception(m_error);
  }

 private:
  std::mutex m_mutex;
  std::exception_ptr m_error;
};
#else
/// An arena wakes all of its threads for any loop, so that there is one for 2, 4, 8 ... and one for all of them.
class Arenas {
 public:
  explicit Arenas(int threads) {
    for (int size = 2; size < threads; size *= 2) add(size);
    if (threads > 1) add(threads);
  }
  /// The largest of no more than so many threads, of 2 at least.
  tbb::task_arena& of(int threads) {
    size_t k = 0;
    while (k + 1 < m_arenas.size() && m_arenas[k + 1]->max_concurrency() <= threads) ++k;
    return *m_arenas[k];
  }

 private:
  void add(int size) {
    m_arenas.push_back(std::make_unique<tbb::task_arena>(size));
    m_arenas.back()->initialize();
  }
  std::vector<std::unique_ptr<tbb::task_arena>> m_arenas;
};
std::unique_ptr<Arenas>& arenas() {
  static auto all = std::make_unique<Arenas>(threadCount());
  return all;
}
#endif

thread_local double t_shared = 0;  // s
thread_local int t_loops = 0;      // that this thread is in

/// Counts the time of a loop, unless it runs within another.
class SharedTime {
 public:
  SharedTime() {
    if (t_loops++ == 0) m_start = Clock::now();
  }
  ~SharedTime() {
    if (--t_loops == 0) t_shared += std::chrono::duration<double>(Clock::now() - m_start).count();
  }
  SharedTime(const SharedTime&) = delete;
  SharedTime& operator=(const SharedTime&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point m_start;
};
}  // namespace

double secondsShared() { return t_shared; }

void setThreadCount(int count) {
  g_threads = std::max(0, count);
#if !defined(__SANITIZE_THREAD__)
  arenas() = std::make_unique<Arenas>(threadCount());
#endif
}

int threadCount() {
  // Asked once: the answer comes from a file of the operating system, and every loop asks.
  static const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return g_threads > 0 ? g_threads : cores;
}

int threadsWorth(double microseconds) {
  const double worth = std::clamp(microseconds / kMicrosecondsPerThread, 1.0, static_cast<double>(threadCount()));
  return static_cast<int>(worth);
}

void parallelFor(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body, double microseconds) {
  if (count == 0) return;
  grain = std::max<size_t>(1, grain);
  const size_t chunks = (count + grain - 1) / grain;
  const auto runChunk = [&](size_t chunk) { body(chunk * grain, std::min(count, (chunk + 1) * grain)); };
  if (chunks == 1) return runChunk(0);
  const SharedTime counted;
  if (microseconds < 0) microseconds = static_cast<double>(count) * grain::microseconds(grain);
#if defined(__SANITIZE_THREAD__)
  const int threads = threadCount();  // races of small loops count too
#else
  const int threads = threadsWorth(microseconds);
#endif
  if (threads == 1) {
    for (size_t chunk = 0; chunk < chunks; ++chunk) runChunk(chunk);
    return;
  }
#if defined(__SANITIZE_THREAD__)
  std::atomic<size_t> next{0};
  Caught caught;
  const auto work = [&] {
    try {
      for (size_t chunk = next++; chunk < chunks; chunk = next++) runChunk(chunk);
    } catch (...) {
      caught.keep();
    }
  };
  {
    std::vector<std::jthread> others;
    for (int t = 1; t < threads; ++t) others.emplace_back(work);
    work();
  }
  caught.rethrow();
#else
  arenas()->of(threads).execute([&] {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, chunks, 1), [&](const tbb::blocked_range<size_t>& range) {
      for (size_t chunk = range.begin(); chunk != range.end(); ++chunk) runChunk(chunk);
    });
  });
#endif
}

double parallelSum(size_t count, size_t grain, const std::function<double(size_t, size_t)>& body) {
  // Memory of the last sum of this thread; a sum inside of another finds none and has its own.
  static thread_local std::vector<double> spare;
  std::vector<double> partial = std::move(spare);
  grain = std::max<size_t>(1, grain);
  partial.assign((count + grain - 1) / grain, 0.0);
  forChunks(count, grain, [&](size_t first, size_t last) { partial[first / grain] = body(first, last); });
  double sum = 0;
  for (const double p : partial) sum += p;
  spare = std::move(partial);
  return sum;
}

}  // namespace ps
