// SPDX-License-Identifier: Apache-2.0
#include "core/solver/fluid/halfspaces.h"

#include "core/base/parallel.h"

#include <algorithm>

namespace ps {

void HalfSpaces::configure(const SolverSettings& settings, const std::vector<Wall>& walls, const FixedShapes& shapes) {
  m_shapes = &shapes;
  m_walls.clear();
  std::vector<Bend> bends;
  for (const Wall& w : walls) {
    m_walls.emplace_back(w);
    bends.push_back(bendOf(w));
  }
  const double support = settings.spacing * settings.supportRatio;
  const bool known = m_kernel == settings.kernel && m_support == static_cast<float>(support);
  m_kernel = settings.kernel;
  m_support = static_cast<float>(support);
  m_nearest = static_cast<float>(0.5 * settings.spacing);
  m_reach = static_cast<float>(support + settings.spacing);
  const Kernel kernel(settings.kernel, support);
  if (!known) m_table = HalfSpaceTable(kernel);
  if (known && bends == m_bends) return;
  m_bends = std::move(bends);
  m_tables.clear();
  if (std::none_of(m_bends.begin(), m_bends.end(), [](const Bend& bend) { return bend.radius != 0; })) return;
  for (const Bend& bend : m_bends)
    m_tables.push_back(bend.radius != 0 ? HalfSpaceTable(kernel, bend) : HalfSpaceTable());
}

void HalfSpaces::refresh(std::span<const api::Float4> built) {
  m_near.resize(built.size());
  forChunks(built.size(), grain::kParticles, [&](size_t first, size_t last) {
    findNearWalls(m_walls, m_reach, built.subspan(first, last - first), std::span(m_near).subspan(first, last - first));
  });
}

const HalfSpaces::Sum* HalfSpaces::sumShapes(const api::Float4* points, const uint32_t* which, size_t first,
                                             size_t last, std::vector<Sum>& sums) const {
  if (!m_shapes->any()) return nullptr;
  bool any = false;
  for (size_t k = first; k < last; ++k) {
    sums[k] = {};
    forNearShapes(which[k], points[which[k]], [&](const WallPlane& p, const Owner&, float distance) {
      add(sums[k], p, m_table.at(distance));
      any = true;
    });
  }
  return any ? sums.data() : nullptr;
}

}  // namespace ps
