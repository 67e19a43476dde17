// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/thermal.h>

#include "core/matter/material.h"
#include "core/particles/neighbours.h"
#include "core/solver/settings.h"

namespace ps {

/// The thermal half of a frame: pairwise conduction (Cleary & Monaghan 1999 between materials, Kirchhoff within one),
/// walls, air, film condensation, nucleation. Heat is exchanged in equal and opposite joules, so that a closed system
/// keeps its energy to rounding. Kinds of heat a model cannot do: see the thermal plugin's help.
class HeatStage {
 public:
  /// References stay valid until the next configure(). `model` may be nullptr: no heat flows.
  void configure(const ThermalSettings& settings, const SolverSettings& solver, std::vector<Wall> walls,
                 std::span<const BakedMaterial> materials, const api::ThermalPlugin* model,
                 std::vector<double> modelParameters);
  /// Sets state, temperature and fractions of particles [first, last).
  void initialise(ParticleStore& store, size_t first, size_t last, std::span<const double> temperature,
                  std::span<const api::Phase> phase);
  /// One frame of `dt` s of mechanical time. Lists must be fresh. Updates temperature and fractions, not volumes.
  void advance(ParticleStore& store, const Neighbours& neighbours, double dt);
  /// Re-derives temperature and fractions (after a change of pressure or material).
  void derive(ParticleStore& store);
  double energy(const ParticleStore& store) const;  ///< J, the model's, summed in order of index chunks
  const HeatLedger& ledger() const { return m_ledger; }
  /// Joules that left or came with removed or added particles are booked here.
  void book(double joules) { m_ledger.sources += joules; m_ledger.exchanged += joules < 0 ? -joules : joules; }
  int lastSubsteps() const { return m_lastSubsteps; }

 private:
  ThermalSettings m_settings;
  SolverSettings m_solver;
  std::vector<Wall> m_walls;
  std::span<const BakedMaterial> m_materials;
  const api::ThermalPlugin* m_model = nullptr;
  std::vector<double> m_parameters;
  HeatLedger m_ledger;
  int m_lastSubsteps = 0;
};

}  // namespace ps
