// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>

namespace ps {

/// What one particle can take before its temperature moves, for pairwise exponential exchange.
struct HeatBody {
  double temperature = 0;               ///< K
  double inverseCapacity = 0;           ///< K/J, sensible heat alone
  double latentUp = 0, latentDown = 0;  ///< J to the upper and lower end of the plateau that it stands on

  /// K/J against a partner that is warmer by `difference` K: latent heat counts as if spread over the difference.
  double inverseAgainst(double difference) const {
    const double latent = difference > 0 ? latentUp : latentDown;
    if (!(latent > 0)) return inverseCapacity;
    return inverseCapacity / (1 + inverseCapacity * latent / std::abs(difference));
  }
  /// Adds joules: latent heat first, the rest moves the temperature.
  void addHeat(double joules) {
    double& from = joules > 0 ? latentUp : latentDown;
    double& to = joules > 0 ? latentDown : latentUp;
    const double latent = std::min(std::abs(joules), from);
    from -= latent;
    to += latent;
    temperature += (joules > 0 ? joules - latent : joules + latent) * inverseCapacity;
  }
};

}  // namespace ps
