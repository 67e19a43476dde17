// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"
#include "core/solver/density.h"

namespace ps {

/// Viscosity as the XSPH filter of Monaghan 1992, momentum-conserving, over fluid particles and the solids they touch.
/// A coefficient c acts like the kinematic viscosity nu = c s2/(2 dt), s2 = int W x^2 dV (0.075 R^2 for the cubic
/// spline), so c follows from the material's viscosity; at c = 1 the filter is exhausted, and limits() says so.
/// It cannot do: honey at a coarse step, shear stress at a free surface.
class ViscosityStage {
 public:
  void configure(const SolverSettings& settings, std::span<const BakedMaterial> materials);
  /// Once per frame: coefficients of all particles from their temperatures.
  void refresh(const ParticleStore& store, const DensityStage& density);
  /// After velocities follow from positions.
  void apply(ParticleStore& store, const Neighbours& neighbours, const DensityStage& density);
  void limits(const ParticleStore& store, std::vector<Limit>& out) const;

 private:
  double greatestViscosity() const;  ///< m2/s, at c = 1
  SolverSettings m_settings;
  std::span<const BakedMaterial> m_materials;
  double m_secondMoment = 0;  ///< s2, m2
  std::vector<float> m_coefficient;
  std::vector<uint32_t> m_which;
  std::vector<api::Float4> m_change;
};

}  // namespace ps
