// SPDX-License-Identifier: Apache-2.0
#include "core/base/parallel.h"

#include "core/base/workers.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

namespace ps {
namespace {
int g_threads = 0;
/// For which another thread is asked to help: somewhat more than that takes. ThreadSanitizer is to see small loops shared too.
#if defined(__SANITIZE_THREAD__)
constexpr double kMicrosecondsPerThread = 0.01;
#else
constexpr double kMicrosecondsPerThread = 7;
#endif

std::unique_ptr<Workers>& workers() {
  static auto all = std::make_unique<Workers>(threadCount() - 1);
  return all;
}

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
  workers() = std::make_unique<Workers>(threadCount() - 1);
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
  const size_t threads = std::min(chunks, static_cast<size_t>(threadsWorth(microseconds)));
  workers()->share(static_cast<int>(threads) - 1, chunks, std::cref(runChunk));
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
