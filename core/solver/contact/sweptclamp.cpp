// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/sweptclamp.h"

#include "core/base/parallelarrays.h"
#include "core/solver/contact/solidcontact.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kContact = 0.75;  // spacings
constexpr int kBounces = 4;
constexpr double kAlong = 1e-3;  ///< share of a way that does not lead below a plane
constexpr float kFarAway = 1e30f;
constexpr double kSafe = 0.999;      ///< of a distance in single precision
constexpr double kMostBoxes = 1000;  ///< periods that a particle may cross in a substep and still be swept

}  // namespace

void SweptClamp::configure(const SolverSettings& settings, const FixedShapes& shapes) {
  m_shapes = &shapes;
  m_radius = kContact * settings.spacing;
  m_contact = kContactDiameter * settings.spacing;
  m_width = kFaceWidth * settings.spacing;
  m_faceTouch = std::hypot(m_radius, m_width);
  m_cell = 1.5 * settings.spacing;
  m_halfSkin = 0.5 * kSkinSpacings * settings.spacing;
  // A list reaches a support radius; whoever has moved less than this since, without a static entry, has met none.
  m_safeWay = 0.9 * (settings.supportRatio - kContactDiameter) * settings.spacing;
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
    m_unsorted.push_back({vectorOf(p), Vector3::Zero(), store.body()[i]});
    m_unsorted.back().shaped = m_shapes->isShaped(i);
    if (vectorOf(store.velocity()[i]).squaredNorm() > 0) m_longest = 1;
  }
  if (!m_unsorted.empty()) sortIntoCells();
}

void SweptClamp::sortIntoCells() {
  m_low = m_high = m_unsorted[0].center;
  for (const Obstacle& o : m_unsorted) m_low = m_low.cwiseMin(o.center), m_high = m_high.cwiseMax(o.center);
  m_grid.sort(m_unsorted.size(), m_cell, {}, [&](size_t k) { return double3Of(m_unsorted[k].center); });
  m_obstacles.resize(m_unsorted.size());
  for (size_t slot = 0; slot < m_obstacles.size(); ++slot) m_obstacles[slot] = m_unsorted[m_grid.order()[slot]];
}

void SweptClamp::refreshLists(const ParticleStore& store, const Neighbours& neighbours) {
  if (m_static.empty()) return;
  for (auto& list : m_listed) list.clear();
  for (const uint32_t i : m_static) {
    const api::Float4& v = store.velocity()[i];
    m_listed[v.x != 0 || v.y != 0 || v.z != 0 ? 1 : 0].push_back(i);
  }
  const api::NeighbourView view = neighbours.view();
  const api::Float4* at = neighbours.built().data();
  const auto between = [&](uint32_t i, uint32_t j) {
    float x = at[i].x - at[j].x, y = at[i].y - at[j].y, z = at[i].z - at[j].z;
    if (m_period.any()) m_period.shorten(x, y, z);
    return x * x + y * y + z * z;
  };
  for (size_t kind = 0; kind < 2; ++kind) assignAll(m_clearance2[kind], store.size(), kFarAway);
  if (2 * m_static.size() > store.size()) {  // fewer lists to go through: those of what moves
    assignAll(m_kind, store.size(), uint8_t{0});
    for (size_t kind = 0; kind < 2; ++kind) {
      for (const uint32_t i : m_listed[kind]) m_kind[i] = static_cast<uint8_t>(kind + 1);
    }
    for (uint32_t i = 0; i < store.size(); ++i) {
      if (m_kind[i] != 0) continue;
      std::array<float, 2> nearest{kFarAway, kFarAway};
      for (uint32_t q = view.begin[i], end = view.last[i]; q < end; ++q) {
        const uint32_t j = view.index[q];
        if (m_kind[j] == 0) continue;
        float& square = nearest[m_kind[j] - size_t{1}];
        square = std::min(square, between(i, j));
      }
      for (size_t kind = 0; kind < 2; ++kind) m_clearance2[kind][i] = nearest[kind];
    }
    return;
  }
  for (size_t kind = 0; kind < 2; ++kind) {
    float* nearest = m_clearance2[kind].data();
    for (const uint32_t i : m_listed[kind]) {
      for (uint32_t q = view.begin[i], end = view.last[i]; q < end; ++q) {
        const uint32_t j = view.index[q];
        nearest[j] = std::min(nearest[j], between(i, j));
      }
    }
  }
}

/// How far static ones are from where they were when the lists were made, before this substep and after it.
void SweptClamp::measureReach(const ParticleStore& store, const Neighbours& neighbours) {
  const std::span<const api::Float4> built = neighbours.built();
  for (size_t kind = 0; kind < 2; ++kind) {
    float most = 0;
    for (const uint32_t i : m_listed[kind]) {
      for (const api::Float4& end : {store.previous()[i], store.position()[i]}) {
        const float x = end.x - built[i].x, y = end.y - built[i].y, z = end.z - built[i].z;
        most = std::max(most, x * x + y * y + z * z);
      }
    }
    m_reach[kind] = std::sqrt(double{most});
  }
}

