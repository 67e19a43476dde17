// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

namespace ps {

/// A number above 0 to so many digits. By division where they are behind the point: 3 tenths are 0.3 to the last bit.
inline double toDigits(double value, int digits) {
  const int last = static_cast<int>(std::floor(std::log10(value))) - digits + 1;
  const double unit = std::pow(10.0, std::abs(last));
  return last < 0 ? std::round(value * unit) / unit : std::round(value / unit) * unit;
}

}  // namespace ps
