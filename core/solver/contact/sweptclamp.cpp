// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/sweptclamp.h"

#include "core/base/parallel.h"
#include "core/solver/contact/solidcontact.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

using Point = std::array<double, 3>;
constexpr double kContact = 0.75;  // spacings
constexpr int kBounces = 4;
constexpr size_t kGrain = 512;
constexpr double kMostBoxes = 1000;  ///< periods that a particle may cross in a substep and still be swept

Point pointOf(const api::Float4& p) { return {p.x, p.y, p.z}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point along(const Point& a, double t, const Point& d) { return {a[0] + t * d[0], a[1] + t * d[1], a[2] + t * d[2]}; }

}  // namespace

void SweptClamp::configure(const SolverSettings& settings) {
  m_radius = kContact * settings.spacing;
  m_contact = kContactDiameter * settings.spacing;
  m_leastCell = 1.5 * settings.spacing;
  m_halfSkin = 0.5 * kSkinSpacings * settings.spacing;
  // A list reaches a support radius; whoever has moved less than this since, without a static entry, has met none.
  m_safeWay = 0.9 * (settings.supportRatio - kContactDiameter) * settings.spacing;
}

int SweptClamp::cellOf(double coordinate, int axis) const {
  const size_t a = static_cast<size_t>(axis);
  const double t = (coordinate - m_low[a]) / m_cell;
  return t > 0 ? (t < m_cells[a] ? static_cast<int>(t) : m_cells[a] - 1) : 0;
}

void SweptClamp::refresh(const ParticleStore& store, bool led) {
  m_period = store.period();
  m_static.clear();
  m_unsorted.clear();
  m_obstacles.clear();
  m_longest = led ? 1 : 0;  // known when they have moved
  for (uint32_t i = 0; i < store.size(); ++i) {
    if (store.motion()[i] != api::Motion::Static) continue;
    const api::Double3 p = store.wrappedPosition(i);
    m_static.push_back(i);
    m_unsorted.push_back({{p.x, p.y, p.z}, {}});
    const Point speed = pointOf(store.velocity()[i]);
    if (dot(speed, speed) > 0) m_longest = 1;
  }
  if (!m_unsorted.empty()) sortIntoCells();
}

void SweptClamp::sortIntoCells() {
  m_low = m_high = m_unsorted[0].center;
  for (const Obstacle& o : m_unsorted) {
    for (size_t a = 0; a < 3; ++a)
      m_low[a] = std::min(m_low[a], o.center[a]), m_high[a] = std::max(m_high[a], o.center[a]);
  }
  m_cell = m_leastCell;
  const auto cellsAlong = [&](size_t a) { return std::floor((m_high[a] - m_low[a]) / m_cell) + 1; };
  while (cellsAlong(0) * cellsAlong(1) * cellsAlong(2) > 8.0 * static_cast<double>(m_unsorted.size()) + 4096)
    m_cell *= 1.25;
  for (size_t a = 0; a < 3; ++a) m_cells[a] = static_cast<int>(cellsAlong(a));
  m_cellStart.assign(
      static_cast<size_t>(m_cells[0]) * static_cast<size_t>(m_cells[1]) * static_cast<size_t>(m_cells[2]) + 1, 0);
  m_cellOf.resize(m_unsorted.size());
  for (size_t k = 0; k < m_unsorted.size(); ++k) {
    const Point& c = m_unsorted[k].center;
    m_cellOf[k] =
        static_cast<uint32_t>((cellOf(c[2], 2) * m_cells[1] + cellOf(c[1], 1)) * m_cells[0] + cellOf(c[0], 0));
    ++m_cellStart[m_cellOf[k] + 1];
  }
  for (size_t c = 1; c < m_cellStart.size(); ++c) m_cellStart[c] += m_cellStart[c - 1];
  m_obstacles.resize(m_unsorted.size());
  for (size_t k = 0; k < m_unsorted.size(); ++k) m_obstacles[m_cellStart[m_cellOf[k]]++] = m_unsorted[k];
  for (size_t c = m_cellStart.size() - 1; c > 0; --c) m_cellStart[c] = m_cellStart[c - 1];
  m_cellStart[0] = 0;
}

