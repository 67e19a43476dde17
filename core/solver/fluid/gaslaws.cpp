// SPDX-License-Identifier: Apache-2.0
#include "core/solver/fluid/gaslaws.h"

#include <algorithm>

namespace ps {
namespace {

constexpr double kGasConstant = 8.314462618;  ///< J/(mol K)
constexpr double kMolarMassAir = 0.0289647;   ///< kg/mol
constexpr double kColdest = 20;               ///< K, below which the ideal gas law is not asked

}  // namespace

double idealGasDensity(double pressure, double molarMass, double temperature) {
  return pressure * molarMass / (kGasConstant * std::max(temperature, kColdest));
}

double airDensity(double pressure, double temperature) { return idealGasDensity(pressure, kMolarMassAir, temperature); }

double parcelLift(double ratio, double addedMass) { return (ratio - 1) / (1 + addedMass * ratio); }

double dragRate(double ratio, double dragCoefficient, double diameter) {
  return 0.75 * dragCoefficient * ratio / diameter;
}

}  // namespace ps
