// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/cellgrid.h"
#include "core/particles/impulse.h"
#include "core/particles/neighbours.h"
#include "core/particles/reactions.h"
#include "core/solver/contact/fixedshapes.h"
#include "core/solver/contact/solidcontact.h"
#include "core/solver/contact/walls.h"
#include "core/solver/structure/constraintsystem.h"

#include <algorithm>
#include <array>

namespace ps {

/// The last word on positions: nothing passes a layer of static particles, however fast it or the layer is. Each moving
/// particle is swept from its old to its final position against spheres of 0.75 spacings around static ones, exactly (a
/// quadratic, in the frame of the static one, which may have a velocity), and slides on along what it meets. The
/// largest opening of a lattice layer leaves 0.71 spacings, so 0.75 closes it, and resting contact (about one spacing)
/// is left alone. What is soft meets the faces of lattices that move as planes at that height: their spheres, passing
/// below it, would carry it along without friction. Single solids that come from outside stop where contact holds them,
/// at kContactDiameter. Moving solids are not obstacles here: see Impacts, SolidContact and RigidContact.
class SweptClamp {
 public:
  /// Fluids meet the surfaces of `shapes`, see ShapeContact, in place of the particles that these stand for.
  void configure(const SolverSettings& settings, const FixedShapes& shapes);
  /// Once per frame: finds the static particles; `led`: some of them will be set in motion in it.
  void refresh(const ParticleStore& store, bool led);
  /// After new lists: how far the static ones in each particle's list are.
  void refreshLists(const ParticleStore& store, const Neighbours& neighbours);
  /// Members of rigid bodies (1 in `rigid`) are not moved: see held(). What a constraint ties may come nearer to what
  /// it is tied to than contact allows.
  void apply(ParticleStore& store, const Neighbours& neighbours, const WallStage& walls, const SolidContact& contact,
             const StructureGraph& graph, std::span<const uint8_t> rigid);
  /// For members of rigid bodies, by particle, the way back (m) by which each would have to be moved; empty when there
  /// is nothing static.
  std::span<const api::Float4> held() const { return m_held; }
  /// Body of the static particle that it met last, by particle.
  std::span<const uint32_t> heldBy() const { return m_heldBy; }
  /// What apply() moved, kg m.
  ExternalImpulse& externalImpulse() { return m_externalImpulse; }
  /// Where walls and fixed particles are told what they get.
  void tell(Reactions& reactions) { m_reactions = &reactions; }

 private:
  struct Obstacle {
    Vector3 center, way;  ///< m: when the substep begins, and during it
    uint32_t body = 0;
    Vector3 face{};         ///< its lattice's normal there, or zero
    bool twoSided = false;  ///< the other side is as good
    bool shaped = false;    ///< nothing that a fluid meets
  };
  struct Hit {
    double time = 2;  ///< of the part, 0..1
    Vector3 center;   ///< then
    Vector3 way;      ///< of the obstacle in the whole substep
    uint32_t body = 0;
    Vector3 face{};  ///< along which it is met, or zero: along the line of centres
  };
  /// A part of a particle's way in a substep.
  struct Sweep {
    Vector3 from, way;
    double begin = 0, span = 1;  ///< shares of the substep: passed before, and taken by this part
    bool single = false;         ///< a solid that nothing ties
    bool soft = false;           ///< a solid that is tied, but not as a rigid body
    bool fluid = false;
  };
  /// Of all obstacles together, in a substep.
  struct Reach {
    std::array<float, 3> low{-1e30f, -1e30f, -1e30f}, high{1e30f, 1e30f, 1e30f};  ///< m
    bool misses(const api::Float4& from, const api::Float4& to) const {
      return std::max(from.x, to.x) < low[0] || std::min(from.x, to.x) > high[0] || std::max(from.y, to.y) < low[1] ||
             std::min(from.y, to.y) > high[1] || std::max(from.z, to.z) < low[2] || std::min(from.z, to.z) > high[2];
    }
  };
  void sortIntoCells();
  void measureReach(const ParticleStore& store, const Neighbours& neighbours);
  Reach reachOfAll() const;
  bool maySkip(const ParticleStore& store, const Neighbours& neighbours, size_t i, bool single) const;
  Hit firstHit(const Sweep& sweep) const;
  void imagesHit(const Sweep& sweep, Hit& hit) const;
  void firstHit(const Sweep& sweep, Hit& hit) const;
  void test(const Sweep& sweep, const Obstacle& obstacle, Hit& hit) const;
  void testFace(const Sweep& sweep, const Obstacle& obstacle, const Vector3& normal, Hit& hit) const;
  void placeMoving(const ParticleStore& store, const SolidContact& contact);
  Vector3 sweepOf(Sweep sweep, uint32_t& body) const;

  double m_radius = 0, m_contact = 0, m_width = 0, m_faceTouch = 0, m_cell = 1, m_safeWay = 0, m_halfSkin = 0;  ///< m
  double m_longest = 0;  ///< m, of the obstacles' ways
  const FixedShapes* m_shapes = nullptr;
  Period m_period;
  Vector3 m_low, m_high;  ///< m, around the obstacles
  CellGrid m_grid;        ///< of them
  std::vector<uint32_t> m_static;
  std::vector<Obstacle> m_obstacles, m_unsorted;  ///< the first in order of cell
  /// Static ones, those that stood first and then those that moved when the lists were made.
  std::array<std::vector<uint32_t>, 2> m_listed;
  std::array<std::vector<float>, 2> m_clearance2;  ///< m2, by particle: from the nearest of these in its list
  std::vector<uint8_t> m_kind;                     ///< by particle: 0 not static, else 1 + which of these
  std::array<double, 2> m_reach{};                 ///< m, how far these have gone since, or go in this substep
  std::vector<api::Float4> m_held;
  std::vector<uint32_t> m_heldBy;
  ChunkSum m_moved;
  ExternalImpulse m_externalImpulse;
  Reactions* m_reactions = &Reactions::none();
};

}  // namespace ps
