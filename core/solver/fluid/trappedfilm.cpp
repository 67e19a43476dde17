// SPDX-License-Identifier: Apache-2.0
#include "core/solver/fluid/trappedfilm.h"

#include "core/base/parallelarrays.h"
#include "core/math/kernels.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// Share of the vertical corrections that a gap is spared: by a quarter it gives way below a body that is little
/// denser than the liquid and six spacings wide.
constexpr double kYield = 0.4;
/// Gaps in spacings: the thickest, and where the share begins to fade; the last layer, which stays, and where the share
/// has faded before it. Below, it would go on pumping liquid for ever.
constexpr double kThickest = 3, kFades = 2.5, kNearLast = 1.25, kLast = 0.75;
/// Excess of density, as a share of the liquid's, from which on a solid surely sinks.
constexpr double kSurely = 0.05;
/// Least cosine between the vertical and the line to what is above or below, and a floor's normal.
constexpr double kSteep = 0.55, kLevel = 0.7;

/// Marks a depth that nobody has asked for.
constexpr double kUnknown = -HUGE_VAL;

double densityOf(const ParticleStore& store, uint32_t i) {
  return double{store.mass()[i]} / double{store.position()[i].w};
}

}  // namespace

void TrappedFilm::configure(const SolverSettings& settings, const std::vector<WallSurface>& walls) {
  m_spacing = settings.spacing;
  m_support = settings.spacing * settings.supportRatio;
  const Vector3 gravity = vectorOf(settings.gravity);
  const double size = gravity.norm();
  m_up = Vector3::Zero();
  if (size > 0) m_up = -1 / size * gravity;
  m_floors.clear();
  for (const WallSurface& wall : walls) {
    if (wall.isCurved() || isLevel(wall.plane)) m_floors.push_back(wall);
  }
}

bool TrappedFilm::isLevel(const WallPlane& floor) const {
  return Vector3{floor.x, floor.y, floor.z}.dot(m_up) > kLevel;
}

/// m, by which `j` is above `i` where it is straight above enough, else 0.
double TrappedFilm::riseOf(const ParticleStore& store, std::span<const api::Float4> at, uint32_t i, uint32_t j) const {
  float x = at[j].x - at[i].x, y = at[j].y - at[i].y, z = at[j].z - at[i].z;
  store.period().shorten(x, y, z);
  const Vector3 line{x, y, z};
  const double rise = line.dot(m_up);
  if (!(rise > 0)) return 0;
  const double square = line.squaredNorm();
  return square < m_support * m_support && rise * rise > kSteep * kSteep * square ? rise : 0;
}

/// m, how far the surface of a floor or of another body is below a liquid particle; none: infinitely far.
double TrappedFilm::boundaryBelow(const ParticleStore& store, const Neighbours& neighbours, uint32_t liquid,
                                  uint32_t body) const {
  const std::span<const api::Float4> at = neighbours.built();
  double depth = HUGE_VAL;
  for (const WallSurface& floor : m_floors) {
    if (!floor.isCurved() || isLevel(floor.at(at[liquid]))) depth = std::min(depth, double{floor.heightOf(at[liquid])});
  }
  const api::NeighbourView view = neighbours.view();
  for (uint32_t q = view.begin[liquid]; q < view.last[liquid]; ++q) {
    const uint32_t j = view.index[q];
    if (!api::holds(store.motion()[j]) || store.body()[j] == body) continue;
    const double rise = riseOf(store, at, j, liquid);
    if (rise > 0) depth = std::min(depth, rise - 0.5 * m_spacing);
  }
  return depth;
}

/// By the positions that the lists were made for, so that what is found depends on nothing else.
void TrappedFilm::refresh(const ParticleStore& store, const Neighbours& neighbours, std::span<const uint32_t> solids) {
  m_liquids.clear();
  if (solids.empty() || m_up.isZero()) return;
  assignAll(m_yield, store.size(), 0.0f);
  assignAll(m_depth, store.size(), kUnknown);
  m_below.resize(store.size());
  assignAll(m_gap, store.size(), double{HUGE_VAL});
  m_inside.resize(solids.size());
  forChunks(solids.size(), grain::kPairs, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const uint32_t solid = solids[k];
      m_inside[k] = outweighsLiquid(store, neighbours, solid) && !restsOnOwn(store, neighbours, solid) ? 0 : 1;
    }
  });
  for (size_t k = 0; k < solids.size(); ++k) {
    if (m_inside[k] == 0) findBelow(store, neighbours, solids[k]);
  }
  std::erase_if(m_liquids, [&](uint32_t i) { return !(m_yield[i] > 0); });
  if (m_liquids.empty()) return;
  std::sort(m_liquids.begin(), m_liquids.end());
  const api::NeighbourView view = neighbours.view();
  assignAll(m_concerned, store.size(), uint8_t{0});
  for (const uint32_t i : m_liquids) {
    m_concerned[i] = 1;
    for (uint32_t q = view.begin[i]; q < view.last[i]; ++q) {
      const uint32_t j = view.index[q];
      if (api::holds(store.motion()[j])) m_concerned[j] = 1;
    }
  }
}

