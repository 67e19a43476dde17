// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/fixedsurface.h"

#include "core/base/parallelarrays.h"

#include <algorithm>

namespace ps {

void FixedSurface::refresh(const ParticleStore& store, std::span<const api::Float4> noted) {
  m_now.clear();
  for (uint32_t i = 0; i < store.size(); ++i) {
    if (store.motion()[i] == api::Motion::Static) m_now.push_back(i);
  }
  bool same = m_slot.size() == store.size() && m_now == m_fixed;
  for (size_t k = 0; same && k < m_now.size(); ++k) {
    const api::Float4 &here = noted[m_now[k]], &there = m_at[k];
    same = here.x == there.x && here.y == there.y && here.z == there.z;
  }
  if (same) return;
  m_fixed.swap(m_now);
  m_at.resize(m_fixed.size());
  for (size_t k = 0; k < m_fixed.size(); ++k) m_at[k] = noted[m_fixed[k]];
  assignAll(m_slot, store.size(), uint32_t{LatticeSurface::kNone});
  m_kept.clear();
}

void FixedSurface::keep(uint32_t i, LatticeSurface::Own& own) {
  std::sort(own.particles.begin(), own.particles.begin() + own.count);
  m_slot[i] = static_cast<uint32_t>(m_kept.size());
  m_kept.push_back({own, {}, false});
}

}  // namespace ps
