// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"
#include "core/particles/neighbours.h"

#include <algorithm>
#include <span>
#include <vector>

namespace ps {

/// The unknowns of the implicit viscosity, in groups that do not act on each other, and the rigid motion of each group
/// that no boundary touches: taken from a change of velocity, it leaves one that keeps linear and angular momentum. In
/// a periodic box, where a group has no centre and angular momentum is nothing that stays, only the linear one counts.
/// Rows are cut into segments of a fixed size within a group; sums are kept per segment and added in order.
class ViscousGroups {
 public:
  enum class Role : uint8_t { None, Viscous, Free, Fixed };
  struct Segment {
    uint32_t group, first, last;  ///< of rows()
  };

  /// Unknowns are the viscous particles and the free ones in their lists; pairs without a viscous one do not count.
  void find(std::span<const Role> roles, const api::NeighbourView& view);
  std::span<const uint32_t> rows() const { return m_rows; }
  std::span<const Segment> segments() const { return m_segments; }
  /// Some group is held by a boundary, as measure() found.
  bool anyHeld() const {
    return std::any_of(m_groups.begin(), m_groups.end(), [](const Group& g) { return !g.closed; });
  }

  /// Mass, centre and inertia of each group without a fixed particle in its lists and a segment in `touched`.
  void measure(const ParticleStore& store, std::span<const uint8_t> touched, double spacing);
  /// Momenta of vectors (m/s, by row); the segment's share, and after all segments the rigid motion that has them.
  void addMomenta(const ParticleStore& store, const api::Float4* vectors, size_t segment);
  void reduceMomenta();
  /// A row's vector without that motion.
  api::Float4 without(const ParticleStore& store, uint32_t group, uint32_t i, const api::Float4& v) const;

 private:
  struct Group {
    uint32_t firstSegment = 0, lastSegment = 0;
    bool anchored = false;  ///< lists hold fixed particles
    bool closed = false;
    double mass = 0;                  ///< kg
    Vector3 center, linear, angular;  ///< m, m/s, 1/s
    Matrix3 inverseInertia;           ///< 1/(kg m2)
  };
  /// Of a segment: mass with its first and second moments, or momenta, linear and angular.
  struct Sums {
    double mass = 0;
    Vector3 first, angular;
    Matrix3 second;
  };
  void flood(uint32_t seed, std::span<const Role> roles, const api::NeighbourView& view, bool& anchored);
  void measureInertia(Group& group, double spacing, bool turns) const;

  std::vector<uint32_t> m_rows, m_stack;
  std::vector<uint8_t> m_found;
  std::vector<Group> m_groups;
  std::vector<Segment> m_segments;
  std::vector<Sums> m_sums;  ///< by segment
};

}  // namespace ps
