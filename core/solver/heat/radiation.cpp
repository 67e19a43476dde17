// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heat/radiation.h"

#include "core/base/parallel.h"
#include "core/solver/contact/wallplane.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace ps {
namespace {

constexpr double kLift = 1.5;           ///< spacings above a centre, along its normal, at which its rays begin
constexpr double kNear = 2.5;           ///< spacings within which matter touches, and does not radiate at each other
constexpr double kPlane = 0.8;          ///< length of the mean open direction from which on a surface counts as plane
constexpr double kHalfWidth = 0.45;     ///< spacings, of a particle as rays see it: no ray slips through a layer
constexpr double kMostCells = 1 << 22;  ///< beyond it cells grow
constexpr double kFar = 1e30;
/// Mirrors that a ray follows; what is still between them then exchanges nothing.
constexpr int kMostMirrors = 64;

/// Number that spreads neighbouring ids over the directions.
uint32_t spread(uint32_t id) { return (id * 0x9e3779b1u) >> 16; }

bool exchanges(const Wall& wall) {
  return wall.heat == WallHeat::FixedTemperature || wall.heat == WallHeat::Convective;
}

struct Target {
  size_t index;  ///< of the wall; their number: none
  double distance;
};

Target nearestWall(std::span<const Wall> walls, const Vector3& from, const Vector3& way) {
  Target nearest{walls.size(), kFar};
  for (size_t w = 0; w < walls.size(); ++w) {
    const Plane plane = planeOf(walls[w]);
    const double towards = -plane.normal.dot(way);
    if (!(towards > 0)) continue;
    const double distance = std::max(0.0, plane.heightOf(from) / towards);
    if (distance < nearest.distance) nearest = {w, distance};
  }
  return nearest;
}

/// Bounds may lie in the walls themselves: a spacing more counts as within.
bool within(const Bounds& bounds, const Vector3& x, double spacing) {
  const api::Double3 &low = bounds.minimum, &high = bounds.maximum;
  const auto inside = [&](size_t axis, double at, double from, double to) {
    return bounds.periodic[axis] || (at >= from - spacing && at <= to + spacing);
  };
  return inside(0, x.x(), low.x, high.x) && inside(1, x.y(), low.y, high.y) && inside(2, x.z(), low.z, high.z);
}

/// Shares of a particle's area along each direction, and where its rays begin above its centre.
struct Fan {
  std::array<float, OpenSurface::kDirections> share{};  ///< sum 1
  Vector3 lift;                                         ///< spacings
};

Fan fanOf(uint64_t open) {
  Vector3 mean;
  for (size_t d = 0; d < OpenSurface::kDirections; ++d) {
    const auto& way = OpenSurface::directions()[d];
    if ((open >> d & 1) != 0) mean += Vector3{way[0], way[1], way[2]};
  }
  const double length = mean.norm(), count = std::popcount(open);
  const double plane = std::min(1.0, length / (kPlane * count));
  Fan fan;
  const Vector3 normal = mean.normalized();  // zero where there is none
  fan.lift = plane * kLift * normal;
  double cosines = 0;
  for (const auto& way : OpenSurface::directions())
    cosines += std::max(0.0, normal.dot(Vector3{way[0], way[1], way[2]}));
  for (size_t d = 0; d < OpenSurface::kDirections; ++d) {
    const auto& way = OpenSurface::directions()[d];
    const double cosine = std::max(0.0, normal.dot(Vector3{way[0], way[1], way[2]}));
    const double lambert = cosines > 0 ? cosine / cosines : 0, even = (open >> d & 1) != 0 ? 1 / count : 0;
    fan.share[d] = static_cast<float>(plane * lambert + (1 - plane) * even);
  }
  return fan;
}

}  // namespace

void Radiation::forget() {
  m_begin.clear();
  m_sights.clear();
}

void Radiation::trace(const ParticleStore& store, const OpenSurface& surface, std::span<const Wall> walls,
                      const Bounds& bounds, double spacing, uint64_t frame) {
  const size_t n = store.size();
  m_bounds = bounds;
  m_spacing = spacing;
  m_walls = walls.size();
  m_sky.assign(n, 0.0f);
  m_wall.assign(n * m_walls, 0.0f);
  m_emitters.clear();
  for (size_t i = 0; i < n; ++i) {
    if (surface.open(i) != 0) m_emitters.push_back(static_cast<uint32_t>(i));
  }
  m_perParticle = OpenSurface::kDirections;
  while (m_perParticle > 4 && m_perParticle * m_emitters.size() > kRays) m_perParticle /= 2;
  m_grid.build(store, spacing);
  m_met.assign(m_emitters.size() * m_perParticle, Grid::kEmpty);
  m_area.resize(m_met.size());
  forChunks(m_emitters.size(), grain::kRays,
            [&](size_t first, size_t last) { follow(store, surface, walls, spacing, frame, first, last); });
  couple(n);
}

