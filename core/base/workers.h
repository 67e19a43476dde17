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
// these take 3 to 7. They look for work for half a millisecond before they sleep, so that between two loops of a frame
// nobody has to be woken, and what sleeps is woken by others that have just been.
namespace ps {

/// Threads that help with loops. Several threads may share loops at once, and a chunk may share a loop of its own.
class Workers {
 public:
  explicit Workers(int count);
  ~Workers();  ///< not while a loop runs
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// What one thread has done of a loop, and until when.
  struct Own {
    size_t chunks = 0;
    std::chrono::steady_clock::time_point end;
  };
  /// Calls body(chunk) once for each chunk below `chunks`, on this thread and on up to `helpers` others; says what this
  /// one has done. Throws the first of what the bodies threw, once all that had begun have ended; those that had not
  /// are then left out.
  Own share(int helpers, size_t chunks, const std::function<void(size_t chunk)>& body);

 private:
  /// Chunks that are one thread's: it has them first, and then helps others with theirs. What a chunk of one loop has
  /// read lies in the caches of who takes it in the next one.
  struct alignas(64) Part {
    std::atomic<size_t> next = 0;  ///< chunk
    size_t end = 0;
  };
  /// A loop that is shared. Helpers take a place, and leave it when no chunk is left.
  struct alignas(64) Loop {
    std::atomic<bool> taken = false;
    const std::function<void(size_t)>* body = nullptr;
    std::vector<Part> parts;  ///< for as many threads as there are
    size_t used = 0;          ///< of them
    std::mutex mutex;
    std::exception_ptr error;
    alignas(64) std::atomic<uint32_t> places = 0;  ///< free ones in the upper half, taken ones in the lower
  };

  Loop* freeLoop();
  static size_t run(Loop& loop, size_t self);  ///< the number of chunks
  bool help(size_t self);
  void work(size_t self);

  std::array<Loop, 4> m_loops;  // of the engine's thread, the viewport's, and a few that chunks share
  std::atomic<bool> m_stop = false;
  alignas(64) std::atomic<int> m_posted = 0;  // loops so far, wraps around
  alignas(64) std::atomic<int> m_sleeping = 0;
  std::vector<std::jthread> m_threads;
};

}  // namespace ps
