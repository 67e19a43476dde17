// SPDX-License-Identifier: Apache-2.0
#include "core/solver/settings.h"

#include "core/particles/neighbours.h"

namespace ps {

double leastPeriod(const SolverSettings& settings) {
  return Neighbours::leastPeriod((settings.supportRatio + kSkinSpacings) * settings.spacing);
}

}  // namespace ps
