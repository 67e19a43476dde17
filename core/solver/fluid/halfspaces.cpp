// SPDX-License-Identifier: Apache-2.0
#include "core/solver/fluid/halfspaces.h"

#include "core/base/parallel.h"

namespace ps {

void HalfSpaces::configure(const SolverSettings& settings, const std::vector<Wall>& walls, const FixedShapes& shapes) {
  m_shapes = &shapes;
  m_planes.clear();
  for (const Wall& w : walls) m_planes.emplace_back(w);
  const double support = settings.spacing * settings.supportRatio;
  const bool known = m_kernel == settings.kernel && m_support == static_cast<float>(support);
  m_kernel = settings.kernel;
  m_support = static_cast<float>(support);
  m_nearest = static_cast<float>(0.5 * settings.spacing);
  m_reach = static_cast<float>(support + settings.spacing);
  if (!known) m_table = HalfSpaceTable(Kernel(settings.kernel, support));
}

void HalfSpaces::refresh(std::span<const api::Float4> built) {
  m_near.resize(built.size());
  forChunks(built.size(), grain::kParticles, [&](size_t first, size_t last) {
    findNearWalls(m_planes, m_reach, built.subspan(first, last - first),
                  std::span(m_near).subspan(first, last - first));
  });
}

const HalfSpaces::Sum* HalfSpaces::sumShapes(const api::Float4* points, const uint32_t* which, size_t first,
                                             size_t last, std::vector<Sum>& sums) const {
  if (!m_shapes->any()) return nullptr;
  bool any = false;
  for (size_t k = first; k < last; ++k) {
    sums[k] = {};
    forNearShapes(which[k], points[which[k]], [&](const WallPlane& p, const Owner&, float distance) {
      add(sums[k], p, distance);
      any = true;
    });
  }
  return any ? sums.data() : nullptr;
}

}  // namespace ps
