// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/solidpacking.h"

#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/math/halfspace.h"
#include "core/particles/cellgrid.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kSupport = 2;    ///< spacings
constexpr double kStep = 0.3;     ///< of a spacing squared: smaller ones need more rounds, larger ones do not settle
constexpr double kLongest = 0.1;  ///< spacings, of a move
constexpr double kBack = 1;  ///< of what is missing to half a spacing below the surface: a tip has no room for more
constexpr double kNearest = 0.7;  ///< spacings between two, whatever presses them
constexpr double kShell = 5;      ///< spacings below the surface, beyond which the lattice stays
constexpr double kMoves = 2e6, kMostRounds = 100, kLeastRounds = 12;

class Packing {
 public:
  Packing(const SolidSurface& surface, std::vector<Vector3> places, double volume)
      : m_surface(surface),
        m_places(std::move(places)),
        m_moved(m_places.size()),
        m_near(m_places.size(), {HUGE_VAL, {}}),
        m_sorted(m_places.size()),
        m_volume(volume),
        m_spacing(std::cbrt(volume)),
        m_kernel(KernelShape::WendlandC2, kSupport * m_spacing),
        m_beyond(m_kernel) {}

  std::vector<Vector3> packed() {
    findNear();
    const auto shell = std::count_if(m_near.begin(), m_near.end(), [&](const auto& near) { return inShell(near); });
    const auto rounds =
        static_cast<int>(std::clamp(kMoves / std::max(1.0, static_cast<double>(shell)), kLeastRounds, kMostRounds));
    for (int round = 0; round < rounds; ++round) {
      advance(0);
      if (round > 0) findNear();
      everywhere([&](size_t i) {
        m_moved[i] = inShell(m_near[i]) ? movedOf(i) : m_places[i];
        m_near[i].distance += (m_moved[i] - m_places[i]).norm();
      });
      std::swap(m_places, m_moved);
    }
    return std::move(m_places);
  }

 private:
  template <class Each>
  void everywhere(const Each& each) {
    forChunks(m_places.size(), grain::kNeighbours, [&](size_t first, size_t last) {
      for (size_t i = first; i < last; ++i) each(i);
    });
  }
  /// In order of cells from now on; how deep they lie, at least. Only who may feel the surface asks again.
  void findNear() {
    const auto at = [&](size_t i) { return double3Of(m_places[i]); };
    m_grid.sort(m_places.size(), kSupport * m_spacing, {}, at);
    everywhere([&](size_t slot) {
      const uint32_t i = m_grid.order()[slot];
      m_moved[slot] = m_places[i];
      const bool feels = m_near[i].distance > -m_kernel.supportRadius();
      m_sorted[slot] = feels ? m_surface.at(m_places[i]) : m_near[i];
    });
    std::swap(m_places, m_moved);
    std::swap(m_near, m_sorted);
    m_grid.reorder();
  }
  bool inShell(const SolidSurface::Near& near) const { return near.distance > -kShell * m_spacing; }
  /// Down the slope of how dense places lie, with half of space beyond the surface.
  Vector3 movedOf(size_t i) const {
    const Vector3 &place = m_places[i], &outward = m_near[i].normal;
    const double support = m_kernel.supportRadius(), least = 0.5 * m_spacing, nearest = kNearest * m_spacing,
                 depth = -m_near[i].distance;
    Vector3 apart, slope = -double{m_beyond.at(static_cast<float>(std::max(least, depth))).slope} * outward;
    m_grid.around(double3Of(place), [&](uint32_t first, uint32_t last) {
      for (uint32_t j = first; j < last; ++j) {
        const Vector3 line = place - m_places[j];
        const double square = line.squaredNorm();
        if (j == i || !(square < support * support)) continue;
        const double distance = std::sqrt(square);
        slope += m_volume * m_kernel.gradient(distance) * line;
        if (distance < nearest && distance > 0) apart += 0.5 * (nearest / distance - 1) * line;
      }
    });
    Vector3 move = -kStep * m_spacing * m_spacing * slope;
    if (const double length = move.norm(); length > kLongest * m_spacing) move *= kLongest * m_spacing / length;
    return place + move + apart - kBack * std::max(0.0, least - depth) * outward;
  }

  const SolidSurface& m_surface;
  std::vector<Vector3> m_places, m_moved;
  std::vector<SolidSurface::Near> m_near;  ///< of each place; as near to the surface as it may be by now
  std::vector<SolidSurface::Near> m_sorted;
  double m_volume, m_spacing;
  Kernel m_kernel;
  HalfSpaceTable m_beyond;
  CellGrid m_grid;
};

}  // namespace

std::vector<Vector3> packSolid(const SolidSurface& surface, std::vector<Vector3> places, double volume) {
  return Packing(surface, std::move(places), volume).packed();
}

}  // namespace ps
