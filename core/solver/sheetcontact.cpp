// SPDX-License-Identifier: Apache-2.0
#include "core/solver/sheetcontact.h"

#include "core/solver/chunks.h"
#include "core/solver/contact.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr size_t kGrain = 256;
constexpr double kDiameter = 0.9;  // spacings
constexpr uint8_t kSheet = 1, kLiquid = 2;
/// Contacts of one particle usually lean apart, so half of them may act at full strength.
constexpr int kRelaxation = 2;

}  // namespace

void SheetContact::configure(const SolverSettings& settings) {
  m_diameter = kDiameter * settings.spacing;
  // Lists hold until a particle has moved half the skin.
  m_reach = m_diameter + kSkinSpacings * settings.spacing;
}

void SheetContact::refresh(const ParticleStore& store, const Neighbours& neighbours, std::span<const uint8_t> thin) {
  m_contacts.clear();
  m_other.clear();
  if (std::find(thin.begin(), thin.end(), uint8_t{1}) == thin.end()) return;
  const size_t n = store.size();
  m_side.assign(n, 0);
  for (size_t i = 0; i < n; ++i) {
    const api::Motion motion = store.motion()[i];
    const bool sheet = motion == api::Motion::Solid && store.body()[i] < thin.size() && thin[store.body()[i]] != 0;
    m_side[i] = sheet ? kSheet : motion == api::Motion::Liquid ? kLiquid : uint8_t{0};
  }
  const api::NeighbourView view = neighbours.view();
  const float reach2 = static_cast<float>(m_reach * m_reach);
  for (uint32_t i = 0; i < n; ++i) {
    if (m_side[i] == 0) continue;
    const size_t before = m_other.size();
    for (uint32_t q = view.begin[i]; q < view.last[i]; ++q) {
      const uint32_t j = view.index[q];
      if (m_side[i] + m_side[j] != kSheet + kLiquid || m_side[j] == 0) continue;
      const api::Float4 d = store.separation(i, j);
      if (d.x * d.x + d.y * d.y + d.z * d.z < reach2) m_other.push_back(j);
    }
    if (m_other.size() == before) continue;
    m_contacts.push_back({i, static_cast<uint32_t>(before), static_cast<uint32_t>(m_other.size())});
  }
  m_count.assign(n, 0);
  m_moves.resize(m_contacts.size());
}

void SheetContact::project(ParticleStore& store) {
  if (m_contacts.empty()) return;
  api::Float4* position = store.position();
  const api::Float4* velocity = store.velocity();
  const float diameter = static_cast<float>(m_diameter);
  const auto everywhere = [&](auto&& body) {
    forChunks(m_contacts.size(), kGrain, [&](size_t first, size_t last) {
      for (size_t k = first; k < last; ++k) body(k);
    });
  };
  everywhere([&](size_t k) {
    const Contact& c = m_contacts[k];
    int touching = 0;
    for (uint32_t q = c.begin; q < c.end; ++q) {
      const api::Float4 d = store.separation(c.who, m_other[q]);
      touching += d.x * d.x + d.y * d.y + d.z * d.z < diameter * diameter ? 1 : 0;
    }
    m_count[c.who] = static_cast<uint8_t>(std::min(255, touching));
  });
  everywhere([&](size_t k) {
    const Contact& c = m_contacts[k];
    api::Float4 sum{0, 0, 0, 0};
    for (uint32_t q = c.begin; q < c.end; ++q) {
      const uint32_t j = m_other[q];
      const api::Float4 d = store.separation(c.who, j);
      const float distance = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), depth = diameter - distance;
      if (!(depth > 0) || !(distance > 0)) continue;
      const float most = static_cast<float>(std::max({int{m_count[c.who]}, int{m_count[j]}, kRelaxation}));
      const float s = velocity[c.who].w / (velocity[c.who].w + velocity[j].w) * kRelaxation / most * depth / distance;
      sum.x += s * d.x, sum.y += s * d.y, sum.z += s * d.z;
    }
    m_moves[k] = sum;
  });
  everywhere([&](size_t k) {
    api::Float4& x = position[m_contacts[k].who];
    x.x += m_moves[k].x, x.y += m_moves[k].y, x.z += m_moves[k].z;
  });
}

}  // namespace ps
