// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/walls.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {
/// Spacings: iterations move a particle by less than this, and whoever goes further is caught at the substep's end.
constexpr double kReach = 1;
constexpr size_t kGrain = 2048;
}  // namespace

void WallStage::configure(const SolverSettings& settings, const std::vector<Wall>& walls) {
  m_reach = static_cast<float>(kReach * settings.spacing);
  m_planes.clear();
  for (const Wall& w : walls) {
    m_planes.push_back({static_cast<float>(w.normal.x), static_cast<float>(w.normal.y), static_cast<float>(w.normal.z),
                        static_cast<float>(w.offset + 0.5 * settings.spacing), static_cast<float>(w.friction)});
  }
}

void WallStage::refreshLists(const ParticleStore& store, const Neighbours& neighbours, std::span<const uint8_t> rigid) {
  m_near.clear();
  m_rigid.assign(rigid.begin(), rigid.end());
  for (size_t i = 0; i < store.size(); ++i) {
    if (store.velocity()[i].w == 0 || rigid[i] != 0) continue;
    for (const Plane& p : m_planes) {
      if (p.depthOf(neighbours.built()[i]) < -m_reach) continue;
      m_near.push_back(static_cast<uint32_t>(i));
      break;
    }
  }
}

Vector3 WallStage::projectOne(const Plane& p, ParticleStore& store, size_t i, float depth) const {
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

void WallStage::projectNear(ParticleStore& store) {
  const api::Float4* position = store.position();
  m_moved.start(chunkCount(m_near.size(), kGrain));
  forChunks(m_near.size(), kGrain, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = m_near[k];
      for (const Plane& p : m_planes) {
        const float depth = p.depthOf(position[i]);
        if (depth > 0) m_moved.add(first / kGrain, store.mass()[i], projectOne(p, store, i, depth));
      }
    }
  });
  m_given.add(m_moved.total());
}

void WallStage::project(ParticleStore& store) {
  if (m_planes.empty()) return;
  const api::Float4 *position = store.position(), *velocity = store.velocity();
  m_moved.start(chunkCount(store.size(), kGrain));
  forChunks(store.size(), kGrain, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      if (velocity[i].w == 0 || m_rigid[i] != 0) continue;
      for (const Plane& p : m_planes) {
        const float depth = p.depthOf(position[i]);
        if (depth > 0) m_moved.add(first / kGrain, store.mass()[i], projectOne(p, store, i, depth));
      }
    }
  });
  m_given.add(m_moved.total());
}

void WallStage::clamp(std::array<double, 3>& position) const {
  for (const Plane& p : m_planes) {
    const double depth = double{p.offset} - (p.x * position[0] + p.y * position[1] + p.z * position[2]);
    if (!(depth > 0)) continue;
    position[0] += p.x * depth;
    position[1] += p.y * depth;
    position[2] += p.z * depth;
  }
}

}  // namespace ps
