// SPDX-License-Identifier: Apache-2.0
#include "core/solver/fluid/halfspaces.h"

#include "core/base/parallel.h"

#include <numbers>

namespace ps {

HalfSpaceTable::HalfSpaceTable(const Kernel& kernel) : m_values(kIntervals + 1) {
  // Over a plane at distance z the kernel integrates to A(z) = 2 pi int_z^R r W dr; beyond d there is int_d^R A dz.
  constexpr int kSteps = 16;  // of Simpson's rule per interval
  const double support = kernel.supportRadius(), step = support / (kIntervals * kSteps);
  const auto integrand = [&](double r) { return 2 * std::numbers::pi * r * kernel.value(r); };
  double area = 0, share = 0;
  m_values[kIntervals] = {0, 0};
  for (int k = kIntervals * kSteps; k > 0; --k) {
    const double high = k * step, low = (k - 1) * step, middle = 0.5 * (high + low), quarter = 0.5 * (middle + high);
    const double upperHalf = step / 12 * (integrand(middle) + 4 * integrand(quarter) + integrand(high));
    const double whole = step / 6 * (integrand(low) + 4 * integrand(middle) + integrand(high));
    share += step / 6 * (area + 4 * (area + upperHalf) + area + whole);
    area += whole;
    if ((k - 1) % kSteps == 0)
      m_values[static_cast<size_t>((k - 1) / kSteps)] = {static_cast<float>(share), static_cast<float>(-area)};
  }
  m_perMetre = static_cast<float>(kIntervals / support);
}

void HalfSpaces::configure(const SolverSettings& settings, const std::vector<Wall>& walls) {
  m_planes.clear();
  for (const Wall& w : walls) m_planes.emplace_back(w);
  const double support = settings.spacing * settings.supportRatio;
  const bool known = m_kernel == settings.kernel && m_support == static_cast<float>(support);
  m_kernel = settings.kernel;
  m_support = static_cast<float>(support);
  m_nearest = static_cast<float>(0.5 * settings.spacing);
  m_reach = static_cast<float>(support + settings.spacing);
  if (!known) m_table = HalfSpaceTable(Kernel(settings.kernel, support));
}

void HalfSpaces::sumsOf(std::span<const uint32_t> which, const api::Float4* points, Sum* sums) const {
  WallSet met;
  for (const uint32_t i : which) met.add(m_near[i]);
  std::fill_n(sums, which.size(), Sum());
  met.forEach(m_planes.size(), [&](size_t wall) {
    const WallPlane& p = m_planes[wall];
    for (size_t k = 0; k < which.size(); ++k) {
      const float distance = p.heightOf(points[which[k]]);
      if (!(distance < m_support)) continue;
      const HalfSpaceTable::Value value = m_table.at(std::max(m_nearest, distance));
      Sum& sum = sums[k];
      sum.excess += value.share;
      sum.x += p.x * value.slope;
      sum.y += p.y * value.slope;
      sum.z += p.z * value.slope;
    }
  });
}

void HalfSpaces::refresh(std::span<const api::Float4> built) {
  m_near.resize(built.size());
  forChunks(built.size(), grain::kParticles, [&](size_t first, size_t last) {
    findNearWalls(m_planes, m_reach, built.subspan(first, last - first),
                  std::span(m_near).subspan(first, last - first));
  });
}

}  // namespace ps
