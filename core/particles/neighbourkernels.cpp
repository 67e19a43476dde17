// SPDX-License-Identifier: Apache-2.0
// Three cells in a row are one run of slots, so a particle's 27 cells are nine runs: each is compared a vector at a
// time and the hits are compressed into the list. The distance is computed with the same roundings on every target.
#include "core/particles/neighbourkernels.h"

#include <algorithm>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/particles/neighbourkernels.cpp"
#include "hwy/foreach_target.h"  // before highway.h
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

template <bool kPeriodic>
void searchSlotsOf(const SearchGrid& grid, size_t first, size_t last, uint32_t* counts, std::vector<uint32_t>& found) {
  const hn::CappedTag<float, 16> d;
  const hn::RebindToSigned<decltype(d)> di;
  constexpr size_t kLanes = HWY_MIN(HWY_LANES(float), 16);
  const auto iota = hn::Iota(di, 0);
  const auto radius2 = hn::Set(d, grid.radiusSquared);
  const int nx = grid.cells[0], ny = grid.cells[1], nz = grid.cells[2];
  // Known to be no part of what is written.
  const float *const gridX = grid.x, *const gridY = grid.y, *const gridZ = grid.z;
  const uint32_t* const cellStart = grid.cellStart;
  size_t used = 0, room = found.size();
  auto* out = reinterpret_cast<int32_t*>(found.data());
  for (size_t slot = first; slot < last; ++slot) {
    const int cell = static_cast<int>(grid.cell[slot]), cx = cell % nx, cy = cell / nx % ny, cz = cell / (nx * ny);
    const auto px = hn::Set(d, grid.x[slot]), py = hn::Set(d, grid.y[slot]), pz = hn::Set(d, grid.z[slot]);
    const auto self = hn::Set(di, static_cast<int32_t>(slot));
    const size_t before = used;
    const auto scan = [&](uint32_t begin, uint32_t end, float byX, float byY, float byZ, auto holdsSelf) HWY_ATTR {
      if (room < used + (end - begin) + 2 * kLanes) {
        found.resize(used + (end - begin) + 256);
        out = reinterpret_cast<int32_t*>(found.data());
        room = found.size();
      }
      for (uint32_t k = begin; k < end; k += kLanes) {
        auto dx = hn::Sub(px, hn::LoadU(d, gridX + k));
        auto dy = hn::Sub(py, hn::LoadU(d, gridY + k));
        auto dz = hn::Sub(pz, hn::LoadU(d, gridZ + k));
        if constexpr (kPeriodic) {
          dx = hn::Add(dx, hn::Set(d, byX)), dy = hn::Add(dy, hn::Set(d, byY)), dz = hn::Add(dz, hn::Set(d, byZ));
        }
        const auto d2 = hn::Add(hn::Mul(dx, dx), hn::Add(hn::Mul(dy, dy), hn::Mul(dz, dz)));
        const auto slots = hn::Add(iota, hn::Set(di, static_cast<int32_t>(k)));
        auto wanted = hn::And(hn::RebindMask(di, hn::Lt(d2, radius2)), hn::FirstN(di, end - k));
        if constexpr (decltype(holdsSelf)::value) wanted = hn::AndNot(hn::Eq(slots, self), wanted);
        // Whole vectors are stored: a store under a mask takes a hundred cycles on some machines.
        hn::StoreU(hn::Compress(slots, wanted), di, out + used);
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
      for (int z = HWY_MAX(cz - 1, 0); z <= HWY_MIN(cz + 1, nz - 1); ++z) {
        for (int y = HWY_MAX(cy - 1, 0); y <= HWY_MIN(cy + 1, ny - 1); ++y)
          scanRow(y, z, HWY_MAX(cx - 1, 0), HWY_MIN(cx + 1, nx - 1), 0, 0, 0);
      }
    }
    counts[slot - first] = static_cast<uint32_t>(used - before);
  }
}

void SearchSlots(const SearchGrid& grid, size_t first, size_t last, uint32_t* counts, std::vector<uint32_t>& found) {
  if (grid.period[0] > 0 || grid.period[1] > 0 || grid.period[2] > 0)
    searchSlotsOf<true>(grid, first, last, counts, found);
  else
    searchSlotsOf<false>(grid, first, last, counts, found);
}

}  // namespace HWY_NAMESPACE
}  // namespace ps
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ps {
HWY_EXPORT(SearchSlots);
void searchSlots(const SearchGrid& grid, size_t first, size_t last, uint32_t* counts, std::vector<uint32_t>& found) {
  HWY_DYNAMIC_DISPATCH(SearchSlots)(grid, first, last, counts, found);
}
}  // namespace ps
#endif
