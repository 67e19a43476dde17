// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"
#include "core/particles/neighbours.h"
#include "core/solver/settings.h"

namespace ps {

/// The shares of particle i, of matter that is in one phase, half way on a plateau: until a thermal model knows better.
void setShares(ParticleStore& store, size_t i, api::Phase phase);

/// What heat does to mechanics, once per frame after HeatStage: rest volumes follow temperature and phase (at most 5 %
/// a frame), and particles change between solid, liquid and gas motion with scattered thresholds and hysteresis.
/// Structure follows afterwards: constraint plugins see the new motion in topology().
///
/// A solid lets go when melt_break_fraction, scattered by 0.3 either way by a hash of the particle's id, has melted: if
/// a whole lattice layer let go at once, the block would drop by a spacing and squirt out the film below. It is solid
/// again at freeze_bond_fraction. Vapour moves as gas from a gas fraction of 0.5 and falls again below 0.4. What
/// sublimes turns from solid into gas. Static particles keep motion and volume; their phase is reported like any other.
class PhaseStage {
 public:
  void configure(const SolverSettings& solver, std::span<const BakedMaterial> materials);
  /// Rest volume, phase, motion and inverse mass of newborn particles [first, last), without ramp. Mass, temperature
  /// and fractions must be set; motion Static stays. What is half solid begins as a solid; `bound` matter, which
  /// something holds together, as long as it would hold when it is warmed up to there.
  void initialise(ParticleStore& store, size_t first, size_t last, bool bound);
  /// One frame. `melted` receives the indices of particles that ceased to be solid (for the compression hand-over).
  /// True when any particle became solid.
  bool update(ParticleStore& store, std::vector<uint32_t>& melted);
  /// kg/m³ at its temperature and fractions.
  double restDensity(const ParticleStore& store, size_t i) const;
  /// Share of a solid particle that must have melted before it lets go.
  double meltThreshold(uint32_t material, uint32_t id) const;

 private:
  class Density;
  enum class Turn : uint8_t { None, Melted, Froze };
  struct Rule {
    double meltBreak, freeze;
  };
  double targetVolume(const ParticleStore& store, size_t i) const;
  api::Motion nextMotion(const ParticleStore& store, size_t i) const;

  SolverSettings m_solver;
  std::span<const BakedMaterial> m_materials;
  std::vector<Rule> m_rules;
  std::vector<Turn> m_turns;
};

}  // namespace ps
