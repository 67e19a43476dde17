// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/particlestore.h"
#include "core/scene/project.h"
#include "core/sketch/grid.h"
#include "core/solver/matter.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ps {

using CellIndex = std::array<int, 3>;

/// Centres in m of a cubic lattice that fills a box, at least one particle per axis, centred in it.
std::vector<api::Double3> boxLattice(const BoxShape& box, double spacing);
/// Moves each place by up to `jitter` spacings along each axis, by a hash of the place and the seed.
void disturb(std::vector<api::Double3>& positions, double spacing, double jitter, uint32_t seed);
/// Cells of one palette entry, in order of the runs.
std::vector<CellIndex> cellsOf(const VoxelShape& voxels, int palette);
/// Cells of edge `to` m whose centres lie in `cells` of edge `from` m; both lattices share the lower corner of cell
/// (0, 0, 0), so that what stands on a floor still does. Volume is kept to about a cell's width; a layer thinner than
/// `to` may vanish. In order of z, y, x where the edges differ, else as they come.
std::vector<CellIndex> resampled(const std::vector<CellIndex>& cells, double from, double to);
/// How many there are of all of a sketch's cells.
double resampledCount(const VoxelShape& voxels, double to);
/// Centre in m of cell (0, 0, 0) of the lattice that resampled() gives, as it was drawn.
Vector3 resampledOrigin(const VoxelShape& voxels, double to);
/// Centres in m of the particles of a lattice of `spacing` m that fill cells of a sketch.
std::vector<api::Double3> cellCentres(const VoxelShape& voxels, double spacing, const std::vector<CellIndex>& cells);

/// Points found by place, for scenes of millions: a table of chains, one per cell. What it answers depends neither on
/// the order of its points nor on the table's size.
class OccupiedPlaces {
 public:
  /// `clearance` in m; `expected` points make the table long enough, more make it slower. In a periodic box distances
  /// are those of the nearest images.
  OccupiedPlaces(double clearance, size_t expected, const Period& period = {});
  void add(const api::Double3& p);
  bool isFree(const api::Double3& p) const;  ///< no point nearer than `clearance`

 private:
  static constexpr uint32_t kNone = ~0u;
  bool isFreeHere(const api::Double3& p) const;
  size_t slotOf(const CellIndex& cell) const;
  Period m_period;
  double m_clearance;
  std::vector<uint32_t> m_first, m_next;  ///< indices of points
  std::vector<api::Double3> m_points;
};

/// A box around all places with `margin` m to spare; along an axis that repeats it has no end. What lies outside of it
/// is farther than that from each of them.
class NearBox {
 public:
  NearBox(std::span<const api::Double3> places, double margin, const Period& period);
  bool holds(const api::Float4& place) const;

 private:
  std::array<double, 3> m_low, m_high;  ///< m
};

/// Particles, by their places in the store, in a box around some places with `margin` m to spare: all that are as near
/// as that to one of them, and others.
std::vector<uint32_t> rowsNear(const ParticleStore& store, std::span<const api::Double3> places, double margin);
/// The places of a store's particles; `clearance` in m.
OccupiedPlaces occupiedPlaces(const ParticleStore& store, double clearance);
/// Leaves out positions that have a live particle (or an earlier one of the list) within `clearance` m.
std::vector<api::Double3> freePositions(const ParticleStore& store, const std::vector<api::Double3>& positions,
                                        double clearance);
/// Two boxes side by side, both rounded up to whole layers, come within half a spacing: that near is no overlap.
inline constexpr double kOverlap = 0.4;  ///< spacings
/// Leaves out particles that would stand where one stands already, which no force could part, and notes the others'
/// places; returns how many were left out. Those too near to what is `taken` are left out as well.
size_t dropOccupied(Spawn& spawn, OccupiedPlaces& occupied, const OccupiedPlaces* taken = nullptr);
/// Share of a cell by which a point counts as on a face, and so as of the cell of the higher index. Matter of a box may
/// stand on the faces of a sketch's lattice, and particles know their places in single precision: whoever asks which
/// cell holds them must not be decided by rounding.
inline constexpr double kOnFace = 1e-3;
/// A sketch's lattice whose cells hold the points on their faces.
SketchGrid wideGridOf(const VoxelShape& voxels);
/// Ids of particles whose centre lies in one of the cells of a sketch's lattice, ascending.
std::vector<uint32_t> idsInCells(const ParticleStore& store, const VoxelShape& voxels, std::vector<CellIndex> cells);

}  // namespace ps
