// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"
#include "core/particles/neighbours.h"
#include "core/solver/settings.h"

namespace ps {

/// What heat does to mechanics, once per frame after HeatStage: rest volumes follow temperature and phase (at most 5 %
/// a frame), and particles change between solid, liquid and gas motion with scattered thresholds and hysteresis
/// (RECIPES 1.3, 2). Structure follows afterwards: constraint plugins see the new motion in topology().
class PhaseStage {
 public:
  void configure(const SolverSettings& solver, std::span<const BakedMaterial> materials);
  /// Rest volume, motion and inverse mass of newborn particles [first, last), without ramp.
  void initialise(ParticleStore& store, size_t first, size_t last);
  /// One frame. `melted` receives the indices of particles that ceased to be solid (for the compression hand-over).
  void update(ParticleStore& store, std::vector<uint32_t>& melted);

 private:
  SolverSettings m_solver;
  std::span<const BakedMaterial> m_materials;
};

}  // namespace ps
