// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

/// A layer of fluid heated from below.
struct HeatedLayer {
  double gravity = 9.81;          ///< m/s²
  double expansion = 0;           ///< volumetric, 1/K
  double difference = 0;          ///< K, by which the bottom is warmer
  double height = 0;              ///< m
  double viscosity = 0;           ///< kinematic, m²/s: the one that the solver delivers, see Solver::limits()
  double thermalDiffusivity = 0;  ///< m²/s
};

/// Rayleigh's number g beta dT H³/(nu alpha): a layer between two rigid plates convects above 1707.76, with a free
/// surface above 1100.65 (Chandrasekhar 1961).
constexpr double rayleighNumber(const HeatedLayer& l) {
  return l.gravity * l.expansion * l.difference * l.height * l.height * l.height / (l.viscosity * l.thermalDiffusivity);
}

}  // namespace ps
