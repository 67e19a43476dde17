// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"
#include "core/particles/neighbours.h"
#include "core/solver/settings.h"

#include <vector>

namespace ps {

/// Gravity, and what the air around does to matter. A vapour particle swells far less than real vapour, so its lift is
/// worked out from physical densities, along the gravity vector, with f the gas fraction and phi the share of its
/// surroundings that is liquid:
///
///   a = f (phi g + (1 - phi) g parcelLift(rho_air/rho)) - (1 - f) g
///
/// upwards; and drag towards the wind u, semi-implicit, with Cd = 0.5 and D = gasDrag:
///
///   dv/dt = -f (1 - phi) k |v - u| (v - u),   k = dragRate(rho_air/rho)
///
/// rho and rho_air are those of ideal gases at the particle's temperature and at the ambient one. Inside liquid the
/// density constraint pushes as Archimedes would; the plain +g only undoes the weight. Vapour heavier than air sinks.
/// With airDrag, liquids and solids feel the air as well, each particle as a sphere of its volume in the share of its
/// surroundings that is empty, with the air's lift: a single drop falls as it should, while a block is dragged by its
/// surface's particles, which is about its real drag and knows neither lee nor lift. The thesis's model replaces the
/// vapour's forces by thesisGravity(), without drag. Not modelled: mixing with air, air set in motion by matter.
class GasForces {
 public:
  void configure(const SolverSettings& solver, const ThermalSettings& thermal,
                 std::span<const BakedMaterial> materials);
  /// K; a finite lump of air warms. Until it is set the ambient one.
  void setAir(double temperature) { m_thermal.ambientTemperature = temperature; }
  /// Once per frame: how much of the neighbourhood is liquid, or for airDrag any matter.
  void measure(const ParticleStore& store, const Neighbours& neighbours);
  /// Adds dt times the acceleration to the velocities of particles [first, last) that move.
  void apply(ParticleStore& store, size_t first, size_t last, double dt) const;

  /// Density of a vapour in kg/m3 at a temperature in K and the ambient pressure.
  double vapourDensity(uint32_t material, double temperature) const;
  /// Density of the ambient air in kg/m3.
  double airDensity() const;

 private:
  /// Share of the surroundings that is filled: with liquid, or with anything.
  float filled(const ParticleStore& store, const api::NeighbourView& lists, size_t i, bool withLiquid) const;
  struct Pull {
    double weight;  ///< share of gravity that acts
    double drag;    ///< 1/m
  };
  Pull pullOf(const ParticleStore& store, size_t i) const;

  SolverSettings m_solver;
  ThermalSettings m_thermal;
  std::span<const BakedMaterial> m_materials;
  std::vector<double> m_molarMass;  ///< kg/mol, per material
  std::vector<float> m_filled;
};

}  // namespace ps
