// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"
#include "core/simulation/compile.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ps {

/// The scene's materials as tables for a solver. A table costs a millisecond to bake, and a dragged slider asks for one
/// several times a frame: only what has changed is baked anew.
class MaterialTables {
 public:
  /// Brings the tables and the solver's up to date with the project: all of them, or the one of a material's id ("" for
  /// all). Throws like compileMaterials() and has then changed nothing. Returns whether anything changed.
  bool update(const Project& project, const PluginRegistry& plugins, Solver& solver, const std::string& only = {});
  const std::vector<BakedMaterial>& tables() const { return m_tables; }
  /// sRGB and clearness at 20 °C, 0..1.
  const std::vector<std::array<float, 4>>& looks() const { return m_looks; }
  bool anyMelts() const;
  /// Curves and laws that leave their property's range where there is matter of that phase, and what is used instead.
  std::vector<Limit> limits(const ParticleStore& store) const;
  uint64_t baked() const { return m_baked; }  ///< tables made since the scene was built for the first time

 private:
  std::vector<Material> m_sources;  ///< what each table was baked from, at m_pressure
  double m_pressure = 0;            ///< Pa
  std::vector<BakedMaterial> m_tables;
  std::vector<std::array<float, 4>> m_looks;
  EvaluatedMaterials m_evaluated;
  uint64_t m_baked = 0;
};

}  // namespace ps
