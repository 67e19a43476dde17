// SPDX-License-Identifier: Apache-2.0
// Three cells in a row are one run of slots, so a particle's 27 cells are nine runs: each is compared a vector at a
// time and the hits are compressed into the list. Cells at a corner or an edge are often out of reach as a whole, and
// left out. The distance is computed with the same roundings on every target.
#include "core/particles/neighbourkernels.h"

#include <algorithm>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/particles/neighbourkernels.cpp"
#include "hwy/foreach_target.h"  // before highway.h

#include "core/particles/compressed-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ps {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Cells within one of `cell` along one axis as runs in ascending order, each with what its particles' distances need
/// added: a period where the run lies beyond a face.
struct Runs {
  int count = 0, first[2], last[2];
  float shift[2];
  void add(int a, int b, float by) {
    first[count] = a, last[count] = b, shift[count] = by;
    ++count;
  }
  Runs(int cell, int cells, float period) {
    const bool wraps = period > 0;
    if (wraps && cell == cells - 1) add(0, 0, -period);
    add(HWY_MAX(cell - 1, 0), HWY_MIN(cell + 1, cells - 1), 0);
    if (wraps && cell == 0) add(cells - 1, cells - 1, period);
  }
};

/// How far a place is from cells next to its own, as a square along each axis: of those before, of its own, of those
/// after. In an open box, where places are those that were put into cells, to the bit.
struct CellDistances {
  double square[3][3];
  /// More than the radius squared: what rounding may make of distances that are less.
  static constexpr double kMargin = 1.0001;
  CellDistances(const SearchGrid& grid, size_t slot, const int (&cell)[3]) {
    const float* const places[3] = {grid.x, grid.y, grid.z};
    for (int a = 0; a < 3; ++a) {
      const double t = (places[a][slot] - grid.low[a]) * grid.perMetre[a] - cell[a], edge = 1 / grid.perMetre[a];
      const double before = t * edge, after = (1 - t) * edge;
      square[a][0] = before * before, square[a][1] = 0, square[a][2] = after * after;
    }
  }
};

