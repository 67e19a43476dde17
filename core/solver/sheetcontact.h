// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/neighbours.h"
#include "core/solver/settings.h"

#include <span>
#include <vector>

namespace ps {

/// Liquid is kept off the particles of sheets and lines: spheres of 0.9 spacings, weighted by mass, averaged over a
/// particle's contacts. Density alone does not hold it: a layer one particle thick fills less than half of a liquid
/// particle's kernel. At rest the gaps of a square lattice let nothing through, 0.71 spacings from four particles;
/// cloth stretched by more than a quarter leaks. Slides without friction.
class SheetContact {
 public:
  void configure(const SolverSettings& settings);
  /// After new lists or a new structure. `thin`: 1 for bodies that are sheets or lines, by their index.
  void refresh(const ParticleStore& store, const Neighbours& neighbours, std::span<const uint8_t> thin);
  /// Whether any liquid is near a sheet.
  bool any() const { return !m_contacts.empty(); }
  void project(ParticleStore& store);

 private:
  struct Contact {
    uint32_t who, begin, end;  ///< a particle, and its partners of the other kind
  };
  double m_diameter = 0, m_reach = 0;
  std::vector<uint8_t> m_side;  ///< 1 sheet, 2 liquid
  std::vector<Contact> m_contacts;
  std::vector<uint32_t> m_other;
  std::vector<uint8_t> m_count;  ///< touching partners of each particle
  std::vector<api::Float4> m_moves;
};

}  // namespace ps
