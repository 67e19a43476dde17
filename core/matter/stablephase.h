// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/views.h>

namespace ps {

/// What matter is at a temperature, K, when it is in balance; on the melting and the boiling point the warmer phase.
inline api::Phase stablePhase(const api::Caloric& caloric, double temperature) {
  if (caloric.sublimes) return temperature < caloric.meltingPoint ? api::Phase::Solid : api::Phase::Gas;
  if (caloric.melts && temperature < caloric.meltingPoint) return api::Phase::Solid;
  return temperature < caloric.boilingPoint ? api::Phase::Liquid : api::Phase::Gas;
}

}  // namespace ps
