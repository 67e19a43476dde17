// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/neighbours.h"
#include "core/particles/particlestore.h"

#include <vector>

namespace ps {

/// Which neighbours of a particle lay within a reach when the lists were made, or lie there now: most of a list lie
/// beyond what contact asks for. Compared a vector at a time (Highway), with the same roundings on every instruction
/// set.
class NearNeighbours {
 public:
  NearNeighbours(const ParticleStore& store, const Neighbours& neighbours)
      : m_period(store.period()), m_view(neighbours.view()), m_at(neighbours.built()) {}
  /// By where they are now.
  NearNeighbours(const ParticleStore& store, const api::NeighbourView& lists)
      : m_period(store.period()), m_view(lists), m_at(store.position(), store.size()) {}
  /// Those of i nearer than the root of `square` m2, in the order of the list. Valid until `room` is used again.
  std::span<const uint32_t> of(uint32_t i, float square, std::vector<uint32_t>& room) const {
    const uint32_t first = m_view.begin[i], last = m_view.last[i];
    if (room.size() < last - first + kPadding) room.resize(2 * (last - first + kPadding));
    const size_t count = m_period.any() ? findPlainly(i, square, room.data()) : find(i, square, room.data());
    return {room.data(), count};
  }
  /// One after the other, across the faces of a period too.
  size_t findPlainly(uint32_t i, float square, uint32_t* out) const;

 private:
  static constexpr size_t kPadding = 16;  ///< written beyond the last one
  size_t find(uint32_t i, float square, uint32_t* out) const;

  const Period& m_period;
  api::NeighbourView m_view;
  std::span<const api::Float4> m_at;
};

}  // namespace ps
