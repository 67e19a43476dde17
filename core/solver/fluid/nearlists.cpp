// SPDX-License-Identifier: Apache-2.0
#include "core/solver/fluid/nearlists.h"

#include "core/base/parallel.h"
#include "core/base/room.h"

namespace ps {

void NearLists::start(const PairLists& all, size_t particles) {
  m_last.resize(particles);
  makeRoomFor(m_pairs.partner, all.slots);
  makeRoomFor(m_pairs.value, all.slots);
}

void NearLists::find(const PairLists& all, const api::Float4* points, std::span<const uint32_t> which) {
  forChunks(which.size(), grain::kPairs,
            [&](size_t first, size_t last) { findNear(all, points, room(), which.data(), first, last); });
}

NearRoom NearLists::room() {
  constexpr float kReach = 1.02f;
  return {kReach * kReach, static_cast<uint32_t>(m_last.size()), m_last.data(), m_pairs.partner.data()};
}

PairLists NearLists::lists(const PairLists& all) const {
  PairLists near = all;
  near.last = m_last.data();
  near.index = m_pairs.partner.data();
  return near;
}

}  // namespace ps
