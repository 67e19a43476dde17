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
/// a wall thinner than a spacing see each other. A shape that is led to other places goes where three of its particles
/// go, as long as all of them keep their places in it; what is near of it is then found in every substep. It cannot do:
/// periodic boxes, and moving bodies whose particles lie in a line; these are met as their particles.
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
  /// Which of the shapes are meant: all, those that do not move in this frame, or one of movers().
  static constexpr int kAll = -1, kStill = -2;

  /// For stages on their own.
  static const FixedShapes& none();

  /// Instead of those before; none stands until refresh().
  void set(std::vector<FixedShape> shapes) {
    m_standing.clear();
    m_stood.clear();
    m_movers.clear();
    m_shapes = std::move(shapes);
  }
  void configure(const SolverSettings& settings);
  /// Lists are others than they were, as of another state.
  void forget() { m_stood.clear(); }
  /// Once per frame, when indices may have changed: which shapes stand for their particles. `led`: some fixed particles
  /// will be set in motion in it.
  void refresh(const ParticleStore& store, bool led);
  /// After refresh(), or with new lists: what is near each fluid particle. Without new ones, and where neither shapes
  /// nor who is fluid have changed, that is what it was.
  void refreshLists(const ParticleStore& store, const Neighbours& neighbours, bool newLists);
  /// When positions have been predicted: shapes go where their particles went in this substep.
  void advance(const ParticleStore& store);
  /// After advance(), when fluids have got out of the way: what is near of those that moved, of fluids where they are.
  void follow(const ParticleStore& store, const Neighbours& neighbours);
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
  /// Where what is near of it was found.
  const Vector3& noted(size_t fluid) const { return m_noted[fluid]; }
  /// m that shapes have gone, at most, since its clearance was noted; of a fluid whose clearance says nothing of those
  /// that move, endless where a way between two places comes within `reach` m of the box of one.
  double drift(size_t fluid, const Vector3& from, const Vector3& to, double reach) const;
  /// Shapes that move in this frame.
  bool moves() const { return !m_movers.empty(); }
  std::span<const uint32_t> movers() const { return m_movers; }
  /// Whether the box around a way comes within `reach` m of that around a mover, as it was and is.
  bool isBeside(uint32_t mover, const Vector3& from, const Vector3& to, double reach) const;
  /// Where a place would be, had a mover carried it through this substep.
  Vector3 carried(uint32_t mover, const Vector3& place) const;
  /// m that what is at a place of a body's surface went in this substep.
  Vector3 wayOf(uint32_t body, const Vector3& place) const;
  /// What is within `reach` m of a place, nearest first; returns how many.
  size_t facesAt(const Vector3& place, double reach, Faces& faces, int which = kAll) const;

 private:
  /// Particles of a shape that tell where it is: not in a line.
  using Marks = std::array<uint32_t, 3>;
  struct Standing {
    const FixedShape* shape = nullptr;
    RigidMove pose, before;  ///< now, and when the substep began
    Marks marks{};           ///< of one that may move
    bool mayMove = false, moves = false;
    Vector3 low, high;              ///< m, corners of the box around it in the scene
    Vector3 lowBefore, highBefore;  ///< m, when the substep began
  };
  static void setBox(Standing& standing);
  bool nearest(const Vector3& place, double reach, std::span<const Plane> over, int which, Face& face) const;
  bool isMeant(const Standing& standing, int which) const;
  bool isMarked(const ParticleStore& store, const FixedShape& shape, std::span<const uint32_t> particles) const;
  bool fits(const ParticleStore& store, const RigidMove& pose, std::span<const uint32_t> particles) const;
  bool findMarks(const ParticleStore& store, std::span<const uint32_t> particles, Marks& marks) const;
  template <class PlaceOf>
  static RigidMove poseOf(const ParticleStore& store, const Marks& marks, const PlaceOf& placeOf);
  bool findPose(const ParticleStore& store, std::span<const uint32_t> particles, bool led, Standing& standing) const;
  void findMovers();
  void noteAll(const ParticleStore& store, const Neighbours& neighbours);
  void note(const ParticleStore& store, const Neighbours& neighbours, size_t fluid);

  std::vector<FixedShape> m_shapes;
  std::vector<Standing> m_standing, m_stood;       ///< m_stood: those that m_near is of
  std::vector<uint8_t> m_shaped;                   ///< by particle
  std::vector<std::vector<uint32_t>> m_particles;  ///< by shape: those of its body that are fixed
  double m_spacing = 0, m_reach = 0;               ///< m
  double m_step = 0;                               ///< s, a substep
  std::vector<uint32_t> m_fluids, m_present, m_begin;
  std::vector<uint8_t> m_count;
  std::vector<float> m_clearance;
  std::vector<Vector3> m_noted;   ///< m, by place among the fluids
  std::vector<uint8_t> m_beside;  ///< likewise: 1 where a mover was near, and lists say nothing of where that was
  std::vector<Near> m_near;
  std::vector<uint32_t> m_movers;             ///< places in m_standing
  double m_drift = 0;                         ///< m
  bool m_isNoted = false, m_started = false;  ///< in this substep; since the last noteAll()
};

}  // namespace ps
