// SPDX-License-Identifier: Apache-2.0
#include "core/solver/fluid/halfspaces.h"

#include "core/base/parallel.h"

#include <numbers>

namespace ps {

HalfSpaceTable::HalfSpaceTable(const Kernel& kernel) : m_entries(kIntervals) {
  // Over a plane at distance z the kernel integrates to A(z) = 2 pi int_z^R r W dr; beyond d there is int_d^R A dz.
  constexpr int kSteps = 16;  // of Simpson's rule per interval
  constexpr int intervals = kIntervals;
  const double support = kernel.supportRadius(), step = support / (intervals * kSteps);
  const auto integrand = [&](double r) { return 2 * std::numbers::pi * r * kernel.value(r); };
  double area = 0, share = 0;
  Value end{0, 0};  // of the interval that is being filled
  for (int k = intervals * kSteps; k > 0; --k) {
    const double high = k * step, low = (k - 1) * step, middle = 0.5 * (high + low), quarter = 0.5 * (middle + high);
    const double upperHalf = step / 12 * (integrand(middle) + 4 * integrand(quarter) + integrand(high));
    const double whole = step / 6 * (integrand(low) + 4 * integrand(middle) + integrand(high));
    share += step / 6 * (area + 4 * (area + upperHalf) + area + whole);
    area += whole;
    if ((k - 1) % kSteps != 0) continue;
    const Value begin{static_cast<float>(share), static_cast<float>(-area)};
    m_entries[static_cast<size_t>((k - 1) / kSteps)] = {begin.share, begin.slope, end.share - begin.share,
                                                        end.slope - begin.slope};
    end = begin;
  }
  m_perMetre = static_cast<float>(intervals / support);
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

void HalfSpaces::refresh(std::span<const api::Float4> built) {
  m_near.resize(built.size());
  forChunks(built.size(), grain::kParticles, [&](size_t first, size_t last) {
    findNearWalls(m_planes, m_reach, built.subspan(first, last - first),
                  std::span(m_near).subspan(first, last - first));
  });
}

}  // namespace ps
