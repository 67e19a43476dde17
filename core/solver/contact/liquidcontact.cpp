// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/liquidcontact.h"

#include "core/base/parallelarrays.h"
#include "core/solver/contact/nearneighbours.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

float squared(const api::Float4& d) { return d.x * d.x + d.y * d.y + d.z * d.z; }

}  // namespace

void LiquidContact::configure(double spacing, double skin) {
  m_diameter = static_cast<float>(m_options.diameter * spacing);
  m_reach = static_cast<float>(m_options.diameter * spacing + skin);
}

void LiquidContact::refresh(const ParticleStore& store, const Neighbours& neighbours,
                            std::span<const uint32_t> solids) {
  const size_t chunks = chunkCount(solids.size(), grain::kPairs);
  m_chunks.resize(std::max(m_chunks.size(), chunks));
  forChunks(solids.size(), grain::kPairs, [&](size_t first, size_t last) {
    findLiquids(store, neighbours, solids.subspan(first, last - first), m_chunks[first / grain::kPairs]);
  });
  m_contacts.clear();
  m_partner.clear();
  for (size_t c = 0; c < chunks; ++c) {
    const auto base = static_cast<uint32_t>(m_partner.size());
    for (const Contact& found : m_chunks[c].contacts)
      m_contacts.push_back({found.who, base + found.begin, base + found.end});
    m_partner.insert(m_partner.end(), m_chunks[c].liquids.begin(), m_chunks[c].liquids.end());
  }
  if (m_contacts.empty()) return;
  addSolidsOfLiquids(store.size());
  assignAll(m_touching, store.size(), uint8_t{0});
  m_moves.resize(m_contacts.size());
}

/// From where they were when the lists were made: nobody moves more than half the skin until the next ones.
void LiquidContact::findLiquids(const ParticleStore& store, const Neighbours& neighbours,
                                std::span<const uint32_t> solids, Chunk& chunk) const {
  chunk.contacts.clear();
  chunk.liquids.clear();
  const NearNeighbours near(store, neighbours);
  for (const uint32_t i : solids) {
    const auto before = static_cast<uint32_t>(chunk.liquids.size());
    for (const uint32_t j : near.of(i, m_reach * m_reach, chunk.near)) {
      if (store.motion()[j] == api::Motion::Liquid) chunk.liquids.push_back(j);
    }
    const auto after = static_cast<uint32_t>(chunk.liquids.size());
    if (after > before) chunk.contacts.push_back({i, before, after});
  }
}

/// The same pairs as the liquid sees them.
void LiquidContact::addSolidsOfLiquids(size_t particles) {
  const size_t solids = m_contacts.size(), pairs = m_partner.size();
  assignAll(m_next, particles, 0u);
  forChunks(pairs, grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t q = first; q < last; ++q) addOne(m_next[m_partner[q]]);
  });
  findIndices(particles, m_liquids, [&](size_t j) { return m_next[j] != 0; });
  sumUp(m_next);
  m_contacts.resize(solids + m_liquids.size());
  forChunks(m_liquids.size(), grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const uint32_t j = m_liquids[k], before = k > 0 ? m_next[m_liquids[k - 1]] : 0;
      m_contacts[solids + k] = {j, static_cast<uint32_t>(pairs) + before, static_cast<uint32_t>(pairs) + m_next[j]};
    }
  });
  forChunks(m_liquids.size(), grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) m_next[m_liquids[k]] = m_contacts[solids + k].begin;
  });
  m_partner.resize(2 * pairs);
  forChunks(solids, grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const Contact& contact = m_contacts[k];
      for (uint32_t q = contact.begin; q < contact.end; ++q) m_partner[addOne(m_next[m_partner[q]])] = contact.who;
    }
  });
  // Threads have come in any order.
  forChunks(m_liquids.size(), grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t k = solids + first; k < solids + last; ++k)
      std::sort(m_partner.data() + m_contacts[k].begin, m_partner.data() + m_contacts[k].end);
  });
}

/// m. Books what partners that do not move have moved.
api::Float4 LiquidContact::moveOf(const ParticleStore& store, const Contact& contact, size_t chunk) {
  const uint32_t i = contact.who;
  const float wi = store.velocity()[i].w;
  api::Float4 move{0, 0, 0, 0};
  if (m_touching[i] == 0 || wi == 0) return move;
  for (uint32_t q = contact.begin; q < contact.end; ++q) {
    const uint32_t j = m_partner[q];
    const api::Float4 line = store.separation(i, j);
    const float square = squared(line);
    if (!(square < m_diameter * m_diameter) || !(square > 0)) continue;
    const float length = std::sqrt(square), wj = store.velocity()[j].w;
    const auto most = static_cast<float>(std::max({int{m_touching[i]}, int{m_touching[j]}, m_options.relaxation}));
    const float by =
        wi / (wi + wj) * static_cast<float>(m_options.relaxation) * (m_diameter - length) / (length * most);
    move.x += by * line.x, move.y += by * line.y, move.z += by * line.z;
    if (wj > 0) continue;
    const Vector3 moved = double{store.mass()[i]} * Vector3{by * line.x, by * line.y, by * line.z};
    m_fromFixed.add(chunk, 1, moved);
    m_reactions->add(chunk, m_reactions->ofBody(store.body()[j]), vectorOf(store.position()[j]),
                     -m_reactions->perStep() * moved);
  }
  return move;
}

void LiquidContact::project(ParticleStore& store) {
  if (m_contacts.empty()) return;
  const auto everywhere = [&](auto&& body) {
    forChunks(m_contacts.size(), grain::kNeighbours, [&](size_t first, size_t last) {
      for (size_t k = first; k < last; ++k) body(k);
    });
  };
  everywhere([&](size_t k) {
    const Contact& contact = m_contacts[k];
    int touching = 0;
    for (uint32_t q = contact.begin; q < contact.end; ++q) {
      const float square = squared(store.separation(contact.who, m_partner[q]));
      touching += square < m_diameter * m_diameter ? 1 : 0;
    }
    m_touching[contact.who] = static_cast<uint8_t>(std::min(255, touching));
  });
  const size_t chunks = chunkCount(m_contacts.size(), grain::kNeighbours);
  m_fromFixed.start(chunks);
  m_reactions->start(chunks);
  everywhere([&](size_t k) { m_moves[k] = moveOf(store, m_contacts[k], k / grain::kNeighbours); });
  m_reactions->finish();
  everywhere([&](size_t k) {
    api::Float4& x = store.position()[m_contacts[k].who];
    x.x += m_moves[k].x, x.y += m_moves[k].y, x.z += m_moves[k].z;
  });
  m_externalImpulse.add(m_fromFixed.total());
}

}  // namespace ps
