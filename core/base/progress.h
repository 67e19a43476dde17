// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>

// Why a thread knows what it works on: a scene is made by the lattice, the store, the neighbour lists and plugins that
// call back, all of which also work for a running scene, where nobody watches. What they do is told where it is done.
namespace ps {

/// Work that somebody has cancelled. No Error: nothing went wrong, and nobody on the way is to report it.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "it was cancelled"; }
};

/// How far long work has come, and whether it is to go on. Made for one piece of work; all functions may be called from
/// any thread.
class Progress {
 public:
  virtual ~Progress() = default;

  /// What all stages weigh together.
  void expect(double weight) { m_whole = weight; }
  /// A stage of `weight` that takes `steps`; the one before it is over.
  void begin(const char* stage, double weight, double steps);
  /// So many steps of the stage have been done. Throws Cancelled.
  void advance(size_t steps);
  /// From now on advance() throws.
  void cancel() { m_cancelled = true; }
  bool cancelled() const { return m_cancelled; }

  struct State {
    const char* stage = nullptr;  ///< "Tying structure"; nullptr before the first
    double done = 0;              ///< 0..1, of all stages
  };
  State state() const;

 protected:
  /// Each advance(), for who counts.
  virtual void advanced(size_t /*steps*/) {}

 private:
  std::atomic<const char*> m_stage{nullptr};
  std::atomic<double> m_whole{0}, m_before{0}, m_weight{0}, m_steps{0};
  std::atomic<size_t> m_done{0};
  std::atomic<bool> m_cancelled{false};
};

/// What this thread works on; nullptr: nobody watches.
inline thread_local Progress* t_progress = nullptr;

/// Says so for as long as it lives.
class ProgressScope {
 public:
  explicit ProgressScope(Progress* progress) noexcept : m_before(t_progress) { t_progress = progress; }
  ~ProgressScope() { t_progress = m_before; }
  ProgressScope(const ProgressScope&) = delete;
  ProgressScope& operator=(const ProgressScope&) = delete;

 private:
  Progress* m_before;
};

inline void beginStage(const char* stage, double weight, double steps) {
  if (t_progress) t_progress->begin(stage, weight, steps);
}
/// Throws Cancelled.
inline void advance(size_t steps) {
  if (t_progress) t_progress->advance(steps);
}

/// Elements of a loop between two questions whether to go on: some milliseconds of work.
inline constexpr size_t kProgressSlice = size_t{1} << 14;

/// body(first, last) for [first, last) in slices, after each of which the thread's progress advances.
template <class Body>
void inSlices(size_t first, size_t last, const Body& body) {
  while (first < last) {
    const size_t end = std::min(last, first + kProgressSlice);
    body(first, end);
    advance(end - first);
    first = end;
  }
}

}  // namespace ps
