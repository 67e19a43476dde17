// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

// Why not a library: a frame of a thousand particles has some hundred loops of 5 to 100 microseconds, and what stands
// between them runs on one thread. oneTBB, whose arenas hand threads over by way of a common market, took 10 to 30
// microseconds for a loop of no work on 16 threads, more where loops of few and of many threads follow each other;
// these take 3 to 4. They look for work for half a millisecond before they sleep, so that between two loops of a frame
// nobody has to be woken, and what sleeps is woken by others that have just been.
//
// What takes time is a cache line that several threads write, one after the other. So a thread that comes to a loop and
// goes writes on a seat of its own, each part of a loop is counted where only those write who work on it, and all look
// at one line for loops, which changes twice in each.
namespace ps {

/// Threads that help with loops. Several threads may share loops at once, and a chunk may share a loop of its own.
class Workers {
  static constexpr size_t kLoops = 4;  // of the engine's thread, the viewport's, and a few that chunks share

 public:
  explicit Workers(int count);
  ~Workers();  ///< not while a loop runs
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// What one thread has done of a loop, from when until when.
  struct Own {
    size_t chunks = 0;
    std::chrono::steady_clock::time_point begin, end;
  };
  /// Calls body(chunk) once for each chunk below `chunks`, on this thread and on up to `helpers` others; says what this
  /// one has done. Throws the first of what the bodies threw, once all that had begun have ended; those that had not
  /// are then left out.
  Own share(int helpers, size_t chunks, const std::function<void(size_t chunk)>& body);

 private:
  /// Chunks that are one thread's: it has them first, and then helps others with theirs. Loops of few threads and of
  /// many cut what they go through in the same order, and each thread's part lies where it lies in those of all of
  /// them: what a chunk of one loop has read lies in the caches of who takes it in the next one.
  struct alignas(64) Part {
    std::atomic<uint64_t> begun = 0;  ///< the loop that it is of, and the number of chunks that somebody has taken
  };
  struct alignas(64) Seat {
    std::atomic<bool> taken = false;  ///< who sits there may work on the loop
  };
  struct alignas(64) Loop {
    std::atomic<bool> taken = false;
    const std::function<void(size_t)>* body = nullptr;
    size_t chunks = 0;
    size_t used = 0;      ///< parts
    uint64_t number = 0;  ///< of this loop among those that were posted here
    std::vector<Part> parts;
    std::vector<Seat> seats;
    std::mutex mutex;
    std::exception_ptr error;
  };
  struct alignas(64) Helper {
    std::atomic<bool> asleep = false;
    std::array<uint64_t, kLoops> done{};  ///< numbers of the loops where it has been
  };

  Loop* freeLoop();
  static size_t run(Loop& loop, size_t self);  ///< the number of chunks
  static bool take(Loop& loop, size_t part, size_t& chunk);
  size_t seatOf(size_t helper, size_t loop) const;
  size_t seatOfPart(size_t part, size_t parts) const { return part * (m_helpers.size() + 1) / parts; }
  size_t partOf(size_t seat, size_t parts) const;
  bool help(size_t helper);
  bool anyFor(size_t helper) const;
  void wakeTwo();
  void work(size_t helper);

  alignas(64) std::array<std::atomic<uint64_t>, kLoops> m_posted{};  // number and parts of the loops; no parts: closed
  alignas(64) std::atomic<int> m_sleeping = 0;
  std::atomic<bool> m_stop = false;
  std::array<Loop, kLoops> m_loops;
  std::vector<Helper> m_helpers;
  std::vector<std::jthread> m_threads;
};

}  // namespace ps