bool SweptClamp::maySkip(const ParticleStore& store, const Neighbours& neighbours, size_t i, bool single) const {
  // Static ones that move have gone no farther since than lists allow, and in this substep.
  double safeWay = m_longest > 0 ? m_safeWay - m_halfSkin - m_longest : m_safeWay;
  double touch = single ? m_contact : m_radius;
  if (m_longest > 0 && store.motion()[i] == api::Motion::Solid) touch = std::max(touch, m_faceTouch);
  for (size_t kind = 0; kind < 2; ++kind) {
    const auto clearance2 = double{m_clearance2[kind][i]};
    if (clearance2 < kFarAway) safeWay = std::min(safeWay, kSafe * std::sqrt(clearance2) - touch - m_reach[kind]);
  }
  if (!(safeWay > 0)) return false;
  const Vector3 built = vectorOf(neighbours.built()[i]);
  for (const api::Float4& end : {store.previous()[i], store.position()[i]}) {
    if (!((vectorOf(end) - built).squaredNorm() < safeWay * safeWay)) return false;
  }
  return true;
}

/// The box that a way must meet to meet an obstacle; all of space where it repeats itself.
SweptClamp::Reach SweptClamp::reachOfAll() const {
  Reach reach;
  if (m_period.any()) return reach;
  const double wide = m_contact + m_longest;
  for (size_t a = 0; a < 3; ++a) {  // a float more, for its rounding
    reach.low[a] = std::nextafter(static_cast<float>(m_low[a] - wide), -kFarAway);
    reach.high[a] = std::nextafter(static_cast<float>(m_high[a] + wide), kFarAway);
  }
  return reach;
}

void SweptClamp::test(const Sweep& sweep, const Obstacle& obstacle, Hit& hit) const {
  if (sweep.fluid && obstacle.shaped) return;
  const Vector3 center = obstacle.center + sweep.begin * obstacle.way, theirs = sweep.span * obstacle.way;
  const Vector3 way = sweep.way - theirs, offset = sweep.from - center;
  const double square = offset.squaredNorm();
  if (sweep.soft && !obstacle.face.isZero()) {
    const double height = offset.dot(obstacle.face);
    const bool behind = obstacle.twoSided && height < 0;
    if ((behind ? -height : height) > kFacing * std::sqrt(square))
      return testFace(sweep, obstacle, behind ? Vector3(-obstacle.face) : obstacle.face, hit);
  }
  const double approach = offset.dot(way);
  if (approach >= 0) return;
  const double radius = sweep.single && square >= m_contact * m_contact ? m_contact : m_radius;
  const double gap = square - radius * radius;
  double time = 0;
  if (gap > 0) {
    const double way2 = way.squaredNorm(), discriminant = approach * approach - way2 * gap;
    if (discriminant < 0) return;
    time = (-approach - std::sqrt(discriminant)) / way2;
  }
  if (time < hit.time) hit = {time, center + time * theirs, obstacle.way, obstacle.body};
}

void SweptClamp::testFace(const Sweep& sweep, const Obstacle& obstacle, const Vector3& normal, Hit& hit) const {
  const Vector3 center = obstacle.center + sweep.begin * obstacle.way, theirs = sweep.span * obstacle.way;
  const Vector3 way = sweep.way - theirs, offset = sweep.from - center;
  const double closing = -way.dot(normal), gap = offset.dot(normal) - m_radius;
  // Below the plane already, it goes on along it: normals of a lattice lean apart by their rounding.
  if (!(closing > (gap > 0 ? 0 : kAlong * way.norm()))) return;
  const double time = std::max(0.0, gap / closing);
  if (!(time < hit.time)) return;
  const Vector3 met = offset + time * way, beside = met - met.dot(normal) * normal;
  if (!(beside.squaredNorm() < m_width * m_width)) return;  // it meets the next one
  hit = {time, center + time * theirs, obstacle.way, obstacle.body, normal};
}

