// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/neighbours.h"
#include "core/particles/particlestore.h"
#include "core/solver/contact/wallplane.h"
#include "core/solver/fixedshape.h"

#include <array>
#include <span>
#include <vector>

namespace ps {

/// Surfaces of fixed bodies as fluids see them: for each fluid particle the planes that touch what is near of them,
/// found with the neighbour lists, which hold until it has moved a tenth of a spacing. The first one lies at the
/// nearest place and faces the particle; the next at the nearest place that is half a spacing before it, as in a
/// corner. So both sides of a thin wall are met, and edges are round. Errors: half a space is more than there is behind
/// a wall that bends away, as at the rim of a cup, where liquid is held back within a spacing; liquids on both sides of
/// a wall thinner than a spacing see each other. It cannot do: shapes that move, and periodic boxes, where bodies are
/// met as their particles.
class FixedShapes {
 public:
  /// Planes of a particle, at most.
  static constexpr size_t kMost = 3;
  /// Where a surface is met.
  struct Face {
    Plane plane;          ///< towards the place that asked
    double distance = 0;  ///< m, of that place; negative inside of what is closed
    uint32_t body = 0;
  };
  using Faces = std::array<Face, kMost>;
  /// A face for loops over particles.
  struct Near {
    WallPlane plane;
    uint32_t body = 0;
  };

  /// For stages on their own.
  static const FixedShapes& none();

  /// Instead of those before; none stands until refresh().
  void set(std::vector<FixedShape> shapes) {
    m_standing.clear();
    m_stood.clear();
    m_shapes = std::move(shapes);
  }
  void configure(const SolverSettings& settings);
  /// Lists are others than they were, as of another state.
  void forget() { m_stood.clear(); }
  /// Once per frame, when indices may have changed: which shapes stand for their particles.
  void refresh(const ParticleStore& store);
  /// After refresh(), or with new lists: what is near each fluid particle. Without new ones, and where neither shapes
  /// nor who is fluid have changed, that is what it was.
  void refreshLists(const ParticleStore& store, const Neighbours& neighbours, bool newLists);
  bool any() const { return !m_standing.empty(); }
  /// A fixed particle for which its body's surface stands.
  bool isShaped(size_t i) const { return any() && m_shaped[i] != 0; }
  /// What was near particle i when lists were made.
  std::span<const Near> near(uint32_t i) const {
    if (!any() || i >= m_count.size() || m_count[i] == 0) return {};
    return {m_near.data() + m_begin[i], m_count[i]};
  }
  /// Fluid particles, ascending, and m from each of them to the nearest surface, or as far as was looked.
  std::span<const uint32_t> fluids() const { return m_fluids; }
  float clearance(size_t fluid) const { return m_clearance[fluid]; }
  /// What is within `reach` m of a place, nearest first; returns how many.
  size_t facesAt(const Vector3& place, double reach, Faces& faces) const;

 private:
  struct Standing {
    const FixedShape* shape;
    Vector3 low, high;  ///< m, corners of the box around it in the scene
  };
  bool nearest(const Vector3& place, double reach, std::span<const Plane> over, Face& face) const;
  bool isInPlace(const ParticleStore& store, const FixedShape& shape, std::span<const uint32_t> particles) const;
  void findNear(const Vector3& place, size_t fluid, Near* near);

  std::vector<FixedShape> m_shapes;
  std::vector<Standing> m_standing, m_stood;       ///< m_stood: those that m_near is of
  std::vector<uint8_t> m_shaped;                   ///< by particle
  std::vector<std::vector<uint32_t>> m_particles;  ///< by shape: those of its body that are fixed
  double m_spacing = 0, m_reach = 0;               ///< m
  std::vector<uint32_t> m_fluids, m_present, m_begin;
  std::vector<uint8_t> m_count;
  std::vector<float> m_clearance;
  std::vector<Near> m_near;
};

}  // namespace ps