void Radiation::follow(const ParticleStore& store, const OpenSurface& surface, std::span<const Wall> walls,
                       double spacing, uint64_t frame, size_t first, size_t last) {
  const size_t stride = OpenSurface::kDirections / m_perParticle;
  for (size_t e = first; e < last; ++e) {
    const uint32_t i = m_emitters[e];
    const Fan fan = fanOf(surface.open(i));
    const Vector3 centre = vectorOf(store.position()[i]), start = centre + spacing * fan.lift;
    const double area = surface.area(i) * static_cast<double>(stride);
    const size_t turn = (static_cast<size_t>(frame) + spread(store.id()[i])) % stride;
    for (size_t k = 0; k < m_perParticle; ++k) {
      const size_t d = turn + k * stride;
      if (!(fan.share[d] > 0)) continue;
      const auto& unit = OpenSurface::directions()[d];
      const Vector3 way{unit[0], unit[1], unit[2]};
      const auto part = static_cast<float>(area * double{fan.share[d]});
      const End end = endOf(store, walls, start, way, i);
      if (end.particle != Grid::kEmpty) {
        m_met[e * m_perParticle + k] = end.particle;
        m_area[e * m_perParticle + k] = part;
      } else if (end.sky) {
        m_sky[i] += part;
      } else if (end.wall < walls.size()) {
        m_wall[i * m_walls + end.wall] += part;
      }
    }
  }
}

Radiation::End Radiation::endOf(const ParticleStore& store, std::span<const Wall> walls, Vector3 from, Vector3 way,
                                uint32_t self) const {
  End end{Grid::kEmpty, walls.size(), false};
  for (int mirrors = 0; mirrors <= kMostMirrors; ++mirrors) {
    const Target wall = nearestWall(walls, from, way);
    end.particle = m_grid.firstOn(store, from, way, wall.distance, self);
    if (end.particle != Grid::kEmpty) return end;
    if (wall.index == walls.size()) {
      end.sky = m_grid.comesOut(way);
      return end;
    }
    if (exchanges(walls[wall.index])) {
      end.wall = wall.index;
      return end;
    }
    from += wall.distance * way;
    if (!within(m_bounds, from, m_spacing)) {
      end.sky = true;
      return end;
    }
    const Vector3 normal = vectorOf(walls[wall.index].normal);
    way -= 2 * normal.dot(way) * normal;
  }
  return end;
}

/// Lists of who sees whom from the rays, in order of rays: both ends of a ray carry the same area.
void Radiation::couple(size_t count) {
  m_begin.assign(count + 1, 0);
  for (size_t r = 0; r < m_met.size(); ++r) {
    if (m_met[r] == Grid::kEmpty) continue;
    ++m_begin[m_emitters[r / m_perParticle] + 1];
    ++m_begin[m_met[r] + 1];
  }
  for (size_t i = 0; i < count; ++i) m_begin[i + 1] += m_begin[i];
  m_sights.resize(m_begin[count]);
  m_next.assign(m_begin.begin(), m_begin.end());
  for (size_t r = 0; r < m_met.size(); ++r) {
    if (m_met[r] == Grid::kEmpty) continue;
    const uint32_t i = m_emitters[r / m_perParticle], j = m_met[r];
    m_sights[m_next[i]++] = {j, 0.5f * m_area[r]};
    m_sights[m_next[j]++] = {i, 0.5f * m_area[r]};
  }
}

void Radiation::Grid::build(const ParticleStore& store, double spacing) {
  near = kNear * spacing;
  span(store, spacing);
  cells.assign(static_cast<size_t>(count[0]) * static_cast<size_t>(count[1]) * static_cast<size_t>(count[2]), kEmpty);
  fill(store, spacing);
}

/// The box around all matter, or the period; and its cells.
void Radiation::Grid::span(const ParticleStore& store, double spacing) {
  const Period& period = store.period();
  for (size_t a = 0; a < 3; ++a) low[a] = kFar, high[a] = -kFar;
  for (size_t i = 0; i < store.size(); ++i) {
    if (store.motion()[i] == api::Motion::Gas) continue;
    const api::Float4& x = store.position()[i];
    const double at[3] = {x.x, x.y, x.z};
    for (size_t a = 0; a < 3; ++a) low[a] = std::min(low[a], at[a]), high[a] = std::max(high[a], at[a]);
  }
  double size[3], volume = 1;
  for (size_t a = 0; a < 3; ++a) {
    repeats[a] = period.length(a) > 0;
    if (repeats[a]) {
      low[a] = period.low(a);
      high[a] = low[a] + double{period.length(a)};
    } else {
      low[a] -= spacing;
      high[a] += spacing;
    }
    size[a] = std::max(high[a] - low[a], spacing);
    volume *= size[a];
  }
  double wanted = spacing;
  while (volume / (wanted * wanted * wanted) > kMostCells) wanted *= 1.26;
  for (size_t a = 0; a < 3; ++a) {
    count[a] = std::max(1, static_cast<int>(size[a] / wanted));
    edge[a] = size[a] / count[a];
  }
}

