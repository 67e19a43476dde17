// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/walls.h"

#include "core/base/parallelarrays.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {
/// Spacings: iterations move a particle by less than this, and whoever goes further is caught at the substep's end.
constexpr double kReach = 1;
constexpr size_t kSpare = 16;
/// Least cosine between the ways out of a curved wall before a substep and after it: who has gone farther leaves by the
/// nearest way.
constexpr float kTurned = 0.9f;

struct WayOut {
  WallPlane plane;
  float depth;  ///< m, along its normal
};

/// Out of a curved wall what holds together goes along the normal where it was before the substep (SHAKE: Ryckaert et
/// al. 1977), until it is on the face. By the nearest way what slides would lose speed of first order in the substep: a
/// swing of 1.4 s 3 % of its width in each half, in substeps of 4 ms.
WayOut wayOut(const WallSurface& wall, const ParticleStore& store, size_t i, float depth) {
  const api::Float4& x = store.position()[i];
  if (!wall.isCurved() || store.motion()[i] != api::Motion::Solid) return {wall.at(x), depth};
  const WallPlane before = wall.at(store.previous()[i]);
  const api::Float4 out = wall.fromMiddle(x);
  const float upright = wall.side * (out.x * before.x + out.y * before.y + out.z * before.z);
  if (!(upright > kTurned * out.w)) return {wall.at(x), depth};
  // |out + t normal| = radius.
  const float square = depth * (out.w + wall.radius), inner = upright * upright + wall.side * square;
  if (!(inner > 0)) return {wall.at(x), depth};
  return {before, square / (upright + std::sqrt(inner))};
}
}  // namespace

void WallStage::configure(const SolverSettings& settings, const std::vector<Wall>& walls) {
  m_reach = static_cast<float>(kReach * settings.spacing);
  m_walls.clear();
  m_passable.clear();
  m_passableWall.clear();
  for (const Wall& w : walls) {
    m_walls.emplace_back(w, 0.5 * settings.spacing);
    if (w.form == WallForm::Plane || w.inside) continue;
    m_passable.push_back(faceOf(w, 0.5 * settings.spacing));
    m_passableWall.push_back(m_walls.size() - 1);
    m_narrowest = m_passable.size() == 1 ? w.radius : std::min(m_narrowest, w.radius);
  }
}

void WallStage::refreshLists(const ParticleStore& store, const Neighbours& neighbours, std::span<const uint8_t> rigid) {
  assignAll(m_rigid, rigid);
  m_nearWalls.resize(store.size());
  const std::span<const api::Float4> built = neighbours.built();
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    findNearWalls(m_walls, m_reach, built.subspan(first, last - first),
                  std::span(m_nearWalls).subspan(first, last - first));
  });
  findIndices(store.size(), m_near,
              [&](size_t i) { return m_nearWalls[i].any() && store.velocity()[i].w != 0 && rigid[i] == 0; });
}

Vector3 WallStage::projectOne(const WallPlane& p, ParticleStore& store, size_t i, float depth) const {
  api::Float4& x = store.position()[i];
  const Vector3 before = vectorOf(x);
  x.x += p.x * depth, x.y += p.y * depth, x.z += p.z * depth;
  if (store.motion()[i] == api::Motion::Solid && p.friction > 0) {
    const api::Float4& from = store.previous()[i];
    float tx = x.x - from.x, ty = x.y - from.y, tz = x.z - from.z;
    const float along = tx * p.x + ty * p.y + tz * p.z;
    tx -= along * p.x, ty -= along * p.y, tz -= along * p.z;
    const float length = std::sqrt(tx * tx + ty * ty + tz * tz);
    const float share = length < 1e-12f ? 0 : std::min(1.0f, p.friction * depth / length);
    x.x -= share * tx, x.y -= share * ty, x.z -= share * tz;
  }
  return vectorOf(x) - before;
}

void WallStage::startSums(size_t chunks) {
  m_moved.start(chunks);
  m_reactions->start(chunks);
}

void WallStage::finishSums() {
  m_externalImpulse.add(m_moved.total());
  m_reactions->finish();
}

void WallStage::projectOut(ParticleStore& store, size_t i, const WallSet& walls, size_t chunk) {
  const api::Float4* position = store.position();
  walls.forEach(m_walls.size(), [&](size_t w) {
    const float depth = -m_walls[w].heightOf(position[i]);
    if (!(depth > 0)) return;
    const WayOut out = wayOut(m_walls[w], store, i, depth);
    book(store, i, w, projectOne(out.plane, store, i, out.depth), chunk);
  });
}

void WallStage::book(const ParticleStore& store, size_t i, size_t wall, const Vector3& moved, size_t chunk) {
  const double mass = store.mass()[i];
  m_moved.add(chunk, mass, moved);
  const int slot = m_reactions->ofWall(wall);
  if (slot != Reactions::kNone)
    m_reactions->add(chunk, slot, vectorOf(store.position()[i]), -mass * m_reactions->perStep() * moved);
}

void WallStage::sweep(ParticleStore& store, size_t first, size_t last) {
  const double least = 0.25 * m_narrowest * m_narrowest;  // who goes less does not come past a wall's middle
  for (size_t i = first; i < last; ++i) {
    api::Float4& x = store.position()[i];
    const Vector3 from = vectorOf(store.previous()[i]), way = vectorOf(x) - from;
    if (!(way.squaredNorm() > least) || !(store.velocity()[i].w > 0) || m_rigid[i] != 0) continue;
    for (size_t k = 0; k < m_passable.size(); ++k) {
      const std::optional<double> met = m_passable[k].meets(from, way);
      if (!met || !(*met < 1)) continue;
      const Vector3 before = vectorOf(x);
      assignTo(x, from + *met * way);
      book(store, i, m_passableWall[k], vectorOf(x) - before, first / grain::kParticles);
    }
  }
}

void WallStage::projectNear(ParticleStore& store) {
  startSums(chunkCount(m_near.size(), grain::kNeighbours));
  forChunks(m_near.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    WallSet met;
    for (size_t k = first; k < last; ++k) met.add(m_nearWalls[m_near[k]]);
    uint32_t below[grain::kNeighbours + kSpare];
    const size_t count = findBelow(m_walls, met, store.position(), m_near.data(), first, last, below);
    for (size_t k = 0; k < count; ++k) projectOut(store, below[k], m_nearWalls[below[k]], first / grain::kNeighbours);
  });
  finishSums();
}

void WallStage::project(ParticleStore& store) {
  if (m_walls.empty()) return;
  startSums(chunkCount(store.size(), grain::kParticles));
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    if (!m_passable.empty()) sweep(store, first, last);
    const std::span<const api::Float4> places(store.position() + first, last - first);
    const WallSet met = wallsBelow(m_walls, m_reach, places);  // what is moved out of one may come to another
    if (!met.any()) return;
    uint32_t below[grain::kParticles + kSpare];
    const size_t count = findBelow(m_walls, met, store.position(), nullptr, first, last, below);
    for (size_t k = 0; k < count; ++k) {
      const uint32_t i = below[k];
      if (store.velocity()[i].w > 0 && m_rigid[i] == 0) projectOut(store, i, met, first / grain::kParticles);
    }
  });
  finishSums();
}

void WallStage::clamp(Vector3& position) const {
  for (const WallSurface& wall : m_walls) {
    const WallPlane p = wall.at(float4Of(position, 0));
    const Vector3 normal{p.x, p.y, p.z};
    const double depth = double{p.offset} - normal.dot(position);
    if (depth > 0) position += depth * normal;
  }
}

}  // namespace ps
