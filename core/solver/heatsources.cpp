// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heatsources.h"

#include <algorithm>

namespace ps {
namespace {

constexpr double kColdest = 1;  // K

}  // namespace

bool BodyHeating::takesPart(const ParticleStore& store, size_t i) const {
  const uint32_t body = store.body()[i];
  if (body >= m_watts.size() || m_watts[body] == 0) return false;
  return m_watts[body] > 0 || store.temperature()[i] > kColdest;
}

void BodyHeating::measure(const ParticleStore& store) {
  m_perMass.clear();
  if (std::all_of(m_watts.begin(), m_watts.end(), [](double watts) { return watts == 0; })) return;
  m_perMass.assign(m_watts.size(), 0.0);
  for (size_t i = 0; i < store.size(); ++i) {
    if (takesPart(store, i)) m_perMass[store.body()[i]] += double{store.mass()[i]};
  }
  for (size_t body = 0; body < m_watts.size(); ++body) {
    m_perMass[body] = m_perMass[body] > 0 ? m_watts[body] / m_perMass[body] : 0;
  }
}

void BodyHeating::addTo(const ParticleStore& store, size_t first, size_t last, std::span<double> watts) const {
  if (m_perMass.empty()) return;
  for (size_t i = first; i < last; ++i) {
    if (takesPart(store, i)) watts[i] += m_perMass[store.body()[i]] * double{store.mass()[i]};
  }
}

}  // namespace ps
