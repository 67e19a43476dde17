// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/views.h>

#include <array>
#include <cmath>

namespace ps {

/// What the enthalpy of a material is counted by: where the curves of its phases begin, how steep they are and how far
/// apart. Pressure is not of it, nor where in a range matter melts: these choose a state on the curves. The same state
/// has another enthalpy where two of these differ.
struct EnthalpyCurves {
  static constexpr size_t kNumbers = 8;
  std::array<double, kNumbers> number{};  ///< what the matter does not have is 0

  EnthalpyCurves() = default;
  explicit EnthalpyCurves(const api::Caloric& c) {
    const bool boils = std::isfinite(c.boilingPoint0);
    number = {
        c.heatCapacitySolid,         c.heatCapacityLiquid, boils ? c.heatCapacityGas : 0,        c.meltingPoint0,
        boils ? c.boilingPoint0 : 0, c.latentHeatFusion,   boils ? c.latentHeatVaporization : 0, c.melts ? 1.0 : 0.0};
  }
  bool operator==(const EnthalpyCurves&) const = default;
};

}  // namespace ps
