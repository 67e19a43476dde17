// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/types.h>

#include <vector>

namespace ps {

struct Material;

inline constexpr double kRoom = 293.15;  ///< K, at which materials are listed and compared

inline constexpr double kAir = 101325;  ///< Pa, the usual pressure of the air

/// Where matter is solid, liquid or gas under one pressure; K.
struct PhaseBand {
  double from = 0, to = 0;
  api::Phase phase = api::Phase::Solid;
};

/// Coldest first. Of what never melts the one phase that it is made as.
std::vector<PhaseBand> bandsOf(const Material& material, double pressure = kAir);

}  // namespace ps
