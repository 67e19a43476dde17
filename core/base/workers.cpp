// SPDX-License-Identifier: Apache-2.0
#include "core/base/workers.h"

#include <algorithm>
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
  for (Loop& loop : m_loops) loop.parts = std::vector<Part>(static_cast<size_t>(std::max(count, 0)) + 1);
  try {
    for (int k = 0; k < count; ++k) m_threads.emplace_back([this, k] { work(static_cast<size_t>(k) + 1); });
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

Workers::Own Workers::share(int helpers, size_t chunks, const std::function<void(size_t)>& body) {
  Loop* const loop = helpers > 0 ? freeLoop() : nullptr;
  if (!loop) {
    for (size_t chunk = 0; chunk < chunks; ++chunk) body(chunk);
    return {chunks, Clock::now()};
  }
  loop->body = &body;
  loop->used = std::min(static_cast<size_t>(helpers) + 1, loop->parts.size());
  for (size_t p = 0; p < loop->used; ++p) {
    loop->parts[p].next.store(chunks * p / loop->used, std::memory_order_relaxed);
    loop->parts[p].end = chunks * (p + 1) / loop->used;
  }
  loop->places.store(static_cast<uint32_t>(helpers) * kPlace, std::memory_order_release);
  ++m_posted;
  if (m_sleeping > 0) m_posted.notify_one();
  const Own own{run(*loop, 0), Clock::now()};
  loop->places.fetch_and(kTaken);  // who comes now comes too late
  for (Patience patience; loop->places.load(std::memory_order_acquire) != 0;) patience.wait();
  const std::exception_ptr error = std::exchange(loop->error, nullptr);
  loop->taken = false;
  if (error) std::rethrow_exception(error);
  return own;
}

size_t Workers::run(Loop& loop, size_t self) {
  size_t done = 0;
  try {
    for (size_t p = 0; p < loop.used; ++p) {
      Part& part = loop.parts[(self + p) % loop.used];
      for (size_t chunk = part.next++; chunk < part.end; chunk = part.next++, ++done) (*loop.body)(chunk);
    }
  } catch (...) {
    const std::lock_guard lock(loop.mutex);
    if (!loop.error) loop.error = std::current_exception();
    for (size_t p = 0; p < loop.used; ++p) loop.parts[p].next = loop.parts[p].end;
  }
  return done;
}

/// Whether there was a loop with a free place; it has then ended.
bool Workers::help(size_t self) {
  for (Loop& loop : m_loops) {
    uint32_t places = loop.places.load(std::memory_order_acquire);
    while (places >= kPlace) {
      if (!loop.places.compare_exchange_weak(places, places - kPlace + 1, std::memory_order_acq_rel)) continue;
      if (places >= 2 * kPlace && m_sleeping > 0) m_posted.notify_one();
      run(loop, self);
      loop.places.fetch_sub(1, std::memory_order_release);
      return true;
    }
  }
  return false;
}

void Workers::work(size_t self) {
  Patience patience;
  auto last = Clock::now();
  for (;;) {
    const int posted = m_posted;
    if (m_stop) return;  // asked after: who stops raises m_posted behind it, and nobody sleeps through that
    if (help(self)) {
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
