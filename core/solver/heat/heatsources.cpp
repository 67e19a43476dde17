// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heat/heatsources.h"

#include <algorithm>

namespace ps {
namespace {

constexpr double kColdest = 1;  // K

/// J that may be taken from a particle before it is colder than kColdest, whatever it is made of.
double heatAbove(const api::Caloric& c, double mass, double temperature) {
  const double capacity = std::min({c.heatCapacitySolid, c.heatCapacityLiquid, c.heatCapacityGas});
  return mass * capacity * std::max(0.0, temperature - kColdest);
}

}  // namespace

void BodyHeating::measure(const ParticleStore& store) {
  m_perMass.clear();
  if (std::all_of(m_watts.begin(), m_watts.end(), [](double watts) { return watts == 0; })) return;
  m_perMass.assign(m_watts.size(), 0.0);
  for (size_t i = 0; i < store.size(); ++i) {
    if (store.body()[i] < m_perMass.size()) m_perMass[store.body()[i]] += double{store.mass()[i]};
  }
  for (size_t body = 0; body < m_watts.size(); ++body) {
    m_perMass[body] = m_perMass[body] > 0 ? m_watts[body] / m_perMass[body] : 0;
  }
}

void BodyHeating::addTo(const ParticleStore& store, std::span<const BakedMaterial> materials, double frame,
                        size_t first, size_t last, std::span<double> watts) const {
  if (m_perMass.empty()) return;
  for (size_t i = first; i < last; ++i) {
    const double mass = store.mass()[i];
    double share = store.body()[i] < m_perMass.size() ? m_perMass[store.body()[i]] * mass : 0;
    if (share < 0) {
      const double there = heatAbove(materials[store.material()[i]].caloric(), mass, store.temperature()[i]);
      share = std::max(share, -there / frame);
    }
    watts[i] += share;
  }
}

}  // namespace ps