/// Replaces `hit` by an earlier one.
void SweptClamp::firstHit(const Sweep& sweep, Hit& hit) const {
  const double reach = (sweep.single ? m_contact : m_radius) + m_longest;
  int low[3], high[3];
  for (size_t a = 0; a < 3; ++a) {
    const double least = std::min(sweep.from[a], sweep.from[a] + sweep.way[a]) - reach,
                 most = std::max(sweep.from[a], sweep.from[a] + sweep.way[a]) + reach;
    if (!(most >= m_low[a]) || !(least <= m_high[a])) return;
    low[a] = m_grid.along(least, a);
    high[a] = m_grid.along(most, a);
  }
  for (int z = low[2]; z <= high[2]; ++z) {
    for (int y = low[1]; y <= high[1]; ++y) {
      const uint32_t begin = m_grid.starts()[m_grid.cell(low[0], y, z)];
      const uint32_t end = m_grid.starts()[m_grid.cell(high[0], y, z) + 1];
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
        const Vector3 shift{x * double{m_period.length(0)}, y * double{m_period.length(1)},
                            z * double{m_period.length(2)}};
        Sweep image = sweep;
        image.from -= shift;
        const double before = hit.time;
        firstHit(image, hit);
        if (hit.time < before) hit.center += shift;
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
  part.way /= pieces;
  part.span /= pieces;
  for (int k = 0; k < pieces; ++k) {
    part.from = sweep.from + k * part.way;
    part.begin = sweep.begin + k * part.span;
    hit = {};
    imagesHit(part, hit);
    if (hit.time > 1) continue;
    hit.time = (k + hit.time) / pieces;
    return hit;
  }
  return {};
}

/// Where the way ends, and the body that was met last.
Vector3 SweptClamp::sweepOf(Sweep sweep, uint32_t& body) const {
  Vector3 carrier;
  for (int bounce = 0; bounce <= kBounces; ++bounce) {
    const Hit hit = firstHit(sweep);
    carrier = hit.way;
    if (hit.time > 1) return sweep.from + sweep.way;
    body = hit.body;
    sweep.from += hit.time * sweep.way;
    Vector3 normal = hit.face.isZero() ? Vector3(sweep.from - hit.center) : hit.face;
    const double length = normal.norm();
    if (!(length > 0)) return sweep.from;
    normal /= length;
    sweep.way *= 1 - hit.time;
    sweep.begin += sweep.span * hit.time;
    sweep.span *= 1 - hit.time;
    const Vector3 apart = sweep.way - sweep.span * hit.way;
    sweep.way -= std::min(0.0, apart.dot(normal)) * normal;
    if (m_longest == 0 && sweep.way.squaredNorm() < 1e-12 * m_radius * m_radius) return sweep.from;
  }
  return sweep.from + sweep.span * carrier;  // wedged in: stays with what it met last
}

/// Some are in motion: where they are in this substep.
void SweptClamp::placeMoving(const ParticleStore& store, const SolidContact& contact) {
  m_longest = 1e-30;
  for (size_t k = 0; k < m_static.size(); ++k) {
    Obstacle& obstacle = m_unsorted[k];
    const Vector3 from = vectorOf(store.previous()[m_static[k]]);
    obstacle.center = vectorOf(m_period.wrapped(double3Of(from)));
    obstacle.way = vectorOf(store.position()[m_static[k]]) - from;
    m_longest = std::max(m_longest, obstacle.way.norm());
    const LatticeSurface::Normal face = contact.faceOf(m_static[k]);
    const bool flat = face.neighbours >= LatticeSurface::kFaceNeighbours && !obstacle.way.isZero();
    obstacle.face = flat ? face.normal : Vector3::Zero();
    obstacle.twoSided = face.twoSided;
  }
  sortIntoCells();
}

void SweptClamp::apply(ParticleStore& store, const Neighbours& neighbours, const WallStage& walls,
                       const SolidContact& contact, const StructureGraph& graph, std::span<const uint8_t> rigid) {
  if (m_static.empty()) {
    m_held.clear();
    return;
  }
  if (m_longest > 0) placeMoving(store, contact);
  measureReach(store, neighbours);
  m_held.resize(store.size());
  m_heldBy.resize(store.size());
  api::Float4* position = store.position();
  const Reach reach = reachOfAll();
  m_moved.start(chunkCount(store.size(), grain::kParticles));
  m_reactions->start(chunkCount(store.size(), grain::kParticles));
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      if (rigid[i] != 0) m_held[i] = {0, 0, 0, 0};
      if (reach.misses(store.previous()[i], position[i])) continue;  // most do, of a tool in a tank
      const bool solid = store.motion()[i] == api::Motion::Solid, tied = !graph.isFree(static_cast<uint32_t>(i));
      if (store.velocity()[i].w == 0 || maySkip(store, neighbours, i, solid && !tied)) continue;
      const Vector3 from = vectorOf(store.previous()[i]), to = vectorOf(position[i]);
      Vector3 end =
          sweepOf({from, to - from, 0, 1, solid && !tied, solid && tied && rigid[i] == 0, !solid}, m_heldBy[i]);
      if (end == to) continue;
      walls.clamp(end);
      const api::Float4 at = float4Of(end, position[i].w);
      if (rigid[i] == 0) {
        const size_t chunk = first / grain::kParticles;
        const Vector3 moved = double{store.mass()[i]} * (vectorOf(at) - vectorOf(position[i]));
        m_moved.add(chunk, 1, moved);
        m_reactions->add(chunk, m_reactions->ofBody(m_heldBy[i]), end, -m_reactions->perStep() * moved);
        position[i] = at;
      } else {
        m_held[i] = {at.x - position[i].x, at.y - position[i].y, at.z - position[i].z, 0};
      }
    }
  });
  m_externalImpulse.add(m_moved.total());
  m_reactions->finish();
}

}  // namespace ps
