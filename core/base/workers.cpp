// SPDX-License-Identifier: Apache-2.0
#include "core/base/workers.h"

#include <chrono>
#include <system_error>
#include <utility>

namespace ps {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kAwake = std::chrono::microseconds(500);  // after the last loop
constexpr uint32_t kPlace = 1u << 16, kTaken = kPlace - 1;

/// Looks again soon: at once for a few microseconds, and then with a look at who else wants the core. Who waits leaves
/// most of a core that two threads share to the other, which may be the one that works.
class Patience {
 public:
  void wait() {
    const bool atOnce = ++m_looks <= kAtOnce;
#if defined(__x86_64__) || defined(__i386__)
    for (int k = 0; k < (atOnce ? kShort : kLong); ++k) __builtin_ia32_pause();
#endif
    if (!atOnce) std::this_thread::yield();
  }

 private:
  static constexpr int kAtOnce = 100, kShort = 8, kLong = 48;
  int m_looks = 0;
};

}  // namespace

Workers::Workers(int count) {
  try {
    for (int k = 0; k < count; ++k) m_threads.emplace_back([this] { work(); });
  } catch (const std::system_error&) {  // no more threads are to be had: those that are there do
  }
}

Workers::~Workers() {
  m_stop = true;
  ++m_posted;
  m_posted.notify_all();
}

Workers::Loop* Workers::freeLoop() {
  for (Loop& loop : m_loops) {
    if (!loop.taken.load(std::memory_order_relaxed) && !loop.taken.exchange(true)) return &loop;
  }
  return nullptr;
}

void Workers::share(int helpers, size_t chunks, const std::function<void(size_t)>& body) {
  Loop* const loop = helpers > 0 ? freeLoop() : nullptr;
  if (!loop) {
    for (size_t chunk = 0; chunk < chunks; ++chunk) body(chunk);
    return;
  }
  loop->body = &body;
  loop->chunks = chunks;
  loop->next.store(0, std::memory_order_relaxed);
  loop->places.store(static_cast<uint32_t>(helpers) * kPlace, std::memory_order_release);
  ++m_posted;
  if (m_sleeping > 0) m_posted.notify_one();
  run(*loop);
  loop->places.fetch_and(kTaken);  // who comes now comes too late
  for (Patience patience; loop->places.load(std::memory_order_acquire) != 0;) patience.wait();
  const std::exception_ptr error = std::exchange(loop->error, nullptr);
  loop->taken = false;
  if (error) std::rethrow_exception(error);
}

void Workers::run(Loop& loop) {
  try {
    for (size_t chunk = loop.next++; chunk < loop.chunks; chunk = loop.next++) (*loop.body)(chunk);
  } catch (...) {
    const std::lock_guard lock(loop.mutex);
    if (!loop.error) loop.error = std::current_exception();
    loop.next = loop.chunks;
  }
}

/// Whether there was a loop with a free place; it has then ended.
bool Workers::help() {
  for (Loop& loop : m_loops) {
    uint32_t places = loop.places.load(std::memory_order_acquire);
    while (places >= kPlace) {
      if (!loop.places.compare_exchange_weak(places, places - kPlace + 1, std::memory_order_acq_rel)) continue;
      if (places >= 2 * kPlace && m_sleeping > 0) m_posted.notify_one();
      run(loop);
      loop.places.fetch_sub(1, std::memory_order_release);
      return true;
    }
  }
  return false;
}

void Workers::work() {
  Patience patience;
  auto last = Clock::now();
  for (;;) {
    const int posted = m_posted;
    if (m_stop) return;  // asked after: who stops raises m_posted behind it, and nobody sleeps through that
    if (help()) {
      patience = {};
      last = Clock::now();
    } else if (Clock::now() - last < kAwake) {
      patience.wait();
    } else {
      ++m_sleeping;
      m_posted.wait(posted);
      --m_sleeping;
      patience = {};
      last = Clock::now();
    }
  }
}

}  // namespace ps