void SweptClamp::refreshLists(const ParticleStore& store, const Neighbours& neighbours) {
  m_nearStatic.assign(store.size(), 0);
  if (m_static.empty()) return;
  const api::NeighbourView view = neighbours.view();
  for (const uint32_t i : m_static) {
    for (uint32_t q = view.begin[i]; q < view.last[i]; ++q) m_nearStatic[view.index[q]] = 1;
  }
}

bool SweptClamp::maySkip(const ParticleStore& store, const Neighbours& neighbours, size_t i) const {
  if (m_nearStatic[i] != 0) return false;
  // Static ones that move have gone no farther since than lists allow, and in this substep.
  const double safeWay = m_longest > 0 ? m_safeWay - m_halfSkin - m_longest : m_safeWay;
  const Point built = pointOf(neighbours.built()[i]);
  for (const api::Float4& end : {store.previous()[i], store.position()[i]}) {
    const Point d = minus(pointOf(end), built);
    if (!(safeWay > 0 && dot(d, d) < safeWay * safeWay)) return false;
  }
  return true;
}

void SweptClamp::test(const Sweep& sweep, const Obstacle& obstacle, Hit& hit) const {
  Point way = sweep.way, center = along(obstacle.center, sweep.begin, obstacle.way), theirs{};
  if (m_longest > 0) {
    for (size_t a = 0; a < 3; ++a) theirs[a] = sweep.span * obstacle.way[a];
    way = minus(way, theirs);
  }
  const Point offset = minus(sweep.from, center);
  const double approach = dot(offset, way), square = dot(offset, offset);
  if (approach >= 0) return;
  const double radius = sweep.single && square >= m_contact * m_contact ? m_contact : m_radius;
  const double gap = square - radius * radius;
  double time = 0;
  if (gap > 0) {
    const double way2 = dot(way, way), discriminant = approach * approach - way2 * gap;
    if (discriminant < 0) return;
    time = (-approach - std::sqrt(discriminant)) / way2;
  }
  if (time < hit.time) hit = {time, along(center, time, theirs), obstacle.way};
}

/// Replaces `hit` by an earlier one.
void SweptClamp::firstHit(const Sweep& sweep, Hit& hit) const {
  const double reach = (sweep.single ? m_contact : m_radius) + m_longest;
  int low[3], high[3];
  for (size_t a = 0; a < 3; ++a) {
    const double least = std::min(sweep.from[a], sweep.from[a] + sweep.way[a]) - reach,
                 most = std::max(sweep.from[a], sweep.from[a] + sweep.way[a]) + reach;
    if (!(most >= m_low[a]) || !(least <= m_high[a])) return;
    low[a] = cellOf(least, static_cast<int>(a));
    high[a] = cellOf(most, static_cast<int>(a));
  }
  for (int z = low[2]; z <= high[2]; ++z) {
    for (int y = low[1]; y <= high[1]; ++y) {
      const size_t row = static_cast<size_t>((z * m_cells[1] + y) * m_cells[0]);
      const uint32_t begin = m_cellStart[row + static_cast<size_t>(low[0])];
      const uint32_t end = m_cellStart[row + static_cast<size_t>(high[0]) + 1];
      for (uint32_t k = begin; k < end; ++k) test(sweep, m_obstacles[k], hit);
    }
  }
}

/// Tries all images of a way that meet the box of the static particles.
void SweptClamp::imagesHit(const Sweep& sweep, Hit& hit) const {
  const double reach = m_contact + m_longest;
  std::array<int, 3> first{}, last{};
  for (size_t a = 0; a < 3; ++a) {
    if (!(m_period.length(a) > 0)) continue;
    const double least = std::min(sweep.from[a], sweep.from[a] + sweep.way[a]) - reach,
                 most = std::max(sweep.from[a], sweep.from[a] + sweep.way[a]) + reach;
    first[a] = static_cast<int>(std::ceil((least - m_high[a]) * double{m_period.inverse(a)}));
    last[a] = static_cast<int>(std::floor((most - m_low[a]) * double{m_period.inverse(a)}));
  }
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x) {
        const Point shift{x * double{m_period.length(0)}, y * double{m_period.length(1)},
                          z * double{m_period.length(2)}};
        Sweep image = sweep;
        image.from = minus(sweep.from, shift);
        const double before = hit.time;
        firstHit(image, hit);
        if (hit.time < before) hit.center = along(hit.center, 1, shift);
      }
    }
  }
}

