// SPDX-License-Identifier: Apache-2.0
#include "core/sketch/smoothing.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <unordered_map>

namespace ps {
namespace {

constexpr int kReach = 2;   // cells
constexpr int kCells = 33;  // within it, with the one in the middle
/// Cells around one that its fate may depend on: a neighbour's neighbour, and what is around that.
constexpr int kSeen = 2 + kReach;

struct CellHash {
  size_t operator()(const api::Cell& c) const {
    const uint64_t mixed = (static_cast<uint64_t>(static_cast<uint32_t>(c.x)) << 32 | static_cast<uint32_t>(c.y)) ^
                           static_cast<uint64_t>(static_cast<uint32_t>(c.z)) * 0x9E3779B97F4A7C15u;
    return static_cast<size_t>((mixed * 0xD6E8FEB86659FD93u) >> 16);
  }
};
struct CellEqual {
  bool operator()(const api::Cell& a, const api::Cell& b) const { return sameCell(a, b); }
};

/// Nothing beyond the last cell that has a number.
std::optional<api::Cell> offset(const api::Cell& cell, int x, int y, int z) {
  const auto fits = [](int64_t c) {
    return c >= std::numeric_limits<int32_t>::min() && c <= std::numeric_limits<int32_t>::max();
  };
  if (!fits(int64_t{cell.x} + x) || !fits(int64_t{cell.y} + y) || !fits(int64_t{cell.z} + z)) return std::nullopt;
  return api::Cell{cell.x + x, cell.y + y, cell.z + z};
}

/// visit(neighbour, squared distance) for each cell within a box about one, but for itself.
template <class Visit>
void forBox(const api::Cell& cell, int reach, Visit&& visit) {
  for (int z = -reach; z <= reach; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const std::optional<api::Cell> other = offset(cell, x, y, z);
        if (other && (x != 0 || y != 0 || z != 0)) visit(*other, x * x + y * y + z * z);
      }
    }
  }
}

class Smoothing {
 public:
  /// Of what is around some cells.
  Smoothing(const VoxelCanvas& sketch, std::span<const api::Cell> cells) {
    api::Cell low = cells[0], high = cells[0];
    for (const api::Cell& c : cells) {
      low = {std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z)};
      high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
    }
    const auto within = [](int64_t c, int64_t from, int64_t to) { return c >= from - kSeen && c <= to + kSeen; };
    for (const auto& [cell, palette] : sketch.entries()) {
      if (within(cell.x, low.x, high.x) && within(cell.y, low.y, high.y) && within(cell.z, low.z, high.z))
        m_palette.emplace(cell, palette);
    }
  }
  bool isFilled(const api::Cell& cell) const { return m_palette.contains(cell); }
  /// Most of what is around it is filled, or it and most of that.
  bool isDeep(const api::Cell& cell) {
    if (const auto known = m_deep.find(cell); known != m_deep.end()) return known->second;
    int filled = isFilled(cell) ? 1 : 0;
    forBox(cell, kReach, [&](const api::Cell& other, int squared) {
      if (squared <= kReach * kReach && isFilled(other)) ++filled;
    });
    return m_deep[cell] = 2 * filled > kCells;
  }
  /// It lies on what is deep, and so does all that lies on it: nothing is left hanging in the air.
  bool standsOut(const api::Cell& cell) {
    if (isDeep(cell) || !liesOnDeep(cell)) return false;
    bool carries = false;
    forBox(cell, 1, [&](const api::Cell& other, int) {
      carries = carries || (isFilled(other) && !isDeep(other) && !liesOnDeep(other));
    });
    return !carries;
  }
  /// What most of its neighbours are; of equals the lowest.
  int paletteAround(const api::Cell& cell) const {
    std::map<int, int> counts;
    forBox(cell, 1, [&](const api::Cell& other, int) {
      if (const auto found = m_palette.find(other); found != m_palette.end()) ++counts[found->second];
    });
    const auto most = std::max_element(counts.begin(), counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == counts.end() ? 0 : most->first;
  }

 private:
  bool liesOnDeep(const api::Cell& cell) {
    bool lies = false;
    forBox(cell, 1, [&](const api::Cell& other, int) { lies = lies || (isFilled(other) && isDeep(other)); });
    return lies;
  }

  std::unordered_map<api::Cell, int, CellHash, CellEqual> m_palette;
  std::unordered_map<api::Cell, bool, CellHash, CellEqual> m_deep;
};

}  // namespace

Smoothed smoothed(const VoxelCanvas& sketch, const CellSet& cells) {
  if (cells.empty()) return {};
  Smoothing smoothing(sketch, cells.cells());
  std::vector<api::Cell> emptied;
  std::map<int, std::vector<api::Cell>> filled;
  for (const api::Cell& cell : cells.cells()) {
    if (smoothing.isFilled(cell)) {
      if (smoothing.standsOut(cell)) emptied.push_back(cell);
    } else if (smoothing.isDeep(cell)) {
      filled[smoothing.paletteAround(cell)].push_back(cell);
    }
  }
  Smoothed result{CellSet(emptied), {}};
  for (const auto& [palette, some] : filled) result.filled.emplace(palette, CellSet(some));
  return result;
}

}  // namespace ps
