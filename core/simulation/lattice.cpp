// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/lattice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace ps {
namespace {

CellIndex cellAt(const api::Double3& p, const Vec3& origin, double size) {
  return {static_cast<int>(std::floor((p.x - origin[0]) / size + 0.5)),
          static_cast<int>(std::floor((p.y - origin[1]) / size + 0.5)),
          static_cast<int>(std::floor((p.z - origin[2]) / size + 0.5))};
}

double squaredDistance(const api::Double3& a, const api::Double3& b) {
  const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return x * x + y * y + z * z;
}

api::Double3 positionOf(const ParticleStore& store, size_t i) {
  const api::Float4& p = store.position()[i];
  return {p.x, p.y, p.z};
}

/// Points by cell of edge `size`, so that everything within `size` of a point lies in its 27 cells.
class PointGrid {
 public:
  explicit PointGrid(double size) : m_size(size) {}
  void add(const api::Double3& p) { m_cells[cellAt(p, {0, 0, 0}, m_size)].push_back(p); }
  bool anyWithin(const api::Double3& p, double distance) const {
    const CellIndex c = cellAt(p, {0, 0, 0}, m_size);
    for (int k = 0; k < 27; ++k) {
      const auto found = m_cells.find({c[0] + k % 3 - 1, c[1] + k / 3 % 3 - 1, c[2] + k / 9 - 1});
      if (found == m_cells.end()) continue;
      for (const api::Double3& q : found->second) {
        if (squaredDistance(p, q) < distance * distance) return true;
      }
    }
    return false;
  }

 private:
  double m_size;
  std::map<CellIndex, std::vector<api::Double3>> m_cells;
};

}  // namespace

std::vector<api::Double3> boxLattice(const BoxShape& box, double spacing) {
  std::array<int, 3> count;
  std::array<double, 3> first;
  for (size_t a = 0; a < 3; ++a) {
    count[a] = std::max(1, static_cast<int>(std::lround(box.size[a] / spacing)));
    first[a] = box.center[a] - 0.5 * (count[a] - 1) * spacing;
  }
  std::vector<api::Double3> positions;
  positions.reserve(static_cast<size_t>(count[0]) * static_cast<size_t>(count[1]) * static_cast<size_t>(count[2]));
  for (int z = 0; z < count[2]; ++z) {
    for (int y = 0; y < count[1]; ++y) {
      for (int x = 0; x < count[0]; ++x) {
        positions.push_back({first[0] + x * spacing, first[1] + y * spacing, first[2] + z * spacing});
      }
    }
  }
  return positions;
}

std::vector<CellIndex> cellsOf(const VoxelShape& voxels, int palette) {
  std::vector<CellIndex> cells;
  for (const VoxelShape::Run& run : voxels.runs) {
    if (run.palette != palette) continue;
    for (int k = 0; k < run.length; ++k) cells.push_back({run.x + k, run.y, run.z});
  }
  return cells;
}

std::vector<CellIndex> resampled(const std::vector<CellIndex>& cells, double from, double to) {
  if (from == to) return cells;
  // From the shared corner, centre k of the new lattice lies at (k + 1/2) to, and cell p spans [p, p + 1) from. The
  // bounds of neighbours are one expression: no centre belongs to two cells, or to none. A hair is taken off so that
  // rounding does not decide about a centre on a face.
  const auto firstFrom = [ratio = from / to](int p) { return static_cast<int>(std::ceil(p * ratio - 0.5 - 1e-9)); };
  std::vector<CellIndex> result;
  for (const CellIndex& c : cells) {
    for (int z = firstFrom(c[2]); z < firstFrom(c[2] + 1); ++z) {
      for (int y = firstFrom(c[1]); y < firstFrom(c[1] + 1); ++y) {
        for (int x = firstFrom(c[0]); x < firstFrom(c[0] + 1); ++x) result.push_back({x, y, z});
      }
    }
  }
  std::sort(result.begin(), result.end(), [](const CellIndex& a, const CellIndex& b) {
    return std::tie(a[2], a[1], a[0]) < std::tie(b[2], b[1], b[0]);
  });
  return result;
}

Vec3 resampledOrigin(const VoxelShape& voxels, double to) {
  const double shift = (to - voxels.spacing) / 2;
  return {voxels.origin[0] + shift, voxels.origin[1] + shift, voxels.origin[2] + shift};
}

std::vector<api::Double3> cellCentres(const VoxelShape& voxels, double spacing, const std::vector<CellIndex>& cells) {
  const Vec3 origin = resampledOrigin(voxels, spacing);
  std::vector<api::Double3> centres;
  centres.reserve(cells.size());
  for (const CellIndex& c : resampled(cells, voxels.spacing, spacing)) {
    centres.push_back({origin[0] + c[0] * spacing, origin[1] + c[1] * spacing, origin[2] + c[2] * spacing});
  }
  return centres;
}

std::vector<api::Double3> freePositions(const ParticleStore& store, const std::vector<api::Double3>& positions,
                                        double clearance) {
  PointGrid grid(clearance);
  for (size_t i = 0; i < store.size(); ++i) grid.add(positionOf(store, i));
  std::vector<api::Double3> free;
  for (const api::Double3& p : positions) {
    if (grid.anyWithin(p, clearance)) continue;
    grid.add(p);
    free.push_back(p);
  }
  return free;
}

std::vector<uint32_t> idsInCells(const ParticleStore& store, const VoxelShape& voxels, std::vector<CellIndex> cells) {
  std::sort(cells.begin(), cells.end());
  const double hair = kOnFace * voxels.spacing;
  const Vec3 origin{voxels.origin[0] - hair, voxels.origin[1] - hair, voxels.origin[2] - hair};
  std::vector<uint32_t> ids;
  for (size_t i = 0; i < store.size(); ++i) {
    const CellIndex cell = cellAt(positionOf(store, i), origin, voxels.spacing);
    if (std::binary_search(cells.begin(), cells.end(), cell)) ids.push_back(store.id()[i]);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace ps
