// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heat/bodyflux.h"

#include "core/base/parallelarrays.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// Of what a particle lacks in a body of one layer, the share from which on it gives all of its heat.
constexpr double kWhole = 0.35;
/// Share of a lattice's sum below which a particle counts as lacking nothing: packing varies by so much.
constexpr double kNothing = 0.02;

/// visit(plane, sum V W) of the planes n >= 0 of a cubic lattice beside a particle of plane 0, itself among them.
template <class Visit>
void eachPlane(const Kernel& kernel, double dx, Visit&& visit) {
  const int reach = static_cast<int>(std::ceil(kernel.supportRadius() / dx));
  for (int n = 0; n <= reach; ++n) {
    double sum = 0;
    for (int y = -reach; y <= reach; ++y) {
      for (int z = -reach; z <= reach; ++z)
        sum += kernel.value(dx * std::sqrt(static_cast<double>(n * n + y * y + z * z)));
    }
    visit(n, sum * dx * dx * dx);
  }
}

/// m between two particles.
double distance(const ParticleStore& store, size_t i, uint32_t j) {
  const auto [x, y, z, unused] = store.separation(static_cast<uint32_t>(i), j);
  return std::sqrt(double{x} * x + double{y} * y + double{z} * z);
}

/// visit(partner) for all that are within the support of a particle.
template <class Visit>
void eachPartner(const HeatPairs& pairs, size_t i, Visit&& visit) {
  for (uint32_t k = pairs.begin[i]; k < pairs.same[i]; ++k) visit(pairs.partner[k]);
  for (uint32_t k = pairs.other[i]; k < pairs.end[i]; ++k) visit(pairs.partner[k]);
}

}  // namespace

void BodyFlux::measure(const ParticleStore& store, const HeatPairs& pairs, const BodyHeating& heating,
                       const SolverSettings& solver) {
  m_spacing = solver.spacing;
  m_kernel = Kernel(solver.kernel, solver.spacing * solver.supportRatio);
  m_bulk = 0;
  double columns = 0;  // all that a column of matter sees of a half space
  eachPlane(m_kernel, m_spacing, [&](int n, double sum) {
    m_bulk += n == 0 ? sum : 2 * sum;
    columns += n * sum;
  });
  m_plane = m_spacing * m_spacing / columns;
  assignAll(m_watts, store.size(), 0.0);
  findIndices(store.size(), m_givers, [&](size_t i) { return heating.fluxAt(store, i) != 0; });
  for (const uint32_t i : m_givers) m_watts[i] = heating.fluxAt(store, i);  // W/m2, until share()
  m_sums.resize(m_givers.size());
  forChunks(m_givers.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) m_sums[k] = look(store, pairs, m_givers[k]);
  });
  share(store, heating);
}

BodyFlux::Sums BodyFlux::look(const ParticleStore& store, const HeatPairs& pairs, size_t j) const {
  Sums sums;
  double own = double{pairs.volume[j]} * m_kernel.value(0);
  eachPartner(pairs, j, [&](uint32_t k) {
    const double part = double{pairs.volume[k]} * m_kernel.value(distance(store, j, k));
    if (m_watts[k] != 0 && store.body()[k] == store.body()[j])
      own += part;
    else if (!pairs.isInsulated(k))
      sums.touched += part;
  });
  if (const double lacks = m_bulk - own; lacks > kNothing * m_bulk) sums.lacks = lacks;
  return sums;
}

void BodyFlux::share(const ParticleStore& store, const BodyHeating& heating) {
  m_lacks.assign(heating.count(), 0);
  m_particles.assign(heating.count(), 0);
  for (size_t k = 0; k < m_givers.size(); ++k) {
    m_lacks[store.body()[m_givers[k]]] += m_sums[k].lacks;
    ++m_particles[store.body()[m_givers[k]]];
  }
  for (size_t k = 0; k < m_givers.size(); ++k) {
    const uint32_t body = store.body()[m_givers[k]];
    const BodyHeat& heat = heating.of(body);
    const Sums& sums = m_sums[k];
    double area = m_plane;
    if (heat.oneLayer) {
      area = heat.area > 0 ? heat.area / m_particles[body] : m_spacing * m_spacing;
      const double whole = std::max(sums.touched, kWhole * sums.lacks);
      area = whole > 0 ? area / whole : 0;
    } else if (heat.area > 0) {
      area = m_lacks[body] > 0 ? heat.area / m_lacks[body] : 0;
    }
    m_watts[m_givers[k]] = heat.flux * area;
  }
}

void BodyFlux::addTo(const ParticleStore& store, const HeatPairs& pairs, size_t first, size_t last,
                     std::span<double> watts) const {
  if (m_givers.empty()) return;
  for (size_t i = first; i < last; ++i) {
    if (m_watts[i] != 0 || pairs.isInsulated(i)) continue;
    double sum = 0;
    eachPartner(pairs, i, [&](uint32_t j) {
      if (m_watts[j] != 0) sum += m_watts[j] * m_kernel.value(distance(store, i, j));
    });
    watts[i] += sum * double{pairs.volume[i]};
  }
}

}  // namespace ps
