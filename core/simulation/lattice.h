// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/particlestore.h"
#include "core/scene/project.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ps {

using CellIndex = std::array<int, 3>;

/// Centres in m of a cubic lattice that fills a box, at least one particle per axis, centred in it.
std::vector<api::Double3> boxLattice(const BoxShape& box, double spacing);
/// Cells of one palette entry, in order of the runs.
std::vector<CellIndex> cellsOf(const VoxelShape& voxels, int palette);
std::vector<api::Double3> cellCentres(const VoxelShape& voxels, double spacing, const std::vector<CellIndex>& cells);

/// Points found by place, for scenes of millions: a table of chains, one per cell. What it answers depends neither on
/// the order of its points nor on the table's size.
class TakenPlaces {
 public:
  /// `clearance` in m; `expected` points make the table long enough, more make it slower.
  TakenPlaces(double clearance, size_t expected);
  void add(const api::Double3& p);
  bool isFree(const api::Double3& p) const;  ///< no point nearer than `clearance`

 private:
  static constexpr uint32_t kNone = ~0u;
  size_t slotOf(const CellIndex& cell) const;
  double m_clearance;
  std::vector<uint32_t> m_first, m_next;  ///< indices of points
  std::vector<api::Double3> m_points;
};

/// Leaves out positions that have a live particle (or an earlier one of the list) within `clearance` m.
std::vector<api::Double3> freePositions(const ParticleStore& store, const std::vector<api::Double3>& positions,
                                        double clearance);
/// Ids of particles whose centre lies in one of the cells, ascending.
std::vector<uint32_t> idsInCells(const ParticleStore& store, const VoxelShape& voxels, double spacing,
                                 std::vector<CellIndex> cells);

}  // namespace ps
