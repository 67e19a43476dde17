// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/walls.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {
/// Spacings: iterations move a particle by less than this, and whoever goes further is caught at the substep's end.
constexpr double kReach = 1;
constexpr size_t kSpare = 16;
}  // namespace

void WallStage::configure(const SolverSettings& settings, const std::vector<Wall>& walls) {
  m_reach = static_cast<float>(kReach * settings.spacing);
  m_planes.clear();
  for (const Wall& w : walls) m_planes.emplace_back(w, 0.5 * settings.spacing);
}

void WallStage::refreshLists(const ParticleStore& store, const Neighbours& neighbours, std::span<const uint8_t> rigid) {
  m_rigid.assign(rigid.begin(), rigid.end());
  m_nearWalls.resize(store.size());
  const std::span<const api::Float4> built = neighbours.built();
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    findNearWalls(m_planes, m_reach, built.subspan(first, last - first),
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
  walls.forEach(m_planes.size(), [&](size_t w) {
    const float depth = -m_planes[w].heightOf(position[i]);
    if (!(depth > 0)) return;
    const double mass = store.mass()[i];
    const Vector3 moved = projectOne(m_planes[w], store, i, depth);
    m_moved.add(chunk, mass, moved);
    const int slot = m_reactions->ofWall(w);
    if (slot != Reactions::kNone)
      m_reactions->add(chunk, slot, vectorOf(position[i]), -mass * m_reactions->perStep() * moved);
  });
}

void WallStage::projectNear(ParticleStore& store) {
  startSums(chunkCount(m_near.size(), grain::kParticles));
  forChunks(m_near.size(), grain::kParticles, [&](size_t first, size_t last) {
    WallSet met;
    for (size_t k = first; k < last; ++k) met.add(m_nearWalls[m_near[k]]);
    uint32_t below[grain::kParticles + kSpare];
    const size_t count = findBelow(m_planes, met, store.position(), m_near.data(), first, last, below);
    for (size_t k = 0; k < count; ++k) projectOut(store, below[k], m_nearWalls[below[k]], first / grain::kParticles);
  });
  finishSums();
}

void WallStage::project(ParticleStore& store) {
  if (m_planes.empty()) return;
  startSums(chunkCount(store.size(), grain::kParticles));
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    const std::span<const api::Float4> places(store.position() + first, last - first);
    const WallSet met = wallsBelow(m_planes, m_reach, places);  // what is moved out of one may come to another
    if (!met.any()) return;
    uint32_t below[grain::kParticles + kSpare];
    const size_t count = findBelow(m_planes, met, store.position(), nullptr, first, last, below);
    for (size_t k = 0; k < count; ++k) {
      const uint32_t i = below[k];
      if (store.velocity()[i].w > 0 && m_rigid[i] == 0) projectOut(store, i, met, first / grain::kParticles);
    }
  });
  finishSums();
}

void WallStage::clamp(Vector3& position) const {
  for (const WallPlane& p : m_planes) {
    const Vector3 normal{p.x, p.y, p.z};
    const double depth = double{p.offset} - normal.dot(position);
    if (depth > 0) position += depth * normal;
  }
}

}  // namespace ps