SweptClamp::Hit SweptClamp::firstHit(const Sweep& sweep) const {
  Hit hit;
  if (!m_period.any()) {
    firstHit(sweep, hit);
    return hit;
  }
  // In pieces no longer than the box, so that each has few images.
  double boxes = 1;
  for (size_t a = 0; a < 3; ++a) boxes = std::max(boxes, std::abs(sweep.way[a]) * double{m_period.inverse(a)});
  if (!(boxes < kMostBoxes)) return hit;
  const int pieces = static_cast<int>(std::ceil(boxes));
  Sweep part = sweep;
  for (double& c : part.way) c /= pieces;
  part.span /= pieces;
  for (int k = 0; k < pieces; ++k) {
    part.from = along(sweep.from, k, part.way);
    part.begin = sweep.begin + k * part.span;
    hit = {};
    imagesHit(part, hit);
    if (hit.time > 1) continue;
    hit.time = (k + hit.time) / pieces;
    return hit;
  }
  return {};
}

Point SweptClamp::sweepOf(Sweep sweep) const {
  Point carrier{};
  for (int bounce = 0; bounce <= kBounces; ++bounce) {
    const Hit hit = firstHit(sweep);
    carrier = hit.way;
    if (hit.time > 1) return along(sweep.from, 1, sweep.way);
    sweep.from = along(sweep.from, hit.time, sweep.way);
    Point normal = minus(sweep.from, hit.center);
    const double length = std::sqrt(dot(normal, normal));
    if (!(length > 0)) return sweep.from;
    for (double& c : normal) c /= length;
    for (double& c : sweep.way) c *= 1 - hit.time;
    sweep.begin += sweep.span * hit.time;
    sweep.span *= 1 - hit.time;
    const Point apart = along(sweep.way, -sweep.span, hit.way);
    sweep.way = along(sweep.way, -std::min(0.0, dot(apart, normal)), normal);
    if (m_longest == 0 && dot(sweep.way, sweep.way) < 1e-12 * m_radius * m_radius) return sweep.from;
  }
  return along(sweep.from, sweep.span, carrier);  // wedged in: stays with what it met last
}

void SweptClamp::apply(ParticleStore& store, const Neighbours& neighbours, const WallStage& walls,
                       const StructureGraph& graph, std::span<const uint8_t> rigid) {
  m_held.clear();
  if (m_static.empty()) return;
  if (m_longest > 0) {  // some move: where they are in this substep
    m_longest = 1e-30;
    for (size_t k = 0; k < m_static.size(); ++k) {
      const Point from = pointOf(store.previous()[m_static[k]]);
      const api::Double3 p = m_period.wrapped(api::Double3{from[0], from[1], from[2]});
      m_unsorted[k] = {{p.x, p.y, p.z}, minus(pointOf(store.position()[m_static[k]]), from)};
      m_longest = std::max(m_longest, std::sqrt(dot(m_unsorted[k].way, m_unsorted[k].way)));
    }
    sortIntoCells();
  }
  m_held.resize(store.size(), {0, 0, 0, 0});
  api::Float4* position = store.position();
  m_moved.start(chunkCount(store.size(), kGrain));
  forChunks(store.size(), kGrain, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      if (store.velocity()[i].w == 0 || maySkip(store, neighbours, i)) continue;
      const Point from = pointOf(store.previous()[i]), to = pointOf(position[i]);
      const bool single = store.motion()[i] == api::Motion::Solid && graph.isFree(static_cast<uint32_t>(i));
      Point end = sweepOf({from, minus(to, from), 0, 1, single});
      if (end == to) continue;
      walls.clamp(end);
      const api::Float4 at{static_cast<float>(end[0]), static_cast<float>(end[1]), static_cast<float>(end[2]),
                           position[i].w};
      if (rigid[i] == 0) {
        m_moved.add(first / kGrain, store.mass()[i], vectorOf(at) - vectorOf(position[i]));
        position[i] = at;
      } else {
        m_held[i] = {at.x - position[i].x, at.y - position[i].y, at.z - position[i].z, 0};
      }
    }
  });
  m_given.add(m_moved.total());
}

}  // namespace ps
