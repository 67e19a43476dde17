// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/particlestore.h"
#include "core/particles/reactions.h"

#include <optional>
#include <span>
#include <vector>

namespace ps {

/// Mean force on walls and bodies over a frame, without their weight, and its torque about the origin. What moves of a
/// body is measured by its momentum, which everything has changed but gravity: contact, pressure, viscosity, ties, air,
/// damping. What is fixed of it, and a wall, by the opposite of all impulses that it gave (see Reactions); what ties
/// pull at it is the momentum that they gave to the piece of structure that hangs on it.
///
/// It cannot do: tell apart the pulls of a piece that hangs on fixed particles of several bodies, or what a plugin's
/// neighbour constraints get from what is fixed: neither is told. A wall gets what presses on its side of the scene.
class ForceMeter {
 public:
  /// Each once. Returns whether these are others than before.
  bool watch(std::span<const uint32_t> walls, std::span<const uint32_t> bodies);
  /// Whether the impulse of all walls and fixed bodies is to be known: given(). Returns whether that is new.
  bool watchAll(bool all);
  Reactions& reactions() { return m_reactions; }

  /// When a frame begins and its lists are fresh, before it moves anything.
  void begin(const ParticleStore& store);
  void end(const ParticleStore& store, const Vector3& gravity, double dt);  ///< s, of the frame
  /// What moves got from walls and what is fixed since begin(): kg m/s, kg m2/s about the origin. Of all with
  /// watchAll().
  Wrench given() const;

  /// After a new structure or order, `pieceOf` as ConstraintSystem::pieces() has it: which fixed body each of the
  /// `hanging` particles hangs on.
  void findAnchors(const ParticleStore& store, std::span<const uint32_t> pieceOf, std::span<const uint32_t> hanging);
  /// Before and after a call of plugins: `perStep` 1/s times the displacements in the substep, or, where it is 0, the
  /// momentum of what hangs.
  void beforeTies(const ParticleStore& store, std::span<const uint32_t> hanging, double perStep);
  void afterTies(const ParticleStore& store, std::span<const uint32_t> hanging, double perStep);

  /// Of the last frame; nothing before one has passed, or for what was not watched in it.
  std::optional<Wrench> onWall(size_t wall) const { return of(m_reactions.ofWall(wall)); }
  std::optional<Wrench> onBody(uint32_t body) const { return of(m_reactions.ofBody(body)); }

 private:
  /// Of what moves.
  struct Motion {
    Wrench momentum;  ///< kg m/s, kg m2/s about the origin
    double mass = 0;
    Vector3 moment;  ///< kg m, mass times place
  };
  std::optional<Wrench> of(int slot) const;
  void start();
  void read(const ParticleStore& store, std::vector<Motion>& motions) const;
  void readTies(const ParticleStore& store, std::span<const uint32_t> hanging, double perStep);

  Reactions m_reactions;
  std::vector<uint32_t> m_walls, m_bodies;
  std::vector<Motion> m_before, m_after;  ///< by slot
  std::vector<Wrench> m_forces;           ///< by slot, of the last frame
  bool m_all = false, m_measured = false;
  std::vector<int> m_anchor;      ///< slot, by place in the list of what hangs
  std::vector<Wrench> m_ties[2];  ///< by slot, before and after a call
};

}  // namespace ps
