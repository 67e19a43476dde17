// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/particlestore.h"
#include "core/scene/project.h"

#include <array>
#include <vector>

namespace ps {

using CellIndex = std::array<int, 3>;

/// Centres in m of a cubic lattice that fills a box, at least one particle per axis, centred in it.
std::vector<api::Double3> boxLattice(const BoxShape& box, double spacing);
/// Cells of one palette entry, in order of the runs.
std::vector<CellIndex> cellsOf(const VoxelShape& voxels, int palette);
std::vector<api::Double3> cellCentres(const VoxelShape& voxels, double spacing, const std::vector<CellIndex>& cells);

/// Leaves out positions that have a live particle (or an earlier one of the list) within `clearance` m.
std::vector<api::Double3> freePositions(const ParticleStore& store, const std::vector<api::Double3>& positions,
                                        double clearance);
/// Ids of particles whose centre lies in one of the cells, ascending.
std::vector<uint32_t> idsInCells(const ParticleStore& store, const VoxelShape& voxels, double spacing,
                                 std::vector<CellIndex> cells);

}  // namespace ps
