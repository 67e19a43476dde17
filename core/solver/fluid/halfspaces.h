// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/halfspace.h"
#include "core/solver/contact/nearwalls.h"

#include <vector>

namespace ps {

/// What walls add to density sums. Few particles are near one: which walls each may feel is found with the lists.
class HalfSpaces {
 public:
  void configure(const SolverSettings& settings, const std::vector<Wall>& walls);
  /// After new lists, with the places that they were made for. Iterations move a particle by less than a spacing.
  void refresh(std::span<const api::Float4> built);
  const std::vector<WallPlane>& planes() const { return m_planes; }

  struct Sum {
    float excess = 0, x = 0, y = 0, z = 0;  ///< share of the kernel, and its gradient in 1/m
  };
  /// Of particle i at a place.
  Sum of(uint32_t i, const api::Float4& at) const {
    Sum sum;
    forNear(i, at, [&](size_t wall, float distance) {
      const WallPlane& p = m_planes[wall];
      const HalfSpaceTable::Value value = m_table.at(distance);
      sum.excess += value.share;
      sum.x += p.x * value.slope;
      sum.y += p.y * value.slope;
      sum.z += p.z * value.slope;
    });
    return sum;
  }
  /// The walls that any of these particles may feel.
  WallSet nearAny(const uint32_t* which, size_t count) const {
    WallSet met;
    for (size_t k = 0; k < count; ++k) met.add(m_near[which[k]]);
    return met;
  }
  const HalfSpaceTable& table() const { return m_table; }
  float support() const { return m_support; }  ///< m
  float nearest() const { return m_nearest; }  ///< m: a wall counts as no nearer than this
  /// What walls add to CompressionSums.
  struct Compression {
    float excess = 0;
    double byVolumes = 0;
  };
  Compression compressionOf(uint32_t i, const api::Float4& at) const {
    Compression sum;
    forNear(i, at, [&](size_t, float distance) {
      const HalfSpaceTable::Value value = m_table.at(distance);
      sum.excess += value.share;
      sum.byVolumes += double{value.share} - double{distance} * value.slope / 3;
    });
    return sum;
  }
  /// visit(wall, slope in 1/m) for each wall that it feels.
  template <class Visit>
  void forSlopes(uint32_t i, const api::Float4& at, Visit&& visit) const {
    forNear(i, at, [&](size_t wall, float distance) { visit(wall, m_table.at(distance).slope); });
  }

 private:
  /// visit(wall, m to its face, at least half a spacing) for those within the support.
  template <class Visit>
  void forNear(uint32_t i, const api::Float4& at, Visit&& visit) const {
    m_near[i].forEach(m_planes.size(), [&](size_t wall) {
      const float distance = m_planes[wall].heightOf(at);
      if (distance < m_support) visit(wall, std::max(m_nearest, distance));
    });
  }

  std::vector<WallPlane> m_planes;
  HalfSpaceTable m_table;
  KernelShape m_kernel = KernelShape::CubicSpline;
  float m_support = 0, m_nearest = 0, m_reach = 0;  ///< m
  std::vector<WallSet> m_near;                      ///< by particle
};

}  // namespace ps
