// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"
#include "core/particles/particlestore.h"
#include "core/solver/heat/surfacebox.h"

#include <algorithm>
#include <bit>
#include <span>
#include <vector>

namespace ps {

/// Cells of about a spacing through which rays step, each with the particles whose cubes reach into it. Those without
/// a surface stand in the cell of their centre alone: no ray gets to them but through cracks.
class RayGrid {
 public:
  static constexpr uint32_t kNone = 0xffffffffu;

  /// `boxes` in any order; `boxOf`: index of each particle's box, or kNone. Both must stay as they are until the next
  /// build.
  void build(const ParticleStore& store, std::span<const SurfaceBox> boxes, std::span<const uint32_t> boxOf,
             double spacing);

  struct Hit {
    uint32_t particle = kNone;
    int face = -1;  ///< of the particle's box; -1 where it has none, or where the ray began within it
    double distance = 0;
  };
  /// What the unit vector `way` meets first within `longest` m of `from`, but what `passes(Hit)`; particle kNone:
  /// nothing.
  template <class Passes>
  Hit firstOn(const ParticleStore& store, const Vector3& from, const Vector3& way, double longest,
              const Passes& passes) const;
  /// Whether a ray along `way` comes out anywhere: not between the faces of a period.
  bool comesOut(const Vector3& way) const {
    return (!m_repeats[0] && way.x() != 0) || (!m_repeats[1] && way.y() != 0) || (!m_repeats[2] && way.z() != 0);
  }

 private:
  struct Entry {
    uint32_t particle, next;
  };
  /// Where a ray stands on its way from cell to cell.
  struct Walk {
    size_t index;  ///< of the cell, which is at `cell`
    int cell[3], step[3];
    double next[3], each[3];
    double at, leave;
  };
  /// What a ray meets first in one cell; no farther than `end` m.
  template <class Passes>
  Hit firstIn(const ParticleStore& store, size_t cell, const Vector3& from, const Vector3& way, double at, double end,
              const Passes& passes) const;
  template <class Passes>
  Hit firstOnRepeating(const ParticleStore& store, const Vector3& from, const Vector3& way, Walk walk,
                       const Passes& passes) const;
  void span(const ParticleStore& store);
  void insert(const ParticleStore& store, uint32_t particle);
  bool begin(const Vector3& from, const Vector3& way, double longest, Walk& walk) const;
  /// Asked at each step of a ray: the bits of a scene's cells fit where processors reach them at once.
  bool isFilled(size_t cell) const { return (m_filled[cell / 64] >> (cell % 64) & 1) != 0; }
  /// Goes on into the next cell; false where the ray ends before or leaves the grid.
  bool advance(Walk& walk) const {
    const size_t a =
        walk.next[0] <= walk.next[1] ? (walk.next[0] <= walk.next[2] ? 0 : 2) : (walk.next[1] <= walk.next[2] ? 1 : 2);
    walk.at = walk.next[a];
    if (!(walk.at < walk.leave)) return false;
    walk.next[a] += walk.each[a];
    const int cell = walk.cell[a] + walk.step[a], count = m_count[a];
    if (cell >= 0 && cell < count) {
      walk.cell[a] = cell;
      walk.index += walk.step[a] > 0 ? m_stride[a] : 0 - m_stride[a];
      return true;
    }
    if (!m_repeats[a]) return false;
    walk.cell[a] = cell < 0 ? count - 1 : 0;
    walk.index = indexOf(walk.cell);
    return true;
  }
  size_t indexOf(const int* cell) const {
    const size_t row = static_cast<size_t>(cell[2]) * static_cast<size_t>(m_count[1]) + static_cast<size_t>(cell[1]);
    return row * static_cast<size_t>(m_count[0]) + static_cast<size_t>(cell[0]);
  }
  /// Whether and where a ray enters a particle, which lies nearest to its point at `at`.
  bool meets(const ParticleStore& store, uint32_t particle, const Vector3& from, const Vector3& way, double at,
             Hit& hit) const;

