// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/kernels.h"

#include <phasesketch/types.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ps {

/// Share of the kernel that lies beyond a plane at a distance d, and its slope: how a wall counts in a density sum
/// without particles of its own.
class HalfSpaceTable {
 public:
  HalfSpaceTable() = default;
  explicit HalfSpaceTable(const Kernel& kernel);
  static constexpr size_t kIntervals = 256;
  struct Value {
    float share, slope;  ///< 1, 1/m
  };
  /// `distance` in m, negative ones count as 0.
  Value at(float distance) const {
    const float s = std::max(0.0f, distance) * m_perMetre;
    if (!(s < kIntervals)) return {0, 0};
    const size_t k = static_cast<size_t>(s);
    const float f = s - static_cast<float>(k);
    const api::Float4& a = m_entries[k];
    return {a.x + f * a.z, a.y + f * a.w};
  }
  float perMetre() const { return m_perMetre; }  ///< intervals of a metre
  /// Of each interval: share and slope at its begin, and by how much both grow to its end.
  const api::Float4* entries() const { return m_entries.data(); }

 private:
  std::vector<api::Float4> m_entries;
  float m_perMetre = 0;
};

}  // namespace ps
