// SPDX-License-Identifier: Apache-2.0
#include "core/solver/wetcontact.h"

#include "core/solver/chunks.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {
constexpr double kDistance = 0.76;  // spacings; wider, and ice sinks: at 0.8 wholly
constexpr size_t kGrain = 256;
}  // namespace

void WetContact::configure(double spacing, double skin) {
  m_distance = static_cast<float>(kDistance * spacing);
  m_reach = static_cast<float>(kDistance * spacing + skin);
}

void WetContact::refreshLists(const ParticleStore& store, const Neighbours& neighbours, std::span<const uint32_t> wet) {
  m_who.clear();
  m_partner.clear();
  m_begin.assign(1, 0);
  m_contacts.assign(store.size() + 1, 0);
  for (const uint32_t i : wet) findPartners(store, neighbours, i, api::Motion::Liquid);
  m_found = m_partner;  // liquid, each as often as it is near a solid
  std::sort(m_found.begin(), m_found.end());
  m_found.erase(std::unique(m_found.begin(), m_found.end()), m_found.end());
  for (const uint32_t j : m_found) findPartners(store, neighbours, j, api::Motion::Solid);
  m_move.resize(m_who.size());
}

/// Those that may come too near before the lists are renewed: nobody moves more than half the skin until then.
void WetContact::findPartners(const ParticleStore& store, const Neighbours& neighbours, uint32_t i,
                              api::Motion wanted) {
  const api::NeighbourView view = neighbours.view();
  const std::span<const api::Float4> at = neighbours.built();
  for (uint32_t q = view.begin[i]; q < view.last[i]; ++q) {
    const uint32_t j = view.index[q];
    if (store.motion()[j] != wanted) continue;
    float x = at[i].x - at[j].x, y = at[i].y - at[j].y, z = at[i].z - at[j].z;
    store.period().shorten(x, y, z);
    if (x * x + y * y + z * z < m_reach * m_reach) m_partner.push_back(j);
  }
  if (m_partner.size() == m_begin.back()) return;
  m_who.push_back(i);
  m_begin.push_back(m_partner.size());
}

/// visit(j, line from j to i, its length) for each partner of the k-th particle that is too near.
template <class Visit>
void WetContact::forPartners(const ParticleStore& store, size_t k, Visit&& visit) const {
  for (size_t q = m_begin[k]; q < m_begin[k + 1]; ++q) {
    const uint32_t j = m_partner[q];
    const api::Float4 line = store.separation(m_who[k], j);
    const float square = line.x * line.x + line.y * line.y + line.z * line.z;
    if (square < m_distance * m_distance && square > 0) visit(j, line, std::sqrt(square));
  }
}

void WetContact::project(ParticleStore& store) {
  if (m_partner.empty()) return;
  forChunks(m_who.size(), kGrain, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      size_t count = 0;
      forPartners(store, k, [&](uint32_t, const api::Float4&, float) { ++count; });
      m_contacts[m_who[k]] = static_cast<uint8_t>(std::min<size_t>(255, count));
    }
  });
  forChunks(m_who.size(), kGrain, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = m_who[k];
      const float wi = store.velocity()[i].w;
      api::Float4 move{0, 0, 0, 0};
      if (m_contacts[i] > 0) {
        forPartners(store, k, [&](uint32_t j, const api::Float4& line, float length) {
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
