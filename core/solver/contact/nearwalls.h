// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/solver/contact/wallplane.h"

#include <algorithm>
#include <bit>
#include <cstdint>

// Most particles are far from every wall: which ones a particle may meet is found with the neighbour lists, for whole
// runs of particles by the box around them.
namespace ps {

/// Some of a scene's walls.
class WallSet {
 public:
  void clear() { m_bits = 0; }
  void add(size_t wall) { m_bits |= bitOf(wall); }
  void add(const WallSet& others) { m_bits |= others.m_bits; }
  bool any() const { return m_bits != 0; }
  /// visit(wall), ascending, for those of `walls` walls; beyond the 31st one stands for all.
  template <class Visit>
  void forEach(size_t walls, Visit&& visit) const {
    for (uint32_t left = m_bits; left != 0; left &= left - 1) {
      const auto first = static_cast<size_t>(std::countr_zero(left));
      for (size_t wall = first, end = first < kLast ? first + 1 : walls; wall < end; ++wall) visit(wall);
    }
  }

  /// The bit of a wall, in a number that holds one of each.
  static uint32_t bitOf(size_t wall) { return 1u << std::min(wall, kLast); }
  static WallSet ofBits(uint32_t bits) {
    WallSet set;
    set.m_bits = bits;
    return set;
  }

 private:
  static constexpr size_t kLast = 31;
  uint32_t m_bits = 0;
};

/// A box along the axes.
struct PlaceBox {
  float low[3], high[3];  ///< m

  /// Around places; one that is no number has no part in it.
  static PlaceBox around(std::span<const api::Float4> places) {
    constexpr float kFar = 3e38f;
    PlaceBox box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
    for (const api::Float4& p : places) {
      box.low[0] = std::min(box.low[0], p.x), box.high[0] = std::max(box.high[0], p.x);
      box.low[1] = std::min(box.low[1], p.y), box.high[1] = std::max(box.high[1], p.y);
      box.low[2] = std::min(box.low[2], p.z), box.high[2] = std::max(box.high[2], p.z);
    }
    return box;
  }
  /// m, of the corner that is lowest over a wall.
  double leastHeight(const Plane& p) const {
    const Vector3& n = p.normal;
    return p.heightOf(
        Vector3(n.x() > 0 ? low[0] : high[0], n.y() > 0 ? low[1] : high[1], n.z() > 0 ? low[2] : high[2]));
  }
  float leastHeight(const WallPlane& p) const {
    return p.heightOf({p.x > 0 ? low[0] : high[0], p.y > 0 ? low[1] : high[1], p.z > 0 ? low[2] : high[2], 0});
  }
  /// No more than that of what is lowest over a curved wall: heights change by no more than places do.
  double leastHeight(const WallFace& face) const {
    if (!face.isCurved()) return leastHeight(face.plane());
    const Vector3 least(double{low[0]}, double{low[1]}, double{low[2]});
    const Vector3 most(double{high[0]}, double{high[1]}, double{high[2]});
    return face.heightOf(0.5 * (least + most)) - 0.5 * (most - least).norm();
  }
  float leastHeight(const WallSurface& wall) const {
    if (!wall.isCurved()) return leastHeight(wall.plane);
    constexpr float kRounding = 1e-5f;
    const float x = 0.5f * (high[0] - low[0]), y = 0.5f * (high[1] - low[1]), z = 0.5f * (high[2] - low[2]);
    const float half = std::sqrt(x * x + y * y + z * z);
    const float height = wall.heightOf({low[0] + x, low[1] + y, low[2] + z, 0});
    return height - half - kRounding * (std::abs(height) + half + wall.radius);
  }
};

/// The walls over which some of these places may be no higher than `height`, m; to rounding.
inline WallSet wallsBelow(std::span<const WallSurface> walls, float height, std::span<const api::Float4> places) {
  const PlaceBox box = PlaceBox::around(places);
  WallSet below;
  for (size_t w = 0; w < walls.size(); ++w) {
    if (!(box.leastHeight(walls[w]) > height)) below.add(w);
  }
  return below;
}

/// For each of these places the walls over which it is no higher than `reach`, m. Compared a vector at a time
/// (Highway).
void findNearWalls(std::span<const WallSurface> walls, float reach, std::span<const api::Float4> places,
                   std::span<WallSet> near);

/// Writes to `out` which of the particles which[first .. last) (nullptr: first .. last) are below any of these walls,
/// and returns how many. `out` has room for 16 more than are found. Compared a vector at a time
/// (Highway).
size_t findBelow(std::span<const WallSurface> walls, const WallSet& met, const api::Float4* places,
                 const uint32_t* which, size_t first, size_t last, uint32_t* out);

}  // namespace ps
