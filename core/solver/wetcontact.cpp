// SPDX-License-Identifier: Apache-2.0
#include "core/solver/wetcontact.h"

#include "core/solver/chunks.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {
constexpr double kDistance = 0.8;  // spacings
constexpr size_t kGrain = 256;
}  // namespace

void WetContact::configure(double spacing) { m_distance = static_cast<float>(kDistance * spacing); }

void WetContact::refreshLists(const ParticleStore& store, const Neighbours& neighbours, std::span<const uint32_t> wet) {
  m_who.assign(wet.begin(), wet.end());
  m_isWho.assign(store.size(), 0);
  m_contacts.assign(store.size() + 1, 0);
  const api::NeighbourView view = neighbours.view();
  for (const uint32_t i : wet) {
    for (uint32_t q = view.begin[i]; q < view.last[i]; ++q) {
      const uint32_t j = view.index[q];
      if (store.motion()[j] != api::Motion::Liquid || m_isWho[j] != 0) continue;
      m_isWho[j] = 1;
      m_who.push_back(j);
    }
  }
  m_move.resize(m_who.size());
}

/// visit(j, line from j to i, its length) for each partner of i that is too near.
template <class Visit>
void WetContact::forPartners(const ParticleStore& store, const api::NeighbourView& view, uint32_t i,
                             Visit&& visit) const {
  const api::Motion wanted = store.motion()[i] == api::Motion::Liquid ? api::Motion::Solid : api::Motion::Liquid;
  for (uint32_t q = view.begin[i]; q < view.last[i]; ++q) {
    const uint32_t j = view.index[q];
    if (store.motion()[j] != wanted) continue;
    const api::Float4 line = store.separation(i, j);
    const float square = line.x * line.x + line.y * line.y + line.z * line.z;
    if (square < m_distance * m_distance && square > 0) visit(j, line, std::sqrt(square));
  }
}

void WetContact::project(ParticleStore& store, const Neighbours& neighbours) {
  if (m_who.empty()) return;
  const api::NeighbourView view = neighbours.view();
  forChunks(m_who.size(), kGrain, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      size_t count = 0;
      forPartners(store, view, m_who[k], [&](uint32_t, const api::Float4&, float) { ++count; });
      m_contacts[m_who[k]] = static_cast<uint8_t>(std::min<size_t>(255, count));
    }
  });
  forChunks(m_who.size(), kGrain, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = m_who[k];
      const float wi = store.velocity()[i].w;
      api::Float4 move{0, 0, 0, 0};
      if (m_contacts[i] > 0) {
        forPartners(store, view, i, [&](uint32_t j, const api::Float4& line, float length) {
          const float most = static_cast<float>(std::max(m_contacts[i], m_contacts[j]));
          const float by = wi / (wi + store.velocity()[j].w) * (m_distance - length) / (length * most);
          move.x += by * line.x, move.y += by * line.y, move.z += by * line.z;
        });
      }
      m_move[k] = move;
    }
  });
  for (size_t k = 0; k < m_who.size(); ++k) {
    api::Float4& x = store.position()[m_who[k]];
    x.x += m_move[k].x, x.y += m_move[k].y, x.z += m_move[k].z;
  }
}

}  // namespace ps
