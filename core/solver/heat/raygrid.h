// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"
#include "core/particles/particlestore.h"
#include "core/solver/heat/surfacebox.h"

#include <algorithm>
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
  void span(const ParticleStore& store);
  void insert(const ParticleStore& store, uint32_t particle);
  bool begin(const Vector3& from, const Vector3& way, double longest, Walk& walk) const;
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
  int m_count[3] = {1, 1, 1};
  size_t m_stride[3] = {1, 1, 1};  ///< from cell to cell
  bool m_repeats[3] = {};
  std::span<const SurfaceBox> m_boxes;
  std::span<const uint32_t> m_boxOf;
  std::vector<uint32_t> m_first;  ///< by cell, into m_entries
  std::vector<Entry> m_entries;
};

/// Steps from cell to cell (Amanatides & Woo 1987).
template <class Passes>
RayGrid::Hit RayGrid::firstOn(const ParticleStore& store, const Vector3& from, const Vector3& way, double longest,
                              const Passes& passes) const {
  Walk walk;
  if (!begin(from, way, longest, walk)) return {};
  do {
    uint32_t e = m_first[walk.index];
    if (e == kNone) continue;
    const double end = std::min({walk.next[0], walk.next[1], walk.next[2], walk.leave});
    Hit nearest;
    for (; e != kNone; e = m_entries[e].next) {
      Hit hit;
      if (!meets(store, m_entries[e].particle, from, way, walk.at, hit)) continue;
      if (hit.distance > end + 1e-3 * m_spacing) continue;
      // Of two at one distance the lower index, whatever the order of the entries.
      const bool nearer = nearest.particle == kNone || hit.distance < nearest.distance ||
                          (hit.distance == nearest.distance && hit.particle < nearest.particle);
      if (nearer && !passes(hit)) nearest = hit;
    }
    if (nearest.particle != kNone) return nearest;
  } while (advance(walk));
  return {};
}

}  // namespace ps
