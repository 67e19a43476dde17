// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "rotation.h"

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

/// Points that hang together by steps shorter than `radius`, but for those of pairs that are parted.
std::vector<std::vector<size_t>> piecesOf(const std::vector<Vector>& points, double radius,
                                          const std::function<bool(size_t, size_t)>& parted = {});

}  // namespace ps::constraint
