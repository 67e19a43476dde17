// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/impulse.h"
#include "core/particles/reactions.h"
#include "core/solver/contact/fixedshapes.h"
#include "core/solver/contact/walls.h"

namespace ps {

/// Fluid on the surfaces of fixed bodies: centres stay half a spacing off, as on walls, and no way leads through a
/// surface, however thin it is and however fast the way was. A way is followed from one place to the next as far as
/// nothing is near (Hart 1996, "Sphere tracing"), and slides along what it meets; past a shape that moves, as seen by
/// it. Whoever was too near before the substep, since it was born there or a face has another place by new lists, is
/// put off without a velocity. What is squeezed between a shape that moves and one that does not stays outside of the
/// latter.
class ShapeContact {
 public:
  void configure(const SolverSettings& settings);
  /// When positions have been predicted: all ways of the substep, by the lists that were.
  void sweep(ParticleStore& store, const FixedShapes& shapes);
  /// Those near a surface; for the iterations.
  void projectNear(ParticleStore& store, const FixedShapes& shapes);
  /// At the substep's end: what iterations have moved, by the lists as they are. Walls have the last word.
  void finish(ParticleStore& store, const FixedShapes& shapes, const WallStage& walls);
  /// What was moved, kg m.
  ExternalImpulse& externalImpulse() { return m_externalImpulse; }
  /// Where walls and fixed particles are told what they get.
  void tell(Reactions& reactions) { m_reactions = &reactions; }

 private:
  Vector3 slid(const FixedShapes& shapes, Vector3 at, Vector3 way, uint32_t& body, int which) const;
  Vector3 sweptOf(const FixedShapes& shapes, const Vector3& from, const Vector3& to, uint32_t& body) const;
  bool isFree(const FixedShapes& shapes, size_t fluid, const Vector3& from, const Vector3& to) const;
  bool isBelieved(const Vector3& at, const Vector3& noted) const;
  bool isApart(const Vector3& a, const Vector3& b) const;
  void giveRoom(ParticleStore& store, const FixedShapes& shapes, size_t fluid) const;
  /// Moves particle i and tells who moved it.
  void move(ParticleStore& store, uint32_t i, const Vector3& to, uint32_t body, size_t chunk);
  void project(ParticleStore& store, std::span<const FixedShapes::Near> near, uint32_t i, size_t chunk);
  template <class Body>
  void forFluids(const FixedShapes& shapes, const Body& body);

  double m_rest = 0;                 ///< m, half a spacing
  std::vector<api::Float4> m_swept;  ///< by place among the fluids: where the first sweep left it
  ChunkSum m_moved;
  ExternalImpulse m_externalImpulse;
  Reactions* m_reactions = &Reactions::none();
};

}  // namespace ps
