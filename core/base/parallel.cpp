// SPDX-License-Identifier: Apache-2.0
#include "core/base/parallel.h"

#include "core/base/workers.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

namespace ps {
namespace {
int g_threads = 0;
/// By which each thread that helps makes a loop longer, to come and to be waited for: work / n + this * n is least
/// where n is the root of their ratio. What takes less than kLeastShared is over before others have come, and lies in
/// the caches of who does it. ThreadSanitizer is to see small loops shared too.
#if defined(__SANITIZE_THREAD__)
constexpr double kMicrosecondsPerThread = 0.001, kLeastShared = 0;
#else
constexpr double kMicrosecondsPerThread = 0.2, kLeastShared = 5;
#endif

std::unique_ptr<Workers>& workers() {
  static auto all = std::make_unique<Workers>(threadCount() - 1);
  return all;
}

thread_local double t_shared = 0;  // s
thread_local int t_loops = 0;      // that this thread is in

using Clock = std::chrono::steady_clock;

/// Counts the time of a loop, unless it runs within another.
class SharedTime {
 public:
  SharedTime() { ++t_loops; }
  ~SharedTime() {
    if (--t_loops == 0) t_shared += std::chrono::duration<double>(Clock::now() - m_start).count();
  }
  SharedTime(const SharedTime&) = delete;
  SharedTime& operator=(const SharedTime&) = delete;

 private:
  Clock::time_point m_start = Clock::now();
};

using Body = std::function<void(size_t, size_t)>;

void run(size_t count, size_t grain, const Body& body, double microseconds, LoopCost* cost) {
  if (count == 0) return;
  const size_t chunks = chunkCount(count, grain);
  const auto runChunk = [&](size_t chunk) { body(chunk * grain, std::min(count, (chunk + 1) * grain)); };
  if (chunks == 1) return runChunk(0);
  const SharedTime counted;
  const size_t threads = std::min(chunks, static_cast<size_t>(threadsWorth(microseconds)));
  const Workers::Own own = workers()->share(static_cast<int>(threads) - 1, chunks, std::cref(runChunk));
  if (cost && own.chunks > 0)
    cost->learn(std::chrono::duration<double, std::micro>(own.end - own.begin).count(),
                std::min(count, own.chunks * grain));
}
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
  if (microseconds < kLeastShared) return 1;
  const double worth = std::sqrt(std::max(0.0, microseconds) / kMicrosecondsPerThread);
  return static_cast<int>(std::clamp(worth, 1.0, static_cast<double>(threadCount())));
}

double LoopCost::microseconds(size_t count, size_t grain) const {
  const double each = double{m_each.load(std::memory_order_relaxed)};
  return static_cast<double>(count) * (each < 0 ? grain::microseconds(grain) : each);
}

/// A thread that was held up says nothing of the loop: no more than four times what was known counts.
void LoopCost::learn(double microseconds, size_t elements) {
  constexpr float kWeight = 0.25f, kMost = 4;
  const float known = m_each.load(std::memory_order_relaxed);
  const float seen = static_cast<float>(microseconds / static_cast<double>(elements));
  m_each.store(known < 0 ? seen : known + kWeight * (std::min(seen, kMost * known) - known), std::memory_order_relaxed);
}

void parallelFor(size_t count, size_t grain, const Body& body, double microseconds) {
  grain = std::max<size_t>(1, grain);
  run(count, grain, body, microseconds < 0 ? LoopCost().microseconds(count, grain) : microseconds, nullptr);
}

void parallelFor(size_t count, size_t grain, const Body& body, LoopCost& cost) {
  grain = std::max<size_t>(1, grain);
  run(count, grain, body, cost.microseconds(count, grain), &cost);
}

double parallelSum(size_t count, size_t grain, const std::function<double(size_t, size_t)>& body) {
  // Memory of the last sum of this thread; a sum inside of another finds none and has its own.
  static thread_local std::vector<double> spare;
  std::vector<double> partial = std::move(spare);
  grain = std::max<size_t>(1, grain);
  partial.assign((count + grain - 1) / grain, 0.0);
  const auto part = [&](size_t first, size_t last) { partial[first / grain] = body(first, last); };
  parallelFor(count, grain, std::cref(part));
  double sum = 0;
  for (const double p : partial) sum += p;
  spare = std::move(partial);
  return sum;
}

}  // namespace ps
