// SPDX-License-Identifier: Apache-2.0
#include "core/math/halfspace.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

/// 1/D of the sphere, or half of it: 1/m, as seen from a distance, which stays off the centre of a narrow one.
double bending(const Bend& bend, double distance) {
  if (bend.radius == 0) return 0;
  return bend.share / (bend.radius < 0 ? bend.radius - distance : std::max(bend.radius - distance, bend.radius / 2));
}

}  // namespace

HalfSpaceTable::HalfSpaceTable(const Kernel& kernel, const Bend& bend) : m_entries(kIntervals) {
  constexpr int kSteps = 16;  // of Simpson's rule per interval
  constexpr int intervals = kIntervals;
  const double support = kernel.supportRadius(), step = support / (intervals * kSteps);
  const auto integrand = [&](double r) { return 2 * std::numbers::pi * r * kernel.value(r); };
  double area = 0, share = 0, moment = 0;  // moment: int_d^R z A dz
  Value end{0, 0};                         // of the interval that is being filled
  for (int k = intervals * kSteps; k > 0; --k) {
    const double high = k * step, low = (k - 1) * step, middle = 0.5 * (high + low), quarter = 0.5 * (middle + high);
    const double upperHalf = step / 12 * (integrand(middle) + 4 * integrand(quarter) + integrand(high));
    const double whole = step / 6 * (integrand(low) + 4 * integrand(middle) + integrand(high));
    share += step / 6 * (area + 4 * (area + upperHalf) + area + whole);
    moment += step / 6 * (high * area + 4 * middle * (area + upperHalf) + low * (area + whole));
    area += whole;
    if ((k - 1) % kSteps != 0) continue;
    const double bent = bending(bend, low);
    const double more = bend.share > 0 ? bent * bent / bend.share * moment : 0;  // of the slope: D is less by d
    const Value begin{static_cast<float>(share + bent * moment), static_cast<float>(more - area - bent * low * area)};
    m_entries[static_cast<size_t>((k - 1) / kSteps)] = {begin.share, begin.slope, end.share - begin.share,
                                                        end.slope - begin.slope};
    end = begin;
  }
  m_perMetre = static_cast<float>(intervals / support);
}

}  // namespace ps
