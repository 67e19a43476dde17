// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"
#include "core/particles/neighbours.h"
#include "core/solver/settings.h"

#include <vector>

namespace ps {

/// Gravity, and for vapour the parcel model. A vapour particle swells far less than real vapour, so its lift is worked
/// out from physical densities, along the gravity vector, with f the gas fraction and phi the share of its surroundings
/// that is liquid:
///
///   a = f (phi g + (1 - phi) g (rho_air/rho - 1)/(1 + C rho_air/rho)) - (1 - f) g
///
/// upwards, with C = addedMass; and drag, semi-implicit, with Cd = 0.5 and D = gasDrag:
///
///   dv/dt = -f (1 - phi) k |v| v,   k = 3 Cd rho_air/(4 rho D)
///
/// rho and rho_air are those of ideal gases at the particle's temperature and at the ambient one. Inside liquid the
/// density constraint pushes as Archimedes would; the plain +g only undoes the weight. Vapour heavier than air sinks.
/// Not modelled: wind, mixing with air. Where airDrag is set, loose solid and liquid particles feel the air as spheres
/// of their volume.
class GasForces {
 public:
  void configure(const SolverSettings& solver, const ThermalSettings& thermal,
                 std::span<const BakedMaterial> materials);
  /// Once per frame: how much of the neighbourhood is liquid.
  void measure(const ParticleStore& store, const Neighbours& neighbours);
  /// Adds dt times the acceleration to the velocities of particles [first, last) that move.
  void apply(ParticleStore& store, size_t first, size_t last, double dt) const;

  /// Density of a vapour in kg/m3 at a temperature in K and the ambient pressure.
  double vapourDensity(uint32_t material, double temperature) const;
  /// Density of the ambient air in kg/m3.
  double airDensity() const;

 private:
  struct AirEffect {
    double weight, slow;  ///< share of gravity that acts, factor on the velocity
  };
  float coverOf(const ParticleStore& store, const api::NeighbourView& lists, size_t i) const;
  AirEffect airOn(const ParticleStore& store, size_t i, double dt) const;
  float immersionOf(const ParticleStore& store, const api::NeighbourView& lists, size_t i) const;

  SolverSettings m_solver;
  ThermalSettings m_thermal;
  std::span<const BakedMaterial> m_materials;
  std::vector<double> m_molarMass;  ///< kg/mol, per material
  std::vector<float> m_immersion, m_cover;
};

}  // namespace ps