  double m_spacing = 0;                                  ///< m
  double m_low[3] = {}, m_high[3] = {}, m_edge[3] = {};  ///< m
  double m_perEdge[3] = {};                              ///< 1/m
  int m_count[3] = {1, 1, 1};
  size_t m_stride[3] = {1, 1, 1};  ///< from cell to cell
  bool m_repeats[3] = {}, m_repeating = false;
  std::span<const SurfaceBox> m_boxes;
  std::span<const uint32_t> m_boxOf;
  std::vector<uint32_t> m_first;   ///< by cell, into m_entries
  std::vector<uint64_t> m_filled;  ///< bit by cell: something lies in it
  std::vector<Entry> m_entries;
};

template <class Passes>
RayGrid::Hit RayGrid::firstIn(const ParticleStore& store, size_t cell, const Vector3& from, const Vector3& way,
                              double at, double end, const Passes& passes) const {
  Hit nearest;
  for (uint32_t e = m_first[cell]; e != kNone; e = m_entries[e].next) {
    Hit hit;
    if (!meets(store, m_entries[e].particle, from, way, at, hit)) continue;
    if (hit.distance > end + 1e-3 * m_spacing) continue;
    // Of two at one distance the lower index, whatever the order of the entries.
    const bool nearer = nearest.particle == kNone || hit.distance < nearest.distance ||
                        (hit.distance == nearest.distance && hit.particle < nearest.particle);
    if (nearer && !passes(hit)) nearest = hit;
  }
  return nearest;
}

template <class Passes>
RayGrid::Hit RayGrid::firstOnRepeating(const ParticleStore& store, const Vector3& from, const Vector3& way, Walk walk,
                                       const Passes& passes) const {
  do {
    if (!isFilled(walk.index)) continue;
    const double end = std::min({walk.next[0], walk.next[1], walk.next[2], walk.leave});
    const Hit hit = firstIn(store, walk.index, from, way, walk.at, end, passes);
    if (hit.particle != kNone) return hit;
  } while (advance(walk));
  return {};
}

/// Steps from cell to cell (Amanatides & Woo 1987). Which face a ray leaves a cell by is as good as random: without
/// branches on it a step takes a third of the time.
template <class Passes>
RayGrid::Hit RayGrid::firstOn(const ParticleStore& store, const Vector3& from, const Vector3& way, double longest,
                              const Passes& passes) const {
  Walk walk;
  if (!begin(from, way, longest, walk)) return {};
  if (m_repeating) return firstOnRepeating(store, from, way, walk, passes);
  const auto left = [&](size_t a) { return walk.step[a] > 0 ? m_count[a] - 1 - walk.cell[a] : walk.cell[a]; };
  const auto stride = [&](size_t a) { return walk.step[a] > 0 ? m_stride[a] : 0 - m_stride[a]; };
  const auto where = [](bool takes, double value) {
    return std::bit_cast<double>(std::bit_cast<uint64_t>(value) & (0 - uint64_t{takes}));
  };
  int leftX = left(0), leftY = left(1), leftZ = left(2);  // cells until the ray is out
  double x = walk.next[0], y = walk.next[1], z = walk.next[2], at = walk.at;
  const double eachX = walk.each[0], eachY = walk.each[1], eachZ = walk.each[2], leave = walk.leave;
  const size_t strideX = stride(0), strideY = stride(1), strideZ = stride(2);
  for (size_t cell = walk.index;;) {
    const double next = std::min(std::min(x, y), z);
    if (isFilled(cell)) {
      const Hit hit = firstIn(store, cell, from, way, at, std::min(next, leave), passes);
      if (hit.particle != kNone) return hit;
    }
    at = next;
    if (!(at < leave)) return {};
    const bool alongX = x == at, alongY = !alongX & (y == at), alongZ = !(alongX | alongY);
    x += where(alongX, eachX), y += where(alongY, eachY), z += where(alongZ, eachZ);
    leftX -= alongX, leftY -= alongY, leftZ -= alongZ;
    if ((leftX | leftY | leftZ) < 0) return {};
    cell += (strideX & (0 - size_t{alongX})) + (strideY & (0 - size_t{alongY})) + (strideZ & (0 - size_t{alongZ}));
  }
}

}  // namespace ps
