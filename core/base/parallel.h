// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

// Why one wrapper: results must not depend on the number of threads. Work is cut into chunks of a fixed size, whatever
// the number of threads; a chunk writes only its own elements, and sums are kept per chunk and added in chunk order.
//
// To get another thread's help takes microseconds, which a small loop does not have: a frame of a thousand particles
// has some hundred of them. How many threads a loop gets follows from what it has to do, as it was measured when it ran
// before; the chunks, and with them the bits, stay what they are.
namespace ps {

/// Threads used by parallelFor from now on, in the whole process; 0: one per core. Not while a loop runs.
void setThreadCount(int count);
int threadCount();

/// Calls body(first, last) for consecutive chunks of `grain` elements that cover [0, count), on as many threads as the
/// work is worth: about `microseconds` for one of them; below 0 as long as such chunks usually take.
/// What a body throws reaches the caller, once all running chunks have ended.
void parallelFor(size_t count, size_t grain, const std::function<void(size_t first, size_t last)>& body,
                 double microseconds = -1);

/// What one thread takes for an element of a loop: by the size of its chunks at first, and then as it is seen to.
class LoopCost {
 public:
  constexpr LoopCost() = default;
  explicit LoopCost(double microseconds) : m_each(static_cast<float>(microseconds)) {}
  LoopCost(const LoopCost& other) : m_each(other.m_each.load(std::memory_order_relaxed)) {}
  LoopCost& operator=(const LoopCost& other) {
    m_each.store(other.m_each.load(std::memory_order_relaxed), std::memory_order_relaxed);
    return *this;
  }
  double microseconds(size_t count, size_t grain) const;
  void learn(double microseconds, size_t elements);

 private:
  std::atomic<float> m_each = -1;  ///< microseconds; below 0 as long as nobody has seen it run
};
/// As above; what this thread takes for its share is learned.
void parallelFor(size_t count, size_t grain, const std::function<void(size_t first, size_t last)>& body,
                 LoopCost& cost);

/// Threads, at most threadCount(), that work of so many microseconds on one of them is worth.
int threadsWorth(double microseconds);

/// s that this thread has spent so far in loops of more than one chunk: what several threads may share, however many
/// there are. The rest of a stretch of time is work of one thread.
double secondsShared();

/// Sum over chunks of body(first, last), added in chunk order: the same bits for any number of threads.
double parallelSum(size_t count, size_t grain, const std::function<double(size_t first, size_t last)>& body);

/// Elements of a chunk by what a loop does with each of them: enough that handing a chunk out costs nothing beside it,
/// few enough that threads end together. What is summed chunk by chunk depends on them in its last bits.
namespace grain {
inline constexpr size_t kRays = 64;           ///< follows rays through the scene
inline constexpr size_t kPairs = 128;         ///< sums over a particle's neighbours, vectorised
inline constexpr size_t kNeighbours = 256;    ///< looks at its neighbours one by one, or asks its tables
inline constexpr size_t kParticles = 512;     ///< has to do with the particle alone
inline constexpr size_t kConstraints = 1024;  ///< a constraint, by a plugin's batch
inline constexpr size_t kNumbers = 2048;      ///< a few operations on what lies side by side

/// Microseconds that one thread takes for an element of a loop that has not run yet, by the size of its chunks: rounded
/// from the stages' times per particle on a server of 2024. Chunks of other sizes count as 10 microseconds each.
constexpr double microseconds(size_t grain) {
  switch (grain) {
    case kRays:
      return 2;
    case kPairs:
      return 0.1;
    case kNeighbours:
      return 0.06;
    case kParticles:
      return 0.008;
    case kConstraints:
      return 0.01;
    case kNumbers:
      return 0.001;
    default:
      return 10.0 / static_cast<double>(grain);
  }
}
}  // namespace grain

inline size_t chunkCount(size_t count, size_t grain) { return (count + grain - 1) / grain; }

/// parallelFor without the allocation that a std::function of a large lambda costs: a steady step allocates nothing.
template <class Body>
void forChunks(size_t count, size_t grain, const Body& body, LoopCost& cost) {
  parallelFor(count, grain, std::cref(body), cost);
}
/// Of work that differs from one time to the next: about so much now.
template <class Body>
void forChunks(size_t count, size_t grain, const Body& body, double microseconds) {
  parallelFor(count, grain, std::cref(body), microseconds);
}
/// What it costs is known of each loop in the program: its body is a type of its own.
template <class Body>
void forChunks(size_t count, size_t grain, const Body& body) {
  static LoopCost cost;
  parallelFor(count, grain, std::cref(body), cost);
}

/// Whether body(first, last) is true for any chunk; once one is, others may be left out.
template <class Body>
bool anyChunk(size_t count, size_t grain, const Body& body) {
  std::atomic<bool> any{false};
  forChunks(count, grain, [&](size_t first, size_t last) {
    if (!any.load(std::memory_order_relaxed) && body(first, last)) any.store(true, std::memory_order_relaxed);
  });
  return any;
}

/// The indices below `count` for which wanted(i) is true, ascending, into memory that is used again. It is asked twice.
template <class Wanted>
void findIndices(size_t count, std::vector<uint32_t>& found, const Wanted& wanted) {
  static thread_local std::vector<uint32_t> counts;
  std::vector<uint32_t>& ends = counts;  // this thread's, whoever helps it
  ends.assign(chunkCount(count, grain::kNumbers), 0);
  forChunks(count, grain::kNumbers, [&](size_t first, size_t last) {
    uint32_t n = 0;
    for (size_t i = first; i < last; ++i) n += wanted(i) ? 1u : 0u;
    ends[first / grain::kNumbers] = n;
  });
  uint32_t total = 0;
  for (uint32_t& n : ends) total = n += total;
  found.resize(total);
  forChunks(count, grain::kNumbers, [&](size_t first, size_t last) {
    const size_t chunk = first / grain::kNumbers;
    uint32_t next = chunk > 0 ? ends[chunk - 1] : 0;
    for (size_t i = first; i < last; ++i) {
      if (wanted(i)) found[next++] = static_cast<uint32_t>(i);
    }
  });
}

}  // namespace ps
