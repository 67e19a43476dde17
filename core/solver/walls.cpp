// SPDX-License-Identifier: Apache-2.0
#include "core/solver/walls.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace ps {

void WallStage::configure(const SolverSettings& settings, const std::vector<Wall>& walls) {
  m_planes.clear();
  for (const Wall& w : walls) {
    m_planes.push_back({static_cast<float>(w.normal.x), static_cast<float>(w.normal.y), static_cast<float>(w.normal.z),
                        static_cast<float>(w.offset + 0.5 * settings.spacing), static_cast<float>(w.friction)});
  }
}

void WallStage::project(ParticleStore& store) const {
  api::Float4* position = store.position();
  const api::Float4 *previous = store.previous(), *velocity = store.velocity();
  const api::Motion* motion = store.motion();
  parallelFor(store.size(), 2048, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      if (velocity[i].w == 0) continue;
      api::Float4& x = position[i];
      for (const Plane& p : m_planes) {
        const float depth = p.offset - (p.x * x.x + p.y * x.y + p.z * x.z);
        if (!(depth > 0)) continue;
        x.x += p.x * depth, x.y += p.y * depth, x.z += p.z * depth;
        if (motion[i] != api::Motion::Solid || p.friction == 0) continue;
        const api::Float4& from = previous[i];
        float tx = x.x - from.x, ty = x.y - from.y, tz = x.z - from.z;
        const float along = tx * p.x + ty * p.y + tz * p.z;
        tx -= along * p.x, ty -= along * p.y, tz -= along * p.z;
        const float length = std::sqrt(tx * tx + ty * ty + tz * tz);
        if (length < 1e-12f) continue;
        const float share = std::min(1.0f, p.friction * depth / length);
        x.x -= share * tx, x.y -= share * ty, x.z -= share * tz;
      }
    }
  });
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