template <bool kPeriodic>
size_t searchListsOf(const SearchGrid& grid, size_t first, size_t last, const ListRoom& room) {
  const hn::CappedTag<float, 16> d;
  const hn::RebindToSigned<decltype(d)> di;
  constexpr size_t kLanes = HWY_MIN(HWY_LANES(float), 16), kPad = 16;  // Neighbours::kListPad
  const auto iota = hn::Iota(di, 0), dummies = hn::Set(di, static_cast<int32_t>(room.dummy));
  const auto radius2 = hn::Set(d, grid.radiusSquared);
  const int nx = grid.cells[0], ny = grid.cells[1], nz = grid.cells[2];
  // Known to be no part of what is written.
  const float *const gridX = grid.x, *const gridY = grid.y, *const gridZ = grid.z;
  const uint32_t *const cellStart = grid.cellStart, *const order = grid.order;
  auto* const out = reinterpret_cast<int32_t*>(room.index + room.first);
  // Where there is no more room, entries are only counted.
  int32_t beyond[kPad];
  size_t used = 0;
  for (size_t i = first; i < last; ++i) {
    const size_t slot = grid.slotOf[i];
    const int cell = static_cast<int>(grid.cell[i]), cx = cell % nx, cy = cell / nx % ny, cz = cell / (nx * ny);
    const auto px = hn::Set(d, gridX[slot]), py = hn::Set(d, gridY[slot]), pz = hn::Set(d, gridZ[slot]);
    const auto self = hn::Set(di, static_cast<int32_t>(slot));
    room.begin[i] = room.first + static_cast<uint32_t>(used);
    const auto scan = [&](uint32_t begin, uint32_t end, float byX, float byY, float byZ, auto holdsSelf) HWY_ATTR {
      for (uint32_t k = begin; k < end; k += kLanes) {
        auto dx = hn::Sub(px, hn::LoadU(d, gridX + k));
        auto dy = hn::Sub(py, hn::LoadU(d, gridY + k));
        auto dz = hn::Sub(pz, hn::LoadU(d, gridZ + k));
        if constexpr (kPeriodic) {
          dx = hn::Add(dx, hn::Set(d, byX)), dy = hn::Add(dy, hn::Set(d, byY)), dz = hn::Add(dz, hn::Set(d, byZ));
        }
        const auto d2 = hn::Add(hn::Mul(dx, dx), hn::Add(hn::Mul(dy, dy), hn::Mul(dz, dz)));
        auto wanted = hn::And(hn::RebindMask(di, hn::Lt(d2, radius2)), hn::FirstN(di, end - k));
        if constexpr (decltype(holdsSelf)::value) {
          const auto slots = hn::Add(iota, hn::Set(di, static_cast<int32_t>(k)));
          wanted = hn::AndNot(hn::Eq(slots, self), wanted);
        }
        const auto ids = hn::LoadU(di, reinterpret_cast<const int32_t*>(order + k));
        // Whole vectors are stored: a store under a mask takes a hundred cycles on some machines.
        hn::StoreU(compressed(ids, wanted), di, used + kPad <= room.count ? out + used : beyond);
        used += hn::CountTrue(di, wanted);
      }
    };
    const auto scanRow = [&](int y, int z, int from, int to, float byX, float byY, float byZ) HWY_ATTR {
      const int row = (z * ny + y) * nx;
      const uint32_t begin = cellStart[row + from], end = cellStart[row + to + 1];
      if (y == cy && z == cz)
        scan(begin, end, byX, byY, byZ, std::true_type());
      else
        scan(begin, end, byX, byY, byZ, std::false_type());
    };
    if constexpr (kPeriodic) {
      const Runs xs(cx, nx, grid.period[0]), ys(cy, ny, grid.period[1]), zs(cz, nz, grid.period[2]);
      for (int c = 0; c < zs.count; ++c) {
        for (int z = zs.first[c]; z <= zs.last[c]; ++z) {
          for (int b = 0; b < ys.count; ++b) {
            for (int y = ys.first[b]; y <= ys.last[b]; ++y) {
              for (int a = 0; a < xs.count; ++a)
                scanRow(y, z, xs.first[a], xs.last[a], xs.shift[a], ys.shift[b], zs.shift[c]);
            }
          }
        }
      }
    } else {
      const CellDistances far(grid, slot, {cx, cy, cz});
      const double reach = CellDistances::kMargin * double{grid.radiusSquared};
      for (int z = HWY_MAX(cz - 1, 0); z <= HWY_MIN(cz + 1, nz - 1); ++z) {
        for (int y = HWY_MAX(cy - 1, 0); y <= HWY_MIN(cy + 1, ny - 1); ++y) {
          const double square = far.square[1][y - cy + 1] + far.square[2][z - cz + 1];
          if (square > reach) continue;
          const int before = cx == 0 || square + far.square[0][0] > reach ? 0 : 1;
          const int after = cx == nx - 1 || square + far.square[0][2] > reach ? 0 : 1;
          scanRow(y, z, cx - before, cx + after, 0, 0, 0);
        }
      }
    }
    room.last[i] = room.first + static_cast<uint32_t>(used);
    for (size_t p = 0; p < kPad; p += kLanes)
      hn::StoreU(dummies, di, used + kPad <= room.count ? out + used + p : beyond);
    used = (used + kPad - 1) / kPad * kPad;
    room.end[i] = room.first + static_cast<uint32_t>(used);
  }
  return used + kPad;
}

size_t SearchLists(const SearchGrid& grid, size_t first, size_t last, const ListRoom& room) {
  if (grid.period[0] > 0 || grid.period[1] > 0 || grid.period[2] > 0)
    return searchListsOf<true>(grid, first, last, room);
  return searchListsOf<false>(grid, first, last, room);
}

}  // namespace HWY_NAMESPACE
}  // namespace ps
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ps {
HWY_EXPORT(SearchLists);
size_t searchLists(const SearchGrid& grid, size_t first, size_t last, const ListRoom& room) {
  return HWY_DYNAMIC_DISPATCH(SearchLists)(grid, first, last, room);
}
}  // namespace ps
#endif