void Radiation::Grid::fill(const ParticleStore& store, double spacing) {
  for (size_t i = store.size(); i-- > 0;) {  // the lowest index comes last and stays
    if (store.motion()[i] == api::Motion::Gas) continue;
    const api::Float4& x = store.position()[i];
    const double at[3] = {x.x, x.y, x.z};
    int from[3], to[3];
    for (size_t a = 0; a < 3; ++a) {
      const double c = repeats[a] ? store.period().wrapped(at[a], a) : at[a];
      from[a] = static_cast<int>(std::floor((c - kHalfWidth * spacing - low[a]) / edge[a]));
      to[a] = static_cast<int>(std::floor((c + kHalfWidth * spacing - low[a]) / edge[a]));
      if (!repeats[a]) from[a] = std::max(from[a], 0), to[a] = std::min(to[a], count[a] - 1);
    }
    const auto turned = [&](int c, size_t a) {
      return static_cast<size_t>(repeats[a] ? (c % count[a] + count[a]) % count[a] : c);
    };
    for (int z = from[2]; z <= to[2]; ++z) {
      for (int y = from[1]; y <= to[1]; ++y) {
        for (int c = from[0]; c <= to[0]; ++c) {
          const size_t row = turned(z, 2) * static_cast<size_t>(count[1]) + turned(y, 1);
          cells[row * static_cast<size_t>(count[0]) + turned(c, 0)] = static_cast<uint32_t>(i);
        }
      }
    }
  }
}

bool Radiation::Grid::about(const ParticleStore& store, uint32_t self, uint32_t other) const {
  const api::Float4 &a = store.position()[self], &b = store.position()[other];
  float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  store.period().shorten(x, y, z);
  return double{x} * double{x} + double{y} * double{y} + double{z} * double{z} < near * near;
}

/// Steps from cell to cell (Amanatides & Woo 1987).
uint32_t Radiation::Grid::firstOn(const ParticleStore& store, const Vector3& start, const Vector3& slope,
                                  double longest, uint32_t self) const {
  double enter = 0, leave = longest;
  for (size_t a = 0; a < 3; ++a) {  // where the ray is within the box
    if (repeats[a]) continue;
    if (slope[a] == 0) {
      if (start[a] < low[a] || start[a] > high[a]) return kEmpty;
      continue;
    }
    const double one = (low[a] - start[a]) / slope[a], other = (high[a] - start[a]) / slope[a];
    enter = std::max(enter, std::min(one, other));
    leave = std::min(leave, std::max(one, other));
  }
  // Along a period that nothing closes a ray may go on for ever.
  leave = std::min(leave, 8 * (high[0] - low[0] + high[1] - low[1] + high[2] - low[2]));
  if (!(enter < leave)) return kEmpty;
  int cell[3], step[3];
  double next[3], each[3];
  for (size_t a = 0; a < 3; ++a) {
    const double at = (start[a] + enter * slope[a] - low[a]) / edge[a];
    cell[a] = static_cast<int>(std::floor(at));
    if (!repeats[a]) cell[a] = std::clamp(cell[a], 0, count[a] - 1);
    step[a] = slope[a] > 0 ? 1 : -1;
    each[a] = slope[a] == 0 ? kFar : edge[a] / std::abs(slope[a]);
    const double border = low[a] + edge[a] * (cell[a] + (step[a] > 0 ? 1 : 0));
    next[a] = slope[a] == 0 ? kFar : (border - start[a]) / slope[a];
    if (repeats[a]) cell[a] = (cell[a] % count[a] + count[a]) % count[a];
  }
  for (;;) {
    const size_t row = static_cast<size_t>(cell[2]) * static_cast<size_t>(count[1]) + static_cast<size_t>(cell[1]);
    const uint32_t met = cells[row * static_cast<size_t>(count[0]) + static_cast<size_t>(cell[0])];
    if (met != kEmpty && !about(store, self, met)) return met;
    const size_t a = next[0] <= next[1] && next[0] <= next[2] ? 0 : next[1] <= next[2] ? 1 : 2;
    if (next[a] > leave) return kEmpty;
    next[a] += each[a];
    cell[a] += step[a];
    if (repeats[a]) {
      if (cell[a] < 0) cell[a] = count[a] - 1;
      if (cell[a] >= count[a]) cell[a] = 0;
    } else if (cell[a] < 0 || cell[a] >= count[a]) {
      return kEmpty;
    }
  }
}

}  // namespace ps
