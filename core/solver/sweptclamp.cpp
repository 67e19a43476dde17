// SPDX-License-Identifier: Apache-2.0
#include "core/solver/sweptclamp.h"

#include "core/solver/chunks.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

using Point = std::array<double, 3>;
constexpr double kContact = 0.75;  // spacings
constexpr int kBounces = 4;
constexpr double kMostBoxes = 1000;  ///< periods that a particle may cross in a substep and still be swept

Point pointOf(const api::Float4& p) { return {p.x, p.y, p.z}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point along(const Point& a, double t, const Point& d) { return {a[0] + t * d[0], a[1] + t * d[1], a[2] + t * d[2]}; }

}  // namespace

void SweptClamp::configure(const SolverSettings& settings) {
  m_radius = kContact * settings.spacing;
  m_cell = 1.5 * settings.spacing;
  // A list reaches a support radius; whoever has moved less than this since, without a static entry, has met none.
  m_safeWay = 0.9 * (settings.supportRatio - kContact) * settings.spacing;
}

int SweptClamp::cellOf(double coordinate, int axis) const {
  const size_t a = static_cast<size_t>(axis);
  const double t = (coordinate - m_low[a]) / m_cell;
  return t > 0 ? (t < m_cells[a] ? static_cast<int>(t) : m_cells[a] - 1) : 0;
}

void SweptClamp::refresh(const ParticleStore& store) {
  m_centers.clear();
  m_period = store.period();
  const api::Motion* motion = store.motion();
  for (size_t i = 0; i < store.size(); ++i) {
    if (motion[i] != api::Motion::Static) continue;
    const api::Double3 p = store.wrappedPosition(i);
    m_centers.push_back({p.x, p.y, p.z});
  }
  if (m_centers.empty()) return;
  m_low = m_high = m_centers[0];
  for (const Point& c : m_centers) {
    for (size_t a = 0; a < 3; ++a) m_low[a] = std::min(m_low[a], c[a]), m_high[a] = std::max(m_high[a], c[a]);
  }
  const auto cellsAlong = [&](size_t a) { return std::floor((m_high[a] - m_low[a]) / m_cell) + 1; };
  while (cellsAlong(0) * cellsAlong(1) * cellsAlong(2) > 8.0 * static_cast<double>(m_centers.size()) + 4096)
    m_cell *= 1.25;
  for (size_t a = 0; a < 3; ++a) m_cells[a] = static_cast<int>(cellsAlong(a));
  const auto cell = [&](const Point& c) {
    return static_cast<size_t>((cellOf(c[2], 2) * m_cells[1] + cellOf(c[1], 1)) * m_cells[0] + cellOf(c[0], 0));
  };
  std::stable_sort(m_centers.begin(), m_centers.end(),
                   [&](const Point& a, const Point& b) { return cell(a) < cell(b); });
  m_cellStart.assign(
      static_cast<size_t>(m_cells[0]) * static_cast<size_t>(m_cells[1]) * static_cast<size_t>(m_cells[2]) + 1, 0);
  for (const Point& c : m_centers) ++m_cellStart[cell(c) + 1];
  for (size_t k = 1; k < m_cellStart.size(); ++k) m_cellStart[k] += m_cellStart[k - 1];
}

void SweptClamp::refreshLists(const ParticleStore& store, const Neighbours& neighbours) {
  m_nearStatic.assign(store.size(), 0);
  if (m_centers.empty()) return;
  const api::NeighbourView view = neighbours.view();
  const api::Motion* motion = store.motion();
  for (size_t i = 0; i < store.size(); ++i) {
    if (motion[i] != api::Motion::Static) continue;
    for (uint32_t q = view.begin[i]; q < view.last[i]; ++q) m_nearStatic[view.index[q]] = 1;
  }
}

bool SweptClamp::maySkip(const ParticleStore& store, const Neighbours& neighbours, size_t i) const {
  if (m_nearStatic[i] != 0) return false;
  const Point built = pointOf(neighbours.built()[i]);
  for (const api::Float4& end : {store.previous()[i], store.position()[i]}) {
    const Point d = minus(pointOf(end), built);
    if (!(dot(d, d) < m_safeWay * m_safeWay)) return false;
  }
  return true;
}

SweptClamp::Hit SweptClamp::firstHit(const Point& from, const Point& way) const {
  Hit hit;
  if (!m_period.any()) {
    firstHit(from, way, hit);
    return hit;
  }
  // In pieces no longer than the box, so that each has few images.
  double boxes = 1;
  for (size_t a = 0; a < 3; ++a) boxes = std::max(boxes, std::abs(way[a]) * double{m_period.inverse(a)});
  if (!(boxes < kMostBoxes)) return hit;
  const int pieces = static_cast<int>(std::ceil(boxes));
  Point part = way;
  for (double& c : part) c /= pieces;
  for (int k = 0; k < pieces && hit.time > 1; ++k) {
    hit = {};
    imagesHit(along(from, k, part), part, hit);
    hit.time = hit.time <= 1 ? (k + hit.time) / pieces : 2;
  }
  return hit;
}

