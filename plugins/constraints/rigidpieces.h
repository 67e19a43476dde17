// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "rotation.h"

#include <phasesketch/plugin.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

namespace ps::constraint {

/// Sets that have been united step by step; find() gives the least element of a set.
class DisjointSets {
 public:
  explicit DisjointSets(size_t count);
  size_t find(size_t k);
  void unite(size_t a, size_t b);
  /// Members of each set, ascending, in order of the least.
  std::vector<std::vector<size_t>> sets();

 private:
  std::vector<size_t> m_parent;
};

/// The same, united by any number of threads at once (Anderson and Woll 1991, "Wait-free parallel algorithms for the
/// union-find problem"): each element knows a lower one of its set, and the least itself, whoever came first.
class SharedSets {
 public:
  SharedSets(size_t count, const api::Threads* threads);
  uint32_t find(uint32_t k);
  void unite(uint32_t a, uint32_t b);
  /// Members of each set, ascending, in order of the least: when all have been united.
  std::vector<std::vector<size_t>> sets();

 private:
  std::atomic_ref<uint32_t> parent(uint32_t k) { return std::atomic_ref(m_parent[k]); }
  const api::Threads* m_threads;
  std::vector<uint32_t> m_parent;
};

/// Points that hang together by steps shorter than `radius`, but for those of pairs that are parted.
std::vector<std::vector<size_t>> piecesOf(const std::vector<Vector>& points, double radius,
                                          const std::function<bool(size_t, size_t)>& parted = {},
                                          const api::Threads* threads = nullptr);

}  // namespace ps::constraint
