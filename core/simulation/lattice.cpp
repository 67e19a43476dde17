// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/lattice.h"

#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/scene/pose.h"
#include "core/sketch/cellset.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

namespace ps {
namespace {

CellIndex cellAt(const api::Double3& p, const SketchGrid& grid) {
  const api::Cell cell = grid.cellAt({p.x, p.y, p.z});
  return {cell.x, cell.y, cell.z};
}

double squaredDistance(const api::Double3& a, const api::Double3& b) {
  const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return x * x + y * y + z * z;
}

/// A step of the generator SplitMix64 (Steele, Lea & Flood 2014): every bit of the result hangs on every bit given.
uint64_t mixed(uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace

OccupiedPlaces::OccupiedPlaces(double clearance, size_t expected, const Period& period)
    : m_period(period), m_clearance(clearance), m_first(std::bit_ceil(std::max<size_t>(expected, 16)), kNone) {
  m_points.reserve(expected);
  m_next.reserve(expected);
}

/// Row of the table for a cell of edge 2 clearances; several cells may share one.
size_t OccupiedPlaces::slotOf(const CellIndex& cell) const {
  uint64_t hash = 0;
  for (const int c : cell) hash = (hash ^ static_cast<uint32_t>(c)) * 0x9e3779b97f4a7c15u;
  return static_cast<size_t>(hash >> 32) & (m_first.size() - 1);
}

void OccupiedPlaces::add(const api::Double3& place) {
  const api::Double3 p = m_period.wrapped(place);
  uint32_t& first = m_first[slotOf(cellAt(p, {{0, 0, 0}, 2 * m_clearance}))];
  m_next.push_back(first);
  first = static_cast<uint32_t>(m_points.size());
  m_points.push_back(p);
}

bool OccupiedPlaces::isFree(const api::Double3& place) const {
  const api::Double3 p = m_period.wrapped(place);
  if (!m_period.any()) return isFreeHere(p);
  // Near a face of a periodic box the points beyond it count too.
  const double at[3] = {p.x, p.y, p.z};
  double shift[3][2] = {};
  int images[3] = {1, 1, 1};
  for (size_t a = 0; a < 3; ++a) {
    const double length = m_period.length(a);
    if (!(length > 0)) continue;
    if (at[a] - m_period.low(a) < m_clearance)
      shift[a][images[a]++] = length;
    else if (m_period.low(a) + length - at[a] < m_clearance)
      shift[a][images[a]++] = -length;
  }
  for (int z = 0; z < images[2]; ++z) {
    for (int y = 0; y < images[1]; ++y) {
      for (int x = 0; x < images[0]; ++x) {
        if (!isFreeHere({p.x + shift[0][x], p.y + shift[1][y], p.z + shift[2][z]})) return false;
      }
    }
  }
  return true;
}

bool OccupiedPlaces::isFreeHere(const api::Double3& p) const {
  const double r = m_clearance;
  const SketchGrid grid{{0, 0, 0}, 2 * r};
  const CellIndex low = cellAt({p.x - r, p.y - r, p.z - r}, grid), high = cellAt({p.x + r, p.y + r, p.z + r}, grid);
  for (int z = low[2]; z <= high[2]; ++z) {
    for (int y = low[1]; y <= high[1]; ++y) {
      for (int x = low[0]; x <= high[0]; ++x) {
        for (uint32_t i = m_first[slotOf({x, y, z})]; i != kNone; i = m_next[i]) {
          if (squaredDistance(p, m_points[i]) < r * r) return false;
        }
      }
    }
  }
  return true;
}

NearBox::NearBox(std::span<const api::Double3> places, double margin, const Period& period) {
  m_low.fill(HUGE_VAL), m_high.fill(-HUGE_VAL);
  for (const api::Double3& p : places) {
    const double at[3] = {p.x, p.y, p.z};
    for (size_t a = 0; a < 3; ++a) {
      m_low[a] = std::min(m_low[a], at[a] - margin), m_high[a] = std::max(m_high[a], at[a] + margin);
    }
  }
  for (size_t a = 0; a < 3; ++a) {
    if (period.length(a) > 0) m_low[a] = -HUGE_VAL, m_high[a] = HUGE_VAL;
  }
}

bool NearBox::holds(const api::Float4& p) const {
  const double at[3] = {p.x, p.y, p.z};
  return at[0] >= m_low[0] && at[0] <= m_high[0] && at[1] >= m_low[1] && at[1] <= m_high[1] && at[2] >= m_low[2] &&
         at[2] <= m_high[2];
}

std::vector<api::Double3> boxLattice(const BoxShape& box, double spacing) {
  std::array<int, 3> count;
  std::array<double, 3> first;
  for (size_t a = 0; a < 3; ++a) {
    count[a] = static_cast<int>(layersAlong(box.size[a], spacing));
    first[a] = box.center[a] - 0.5 * (count[a] - 1) * spacing;
  }
  std::vector<api::Double3> positions;
  positions.reserve(static_cast<size_t>(count[0]) * static_cast<size_t>(count[1]) * static_cast<size_t>(count[2]));
  for (int z = 0; z < count[2]; ++z) {
    for (int y = 0; y < count[1]; ++y) {
      advance(static_cast<size_t>(count[0]));
      for (int x = 0; x < count[0]; ++x) {
        positions.push_back({first[0] + x * spacing, first[1] + y * spacing, first[2] + z * spacing});
      }
    }
  }
  return positions;
}

void disturb(std::vector<api::Double3>& positions, double spacing, double jitter, uint32_t seed) {
  if (!(jitter > 0)) return;
  inSlices(0, positions.size(), [&](size_t first, size_t last) {
    for (api::Double3& p : std::span(positions).subspan(first, last - first)) {
      uint64_t state = seed;
      for (const double c : {p.x, p.y, p.z})
        state = mixed(state ^ static_cast<uint64_t>(std::llround(c / spacing * 64)));
      for (double* c : {&p.x, &p.y, &p.z}) {
        state = mixed(state);
        *c += jitter * spacing * (static_cast<double>(state >> 11) * 0x1p-52 - 1);
      }
    }
  });
}

std::vector<CellIndex> cellsOf(const VoxelShape& voxels, int palette) {
  std::vector<CellIndex> cells;
  for (const VoxelShape::Run& run : voxels.runs) {
    if (run.palette != palette) continue;
    for (int k = 0; k < run.length; ++k) cells.push_back({run.x + k, run.y, run.z});
  }
  return cells;
}

namespace {

/// From the shared corner, centre k of the new lattice lies at (k + 1/2) to, and cell p spans [p, p + 1) from. The
/// bounds of neighbours are one expression: no centre belongs to two cells, or to none. A hair is taken off so that
/// rounding does not decide about a centre on a face.
int firstCentre(int p, double ratio) { return static_cast<int>(std::ceil(p * ratio - 0.5 - 1e-9)); }

}  // namespace

std::vector<CellIndex> resampled(const std::vector<CellIndex>& cells, double from, double to) {
  if (from == to) return cells;
  const auto firstFrom = [ratio = from / to](int p) { return firstCentre(p, ratio); };
  std::vector<CellIndex> result;
  inSlices(0, cells.size(), [&](size_t first, size_t last) {
    for (const CellIndex& c : std::span(cells).subspan(first, last - first)) {
      for (int z = firstFrom(c[2]); z < firstFrom(c[2] + 1); ++z) {
        for (int y = firstFrom(c[1]); y < firstFrom(c[1] + 1); ++y) {
          for (int x = firstFrom(c[0]); x < firstFrom(c[0] + 1); ++x) result.push_back({x, y, z});
        }
      }
    }
  });
  std::sort(result.begin(), result.end(), [](const CellIndex& a, const CellIndex& b) {
    return std::tie(a[2], a[1], a[0]) < std::tie(b[2], b[1], b[0]);
  });
  return result;
}

double resampledCount(const VoxelShape& voxels, double to) {
  const double ratio = voxels.spacing / to;
  const auto between = [&](int first, int last) {
    return static_cast<double>(firstCentre(last, ratio) - firstCentre(first, ratio));
  };
  double count = 0;
  for (const VoxelShape::Run& run : voxels.runs)
    count += between(run.x, run.x + run.length) * between(run.y, run.y + 1) * between(run.z, run.z + 1);
  return count;
}

Vector3 resampledOrigin(const VoxelShape& voxels, double to) {
  const double shift = (to - voxels.spacing) / 2;
  return voxels.origin + Vector3::Constant(shift);
}

std::vector<api::Double3> cellCentres(const VoxelShape& voxels, double spacing, const std::vector<CellIndex>& cells) {
  const SketchGrid grid{resampledOrigin(voxels, spacing), spacing, poseOf(voxels)};
  std::vector<api::Double3> centres;
  centres.reserve(cells.size());
  for (const CellIndex& c : resampled(cells, voxels.spacing, spacing))
    centres.push_back(double3Of(grid.centreOf({c[0], c[1], c[2]})));
  return centres;
}

std::vector<uint32_t> rowsNear(const ParticleStore& store, std::span<const api::Double3> places, double margin) {
  std::vector<uint32_t> rows;
  const NearBox box(places, margin, store.period());
  if (!places.empty()) findIndices(store.size(), rows, [&](size_t i) { return box.holds(store.position()[i]); });
  return rows;
}

OccupiedPlaces occupiedPlaces(const ParticleStore& store, double clearance) {
  OccupiedPlaces occupied(clearance, store.size(), store.period());
  for (size_t i = 0; i < store.size(); ++i) occupied.add(store.wrappedPosition(i));
  return occupied;
}

/// Of a brush's few places in a scene of many particles: those far from all of them are not looked at again.
std::vector<api::Double3> freePositions(const ParticleStore& store, const std::vector<api::Double3>& positions,
                                        double clearance) {
  const std::vector<uint32_t> near = rowsNear(store, positions, clearance);
  OccupiedPlaces occupied(clearance, near.size() + positions.size(), store.period());
  for (const uint32_t i : near) occupied.add(store.wrappedPosition(i));
  std::vector<api::Double3> free;
  for (const api::Double3& p : positions) {
    if (!occupied.isFree(p)) continue;
    occupied.add(p);
    free.push_back(p);
  }
  return free;
}

size_t dropOccupied(Spawn& spawn, OccupiedPlaces& occupied, const OccupiedPlaces* taken) {
  size_t kept = 0;
  inSlices(0, spawn.position.size(), [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const api::Double3 place = spawn.position[k];
      if (!occupied.isFree(place) || (taken && !taken->isFree(place))) continue;
      occupied.add(place);
      spawn.position[kept] = place;
      spawn.velocity[kept] = spawn.velocity[k];
      if (!spawn.temperatures.empty()) {
        spawn.temperatures[kept] = spawn.temperatures[k];
        spawn.phases[kept] = spawn.phases[k];
      }
      ++kept;
    }
  });
  const size_t dropped = spawn.position.size() - kept;
  spawn.position.resize(kept);
  spawn.velocity.resize(kept);
  if (!spawn.temperatures.empty()) {
    spawn.temperatures.resize(kept);
    spawn.phases.resize(kept);
  }
  return dropped;
}

SketchGrid wideGridOf(const VoxelShape& voxels) {
  SketchGrid grid = gridOf(voxels);
  grid.origin -= Vector3::Constant(kOnFace * voxels.spacing);
  return grid;
}

std::vector<uint32_t> idsInCells(const ParticleStore& store, const VoxelShape& voxels, std::vector<CellIndex> cells) {
  std::sort(cells.begin(), cells.end());
  const SketchGrid grid = wideGridOf(voxels);
  std::vector<api::Double3> middles;
  middles.reserve(cells.size());
  for (const CellIndex& c : cells) middles.push_back(double3Of(grid.centreOf({c[0], c[1], c[2]})));
  std::vector<uint32_t> ids;
  for (const uint32_t i : rowsNear(store, middles, voxels.spacing)) {  // half a cell's diagonal, and some
    const CellIndex cell = cellAt(store.wrappedPosition(i), grid);
    if (std::binary_search(cells.begin(), cells.end(), cell)) ids.push_back(store.id()[i]);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace ps