/// Tries all images of a way that meet the box of the static particles.
void SweptClamp::imagesHit(const Point& from, const Point& way, Hit& hit) const {
  std::array<int, 3> first{}, last{};
  for (size_t a = 0; a < 3; ++a) {
    if (!(m_period.length(a) > 0)) continue;
    const double least = std::min(from[a], from[a] + way[a]) - m_radius,
                 most = std::max(from[a], from[a] + way[a]) + m_radius;
    first[a] = static_cast<int>(std::ceil((least - m_high[a]) * double{m_period.inverse(a)}));
    last[a] = static_cast<int>(std::floor((most - m_low[a]) * double{m_period.inverse(a)}));
  }
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x) {
        const Point shift{x * double{m_period.length(0)}, y * double{m_period.length(1)},
                          z * double{m_period.length(2)}};
        const double before = hit.time;
        firstHit(minus(from, shift), way, hit);
        if (hit.time < before) hit.center = along(hit.center, 1, shift);
      }
    }
  }
}

/// Replaces `hit` by an earlier one.
void SweptClamp::firstHit(const Point& from, const Point& way, Hit& hit) const {
  int low[3], high[3];
  for (size_t a = 0; a < 3; ++a) {
    const double least = std::min(from[a], from[a] + way[a]) - m_radius,
                 most = std::max(from[a], from[a] + way[a]) + m_radius;
    if (!(most >= m_low[a]) || !(least <= m_high[a])) return;
    low[a] = cellOf(least, static_cast<int>(a));
    high[a] = cellOf(most, static_cast<int>(a));
  }
  const double way2 = dot(way, way);
  const auto test = [&](const Point& center) {
    const Point offset = minus(from, center);
    const double approach = dot(offset, way), gap = dot(offset, offset) - m_radius * m_radius;
    if (approach >= 0) return;
    double time = 0;
    if (gap > 0) {
      const double discriminant = approach * approach - way2 * gap;
      if (discriminant < 0) return;
      time = (-approach - std::sqrt(discriminant)) / way2;
    }
    if (time < hit.time) hit = {time, center};
  };
  for (int z = low[2]; z <= high[2]; ++z) {
    for (int y = low[1]; y <= high[1]; ++y) {
      const size_t row = static_cast<size_t>((z * m_cells[1] + y) * m_cells[0]);
      const uint32_t begin = m_cellStart[row + static_cast<size_t>(low[0])];
      const uint32_t end = m_cellStart[row + static_cast<size_t>(high[0]) + 1];
      for (uint32_t k = begin; k < end; ++k) test(m_centers[k]);
    }
  }
}

Point SweptClamp::sweep(Point from, Point way) const {
  for (int bounce = 0; bounce <= kBounces; ++bounce) {
    const Hit hit = firstHit(from, way);
    if (hit.time > 1) return along(from, 1, way);
    from = along(from, hit.time, way);
    Point normal = minus(from, hit.center);
    const double length = std::sqrt(dot(normal, normal));
    if (!(length > 0)) return from;
    for (double& c : normal) c /= length;
    for (double& c : way) c *= 1 - hit.time;
    way = along(way, -std::min(0.0, dot(way, normal)), normal);
    if (dot(way, way) < 1e-12 * m_radius * m_radius) return from;
  }
  return from;
}

void SweptClamp::apply(ParticleStore& store, const Neighbours& neighbours, const WallStage& walls,
                       std::span<const uint8_t> rigid) {
  m_held.clear();
  if (m_centers.empty()) return;
  m_held.resize(store.size(), {0, 0, 0, 0});
  api::Float4* position = store.position();
  forChunks(store.size(), 512, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      if (store.velocity()[i].w == 0 || maySkip(store, neighbours, i)) continue;
      const Point from = pointOf(store.previous()[i]), to = pointOf(position[i]);
      Point end = sweep(from, minus(to, from));
      if (end == to) continue;
      walls.clamp(end);
      const api::Float4 at{static_cast<float>(end[0]), static_cast<float>(end[1]), static_cast<float>(end[2]),
                           position[i].w};
      if (rigid[i] == 0)
        position[i] = at;
      else
        m_held[i] = {at.x - position[i].x, at.y - position[i].y, at.z - position[i].z, 0};
    }
  });
}

}  // namespace ps
