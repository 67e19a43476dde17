// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/kernels.h"

#include <phasesketch/types.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ps {

/// How a wall's face bends: 1/m of mean curvature where matter touches it is `share` over `radius`.
struct Bend {
  double radius = 0;  ///< m, above 0 with matter inside, below 0 outside; 0: a plane
  double share = 1;   ///< 1 of a sphere, 1/2 of a cylinder
  bool operator==(const Bend&) const = default;
};

/// Share of the kernel that lies beyond a wall at a distance d, and its slope: how a wall counts in a density sum
/// without particles of its own. Beyond a plane that is S(d) = int_d^R A dz, A(z) = 2 pi int_z^R r W dr what lies over
/// a plane at z; beyond a sphere about a centre D away exactly int_d^R (1 + z/D) A dz, since the sphere through z has
/// that much more of it; beyond a cylinder to first order in R/D, with half of what bends a sphere. Of spheres and
/// cylinders wider than the kernel reaches.
class HalfSpaceTable {
 public:
  HalfSpaceTable() = default;
  explicit HalfSpaceTable(const Kernel& kernel, const Bend& bend = {});
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
