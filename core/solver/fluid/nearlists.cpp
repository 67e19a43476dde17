// SPDX-License-Identifier: Apache-2.0
#include "core/solver/fluid/nearlists.h"

#include "core/base/parallel.h"

namespace ps {

void NearLists::find(const PairLists& all, const api::Float4* points, size_t particles,
                     std::span<const uint32_t> which) {
  constexpr float kReach = 1.02f;
  m_last.resize(particles);
  m_index.resize(particles > 0 ? all.end[particles - 1] : 0);
  forChunks(which.size(), grain::kPairs, [&](size_t first, size_t last) {
    findNear(all, points, {kReach * kReach, static_cast<uint32_t>(particles)}, which.data(), first, last, m_last.data(),
             m_index.data());
  });
}

PairLists NearLists::lists(const PairLists& all) const {
  PairLists near = all;
  near.last = m_last.data();
  near.index = m_index.data();
  return near;
}

}  // namespace ps
