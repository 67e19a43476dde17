// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "enthalpymodel.h"

#include <string_view>

namespace ps::thermal {

/// The plain ("explicit") diffusion of the 2020 thesis, kept for comparison: dT/dt = phi lap T with one phi for all
/// matter, in m2/s, where conductivities play no part.
///
/// In pair form (Brookshaw 1985), dT_i/dt = phi sum_j 2 V_j (-F_ij) (T_j - T_i), F = (1/r) dW/dr of the cubic spline, V
/// the rest volume. What crosses a pair is heat, and the same for both: Q_ij = phi (rho c)_ij V_i V_j 2 (-F_ij) (T_j -
/// T_i) with the harmonic mean of the two volumetric heat capacities; so energy is kept between any two materials, and
/// where these are alike the equation holds to the letter. Between unlike ones each side changes at the rate of the
/// pair's mean, less than phi says for the one that stores more.
///
/// Latent heat is that of the enthalpy model underneath. On a lattice with a reach of 2 the kernel conducts 2.0 % too
/// well, 2.5: 1.8 % too little, 3: 1.0 % too well; the host's correction for disorder does not act here. Walls and air
/// go by the material's conductivity, as with the other models.
class ThesisDiffusionModel : public EnthalpyModel, public api::PairRates {
 public:
  ThesisDiffusionModel();

  const void* extension(const char* name) const noexcept override {
    return std::string_view(name) == api::kPairRates ? static_cast<const api::PairRates*>(this) : nullptr;
  }
  bool pairFlux(const api::ThermalContext& context, const api::ParticleView& particles,
                const api::NeighbourView& neighbours, size_t first, size_t last, double* watts) const override;
  double fastestPairRate(const api::ThermalContext& context, const api::ParticleView& particles,
                         const api::NeighbourView& neighbours, size_t first, size_t last) const override;
};

}  // namespace ps::thermal
