// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/halfspace.h"
#include "core/particles/reactions.h"
#include "core/solver/contact/fixedshapes.h"
#include "core/solver/contact/nearwalls.h"

#include <vector>

namespace ps {

/// What walls, and the surfaces of fixed bodies, add to density sums: half a space behind each, or what is behind a
/// curved wall (HalfSpaceTable). Few particles are near one: which walls each may feel is found with the lists.
class HalfSpaces {
 public:
  void configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                 const FixedShapes& shapes = FixedShapes::none());
  /// After new lists, with the places that they were made for. Iterations move a particle by less than a spacing.
  void refresh(std::span<const api::Float4> built);
  const std::vector<WallSurface>& walls() const { return m_walls; }
  bool any() const { return !m_walls.empty() || m_shapes->any(); }
  /// Whose a plane is: of a wall, by index, or of a fixed body.
  struct Owner {
    bool isBody;
    size_t index;
    int slotIn(const Reactions& reactions) const {
      return isBody ? reactions.ofBody(static_cast<uint32_t>(index)) : reactions.ofWall(index);
    }
  };

  struct Sum {
    float excess = 0, x = 0, y = 0, z = 0;  ///< share of the kernel, and its gradient in 1/m
  };
  /// Of particle i at a place.
  Sum of(uint32_t i, const api::Float4& at) const {
    Sum sum;
    forNear(i, at,
            [&](const WallPlane& p, const Owner& owner, float distance) { add(sum, p, tableOf(owner).at(distance)); });
    return sum;
  }
  /// The part of the surfaces of fixed bodies in it.
  /// For the particles which[first .. last), by place in `which`, into a list that has room; nullptr where none of them
  /// is near such a surface.
  const Sum* sumShapes(const api::Float4* points, const uint32_t* which, size_t first, size_t last,
                       std::vector<Sum>& sums) const;
  /// The walls that any of these particles may feel.
  WallSet nearAny(const uint32_t* which, size_t count) const {
    WallSet met;
    for (size_t k = 0; k < count; ++k) met.add(m_near[which[k]]);
    return met;
  }
  /// What a wall adds, by its index.
  const HalfSpaceTable& tableOf(size_t wall) const {
    return m_tables.empty() || m_bends[wall].radius == 0 ? m_table : m_tables[wall];
  }
  float perMetre() const { return m_table.perMetre(); }  ///< of all tables
  float support() const { return m_support; }            ///< m
  float nearest() const { return m_nearest; }            ///< m: a wall counts as no nearer than this
  /// What walls add to CompressionSums.
  struct Compression {
    float excess = 0;
    double byVolumes = 0;
  };
  Compression compressionOf(uint32_t i, const api::Float4& at) const {
    Compression sum;
    forNear(i, at, [&](const WallPlane&, const Owner& owner, float distance) {
      const HalfSpaceTable::Value value = tableOf(owner).at(distance);
      sum.excess += value.share;
      sum.byVolumes += double{value.share} - double{distance} * value.slope / 3;
    });
    return sum;
  }
  /// visit(plane, owner, slope in 1/m) for each that it feels.
  template <class Visit>
  void forSlopes(uint32_t i, const api::Float4& at, Visit&& visit) const {
    forNear(i, at, [&](const WallPlane& p, const Owner& owner, float distance) {
      visit(p, owner, tableOf(owner).at(distance).slope);
    });
  }

 private:
  /// visit(plane, owner, m to its face, at least half a spacing) for those within the support.
  template <class Visit>
  void forNear(uint32_t i, const api::Float4& at, Visit&& visit) const {
    m_near[i].forEach(m_walls.size(), [&](size_t wall) {
      const float distance = m_walls[wall].heightOf(at);
      if (distance < m_support) visit(m_walls[wall].at(at), Owner{false, wall}, std::max(m_nearest, distance));
    });
    forNearShapes(i, at, visit);
  }
  template <class Visit>
  void forNearShapes(uint32_t i, const api::Float4& at, Visit&& visit) const {
    for (const FixedShapes::Near& face : m_shapes->near(i)) {
      const float distance = face.plane.heightOf(at);
      if (distance < m_support) visit(face.plane, Owner{true, face.body}, std::max(m_nearest, distance));
    }
  }
  const HalfSpaceTable& tableOf(const Owner& owner) const { return owner.isBody ? m_table : tableOf(owner.index); }
  static void add(Sum& sum, const WallPlane& p, const HalfSpaceTable::Value& value) {
    sum.excess += value.share;
    sum.x += p.x * value.slope;
    sum.y += p.y * value.slope;
    sum.z += p.z * value.slope;
  }

  std::vector<WallSurface> m_walls;
  const FixedShapes* m_shapes = nullptr;
  HalfSpaceTable m_table;                ///< of planes
  std::vector<Bend> m_bends;             ///< by wall
  std::vector<HalfSpaceTable> m_tables;  ///< by wall, those of curved ones; none where none is
  KernelShape m_kernel = KernelShape::CubicSpline;
  float m_support = 0, m_nearest = 0, m_reach = 0;  ///< m
  std::vector<WallSet> m_near;                      ///< by particle
};

}  // namespace ps
