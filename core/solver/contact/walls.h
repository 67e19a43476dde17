// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/impulse.h"
#include "core/particles/neighbours.h"
#include "core/particles/reactions.h"
#include "core/solver/contact/nearwalls.h"

namespace ps {

/// Walls: a particle's centre stays half a spacing before them. Projection onto a plane, or onto a vessel around all
/// matter, is already swept, so that nothing passes a wall at any speed; what flies through a pillar or a ball is put
/// where it met it. Solids rub: the tangential way of the substep is reduced by up to friction times the depth (Macklin
/// et al. 2014, eq. 24).
class WallStage {
 public:
  void configure(const SolverSettings& settings, const std::vector<Wall>& walls);
  /// After new lists or a new structure: who may reach a wall before the next lists. Members of rigid bodies (1 in
  /// `rigid`) are left to RigidContact.
  void refreshLists(const ParticleStore& store, const Neighbours& neighbours, std::span<const uint8_t> rigid);
  /// Those near a wall; for the iterations.
  void projectNear(ParticleStore& store);
  /// All particles; for the ends of a substep.
  void project(ParticleStore& store);
  /// One particle, without friction; `position` in m.
  void clamp(Vector3& position) const;
  /// What project() and projectNear() moved, kg m.
  ExternalImpulse& externalImpulse() { return m_externalImpulse; }
  /// Where walls and fixed particles are told what they get.
  void tell(Reactions& reactions) { m_reactions = &reactions; }

 private:
  /// Returns how far it was moved, m.
  Vector3 projectOne(const WallPlane& plane, ParticleStore& store, size_t i, float depth) const;
  /// Moves particle i out of these walls.
  void projectOut(ParticleStore& store, size_t i, const WallSet& walls, size_t chunk);
  /// Puts what went through a wall with matter outside where it met it.
  void sweep(ParticleStore& store, size_t first, size_t last);
  void book(const ParticleStore& store, size_t i, size_t wall, const Vector3& moved, size_t chunk);
  void startSums(size_t chunks);
  void finishSums();

  std::vector<WallSurface> m_walls;
  std::vector<WallFace> m_passable;    ///< with matter outside, on which centres lie
  std::vector<size_t> m_passableWall;  ///< their indices
  double m_narrowest = 0;              ///< m, the least radius of these
  std::vector<uint32_t> m_near;
  std::vector<WallSet> m_nearWalls;  ///< by particle
  std::vector<uint8_t> m_rigid;
  ChunkSum m_moved;
  ExternalImpulse m_externalImpulse;
  Reactions* m_reactions = &Reactions::none();
  float m_reach = 0;  ///< m, beyond the resting distance
};

}  // namespace ps