bool TrappedFilm::outweighsLiquid(const ParticleStore& store, const Neighbours& neighbours, uint32_t solid) const {
  const api::NeighbourView view = neighbours.view();
  const double density = densityOf(store, solid);
  return std::any_of(view.index + view.begin[solid], view.index + view.last[solid], [&](uint32_t j) {
    return store.motion()[j] == api::Motion::Liquid && densityOf(store, j) < density;
  });
}

bool TrappedFilm::restsOnOwn(const ParticleStore& store, const Neighbours& neighbours, uint32_t solid) const {
  const std::span<const api::Float4> at = neighbours.built();
  const api::NeighbourView view = neighbours.view();
  const uint32_t body = store.body()[solid];
  return std::any_of(view.index + view.begin[solid], view.index + view.last[solid], [&](uint32_t j) {
    return store.body()[j] == body && api::holds(store.motion()[j]) && riseOf(store, at, j, solid) > 0;
  });
}

void TrappedFilm::findBelow(const ParticleStore& store, const Neighbours& neighbours, uint32_t solid) {
  const std::span<const api::Float4> at = neighbours.built();
  const api::NeighbourView view = neighbours.view();
  const double density = densityOf(store, solid);
  for (uint32_t q = view.begin[solid]; q < view.last[solid]; ++q) {
    const uint32_t i = view.index[q];
    if (store.motion()[i] != api::Motion::Liquid || !(store.velocity()[i].w > 0)) continue;
    const double excess = density / densityOf(store, i) - 1;
    if (!(excess > 0)) continue;
    const double rise = riseOf(store, at, i, solid);
    if (!(rise > 0)) continue;
    if (m_depth[i] == kUnknown || m_below[i] != store.body()[solid]) {
      m_below[i] = store.body()[solid];
      m_depth[i] = boundaryBelow(store, neighbours, i, m_below[i]);
    }
    const double gap = (rise + m_depth[i]) / m_spacing - 0.5;
    if (!(gap < std::min(kThickest, m_gap[i]))) continue;  // what is nearest above it counts
    if (m_gap[i] == HUGE_VAL) m_liquids.push_back(i);
    m_gap[i] = gap;
    const double thin = std::clamp((kThickest - gap) / (kThickest - kFades), 0.0, 1.0),
                 thick = std::clamp((gap - kLast) / (kNearLast - kLast), 0.0, 1.0);
    m_yield[i] = static_cast<float>(kYield * std::min(1.0, excess / kSurely) * thin * thick);
  }
}

Vector3 TrappedFilm::correctionOf(const ParticleStore& store, const Pairs& pairs, uint32_t i) const {
  const bool isLiquid = m_yield[i] > 0;
  const float inverseR2 = pairs.lists.inverseSupportSquared;
  double spared = 0;
  for (uint32_t q = pairs.lists.begin[i]; q < pairs.lists.last[i]; ++q) {
    const uint32_t j = pairs.lists.index[q];
    const bool solid = api::holds(store.motion()[j]);
    if (!(m_yield[j] > 0) && !(isLiquid && solid)) continue;
    const api::Float4 &a = pairs.multipliers[i], &b = pairs.multipliers[j];  // as the iteration began
    float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    store.period().shorten(x, y, z);
    const float square = (x * x + y * y + z * z) * inverseR2;
    if (!(square < 1)) continue;
    const float yield = isLiquid && !solid ? 0.5f * (m_yield[i] + m_yield[j]) : std::max(m_yield[i], m_yield[j]);
    const float both = a.w * pairs.volumes[j] + b.w * pairs.volumes[i];
    const double slope = slopeOverQ(pairs.lists.kernel, std::sqrt(double{square})) * double{inverseR2};
    spared += double{yield * both} * slope * Vector3{x, y, z}.dot(m_up);
  }
  return -spared * m_up;
}

}  // namespace ps
