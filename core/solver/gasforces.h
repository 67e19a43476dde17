// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"
#include "core/particles/neighbours.h"
#include "core/solver/settings.h"

namespace ps {

/// Gravity, and for vapour the parcel model: buoyancy from physical densities against ambient air or liquid, added mass,
/// quadratic drag, semi-implicit (PHYSICS 4.7 as corrected by RECIPES 4).
class GasForces {
 public:
  void configure(const SolverSettings& solver, const ThermalSettings& thermal, std::span<const BakedMaterial> materials);
  /// Once per frame: how much of the neighbourhood is liquid.
  void measure(const ParticleStore& store, const Neighbours& neighbours);
  /// Adds dt times the acceleration to the velocities of particles [first, last) that move.
  void apply(ParticleStore& store, size_t first, size_t last, double dt) const;

 private:
  SolverSettings m_solver;
  ThermalSettings m_thermal;
  std::span<const BakedMaterial> m_materials;
  std::vector<float> m_immersion;
};

}  // namespace ps
