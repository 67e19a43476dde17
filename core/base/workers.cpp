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

/// A loop's number with how many parts it has: what is posted.
constexpr int kPartBits = 16;
constexpr uint64_t posted(uint64_t number, size_t parts) { return number << kPartBits | parts; }
constexpr uint64_t numberOf(uint64_t posted) { return posted >> kPartBits; }
constexpr size_t partsOf(uint64_t posted) { return posted & ((1u << kPartBits) - 1); }

/// A loop's number with how many chunks of a part are taken. Before a number comes again, all parts have been begun by
/// many others: at one place 2^40 loops take months.
constexpr int kChunkBits = 24;
constexpr uint64_t kChunkMask = (1u << kChunkBits) - 1, kNumbers = uint64_t{1} << 40;
constexpr size_t kMostChunks = kChunkMask / 2;
constexpr uint64_t begun(uint64_t number, size_t chunks) { return number << kChunkBits | chunks; }

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

Workers::Workers(int count) : m_helpers(static_cast<size_t>(std::max(count, 0))) {
  for (Loop& loop : m_loops) {
    loop.parts = std::vector<Part>(m_helpers.size() + 1);
    loop.seats = std::vector<Seat>(m_helpers.size() + 1);
  }
  try {
    for (size_t helper = 0; helper < m_helpers.size(); ++helper)
      m_threads.emplace_back([this, helper] { work(helper); });
  } catch (const std::system_error&) {  // no more threads are to be had: those that are there do
  }
}

Workers::~Workers() {
  m_stop = true;
  for (Helper& helper : m_helpers) {
    helper.asleep = false;
    helper.asleep.notify_one();
  }
}

Workers::Loop* Workers::freeLoop() {
  for (Loop& loop : m_loops) {
    if (!loop.taken.load(std::memory_order_relaxed) && !loop.taken.exchange(true)) return &loop;
  }
  return nullptr;
}

Workers::Own Workers::share(int helpers, size_t chunks, const std::function<void(size_t)>& body) {
  Loop* const loop = helpers > 0 && chunks < kMostChunks ? freeLoop() : nullptr;
  if (!loop) {
    const auto begin = Clock::now();
    for (size_t chunk = 0; chunk < chunks; ++chunk) body(chunk);
    return {chunks, begin, Clock::now()};
  }
  std::atomic<uint64_t>& post = m_posted[static_cast<size_t>(loop - m_loops.data())];
  loop->body = &body;
  loop->chunks = chunks;
  loop->used = std::min(static_cast<size_t>(helpers) + 1, loop->parts.size());
  loop->number = (loop->number + 1) % kNumbers;
  post = posted(loop->number, loop->used);
  if (m_sleeping > 0) wakeTwo();
  Own own;
  own.begin = Clock::now();
  own.chunks = run(*loop, 0);
  own.end = Clock::now();
  // Who sits down from now on sees that it is too late: either post or seat is seen by the other one, as each writes
  // its own before it reads the other's.
  post = posted(loop->number, 0);
  for (size_t p = 1; p < loop->used; ++p)
    for (Patience patience; loop->seats[seatOfPart(p, loop->used)].taken;) patience.wait();
  const std::exception_ptr error = std::exchange(loop->error, nullptr);
  loop->taken = false;
  if (error) std::rethrow_exception(error);
  return own;
}

size_t Workers::run(Loop& loop, size_t self) {
  size_t done = 0;
  try {
    for (size_t p = 0; p < loop.used; ++p) {
      for (size_t chunk = 0; take(loop, (self + p) % loop.used, chunk); ++done) (*loop.body)(chunk);
    }
  } catch (...) {
    const std::lock_guard lock(loop.mutex);
    if (!loop.error) loop.error = std::current_exception();
    for (size_t p = 0; p < loop.used; ++p) loop.parts[p].begun = begun(loop.number, kMostChunks);
  }
  return done;
}

/// The next chunk of a part. Whoever is the first of a loop begins the count anew, so that nobody has to touch all
/// parts before; nobody adds to one where nothing is left, as that would take it from who looks at it.
bool Workers::take(Loop& loop, size_t part, size_t& chunk) {
  std::atomic<uint64_t>& counted = loop.parts[part].begun;
  const size_t first = loop.chunks * part / loop.used, count = loop.chunks * (part + 1) / loop.used - first;
  if (count == 0) return false;
  uint64_t seen = counted.load(std::memory_order_relaxed);
  chunk = first;
  if (seen >> kChunkBits != loop.number &&
      counted.compare_exchange_strong(seen, begun(loop.number, 1), std::memory_order_relaxed))
    return true;
  if ((seen & kChunkMask) >= count) return false;
  const size_t taken = counted.fetch_add(1, std::memory_order_relaxed) & kChunkMask;
  chunk += taken;
  return taken < count;
}

/// Each place for a loop has its helpers in another order, so that two small ones have different ones.
size_t Workers::seatOf(size_t helper, size_t loop) const {
  const size_t count = m_helpers.size();
  return (helper + loop * (count / kLoops)) % count + 1;
}

/// The part of who sits there; 0, which is the caller's own: none.
size_t Workers::partOf(size_t seat, size_t parts) const {
  const size_t threads = m_helpers.size() + 1, part = (seat * parts + threads - 1) / threads;
  return part < parts && seatOfPart(part, parts) == seat ? part : 0;
}

bool Workers::anyFor(size_t helper) const {
  for (size_t l = 0; l < kLoops; ++l) {
    const size_t parts = partsOf(m_posted[l]);
    if (parts > 0 && partOf(seatOf(helper, l), parts) > 0) return true;
  }
  return false;
}

/// Whether there was a loop with a part for this one; it has then ended, or nothing is left of it to begin.
bool Workers::help(size_t helper) {
  for (size_t l = 0; l < kLoops; ++l) {
    const uint64_t now = m_posted[l].load(std::memory_order_acquire);
    uint64_t& done = m_helpers[helper].done[l];
    if (partsOf(now) == 0 || done == numberOf(now)) continue;
    const size_t seat = seatOf(helper, l), part = partOf(seat, partsOf(now));
    done = numberOf(now);
    if (part == 0) continue;
    std::atomic<bool>& taken = m_loops[l].seats[seat].taken;
    taken = true;
    if (m_posted[l] == now) run(m_loops[l], part);
    taken.store(false, std::memory_order_release);
    return true;
  }
  return false;
}

/// Of those that sleep though there is work for them. Who is woken wakes the next ones.
void Workers::wakeTwo() {
  int woken = 0;
  for (size_t helper = 0; helper < m_helpers.size() && woken < 2; ++helper) {
    std::atomic<bool>& asleep = m_helpers[helper].asleep;
    if (!asleep.load(std::memory_order_relaxed) || !anyFor(helper) || !asleep.exchange(false)) continue;
    asleep.notify_one();
    ++woken;
  }
}

void Workers::work(size_t helper) {
  Patience patience;
  auto last = Clock::now();
  std::atomic<bool>& asleep = m_helpers[helper].asleep;
  while (!m_stop) {
    if (help(helper)) {
      patience = {};
      last = Clock::now();
    } else if (Clock::now() - last < kAwake) {
      patience.wait();
    } else {
      asleep = true;
      ++m_sleeping;
      // Looked at after: who posts a loop looks for sleepers behind it, and who stops wakes all behind that.
      if (!m_stop && !anyFor(helper)) asleep.wait(true);
      --m_sleeping;
      asleep = false;
      if (m_sleeping > 0) wakeTwo();
      patience = {};
      last = Clock::now();
    }
  }
}

}  // namespace ps
