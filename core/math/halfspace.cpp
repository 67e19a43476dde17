// SPDX-License-Identifier: Apache-2.0
#include "core/math/halfspace.h"

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

}  // namespace ps
