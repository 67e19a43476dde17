// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/neighbours.h"
#include "core/solver/contact/wallplane.h"
#include "core/solver/fluid/pairkernels.h"

namespace ps {

/// Liquid between what lies below and a denser solid that sinks onto it, in a gap of up to three spacings. There its
/// particles form two or three flat layers: a crystal that gives way only to a quarter more than the pressure of the
/// liquid around (with two layers and a reach of two spacings; the wider the body, the more), as simple liquids do in
/// gaps of molecular size (Israelachvili 2011, Intermolecular and Surface Forces, ch. 15). At the scale of spacings
/// there is no such force, and the time that viscosity takes to let the liquid out is below what is resolved. So the
/// part of the density corrections that is vertical is reduced by kYield in such a gap, between all who meet there in
/// the same way, so that momentum is kept. The part along the gap remains, and presses the liquid out. Such a push has
/// no potential: where it went on, liquid would circle for ever. So it has faded before the last layer, which is left
/// below the solid, and only particles of the solid's lower side, with nothing of their body below them, take part.
///
/// It goes by the density of particles: the floor of a boat of steel that comes so near to the ground touches down.
/// What is denser than the liquid by less than a twentieth feels less of it, what is lighter nothing. It cannot help
/// what has not come so far: in the midst of a liquid, too, the order of particles holds up to a tenth of the pressure,
/// so that a body which is up to a tenth denser may hang there; cubes of three spacings, and what has little room
/// beside it or much liquid below, were seen to at a sixth.
class TrappedFilm {
 public:
  void configure(const SolverSettings& settings, const std::vector<WallSurface>& walls);
  /// After new lists: `solids` are those that move and have fluid near, ascending.
  void refresh(const ParticleStore& store, const Neighbours& neighbours, std::span<const uint32_t> solids);
  bool any() const { return !m_liquids.empty(); }
  /// Liquid particles in such gaps, ascending.
  std::span<const uint32_t> liquids() const { return m_liquids; }
  /// Share of vertical corrections that a liquid particle of a gap is spared.
  float yieldOf(uint32_t i) const { return m_yield[i]; }

  /// Whether corrections of a particle, liquid or solid, change.
  bool concerns(uint32_t i) const { return any() && m_concerned[i] != 0; }

  /// What the density stage knows of pairs: volumes times the kernel's factor, and positions with multipliers in w.
  struct Pairs {
    PairLists lists;
    const float* volumes;
    const api::Float4* multipliers;
  };
  /// What is to be added to the correction of a particle that it concerns, m kg: times its inverse mass. Walls are not
  /// in it. Positions are those of `pairs`, so that it may be called while particles are moved.
  Vector3 correctionOf(const ParticleStore& store, const Pairs& pairs, uint32_t i) const;
  const Vector3& up() const { return m_up; }

 private:
  /// Whether a liquid around a solid particle is lighter than it: others have no gap to fall through.
  bool outweighsLiquid(const ParticleStore& store, const Neighbours& neighbours, uint32_t solid) const;
  /// Whether its own body has matter below a solid particle.
  bool restsOnOwn(const ParticleStore& store, const Neighbours& neighbours, uint32_t solid) const;
  void findBelow(const ParticleStore& store, const Neighbours& neighbours, uint32_t solid);
  double boundaryBelow(const ParticleStore& store, const Neighbours& neighbours, uint32_t liquid, uint32_t body) const;
  bool isLevel(const WallPlane& floor) const;
  double riseOf(const ParticleStore& store, std::span<const api::Float4> at, uint32_t i, uint32_t j) const;

  double m_spacing = 0, m_support = 0;
  Vector3 m_up;                       ///< zero without gravity
  std::vector<WallSurface> m_floors;  ///< walls that are level, or somewhere so
  std::vector<uint32_t> m_liquids;
  std::vector<uint8_t> m_inside;     ///< of the solids asked for: whether one rests on its own body, or swims
  std::vector<float> m_yield;        ///< by particle
  std::vector<double> m_depth;       ///< m, to what lies below a liquid particle, while gaps are looked for
  std::vector<uint32_t> m_below;     ///< of which body's matter that was not
  std::vector<double> m_gap;         ///< spacings, the thinnest that a liquid particle is in, likewise
  std::vector<uint8_t> m_concerned;  ///< by particle
};

}  // namespace ps
