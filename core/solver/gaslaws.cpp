// SPDX-License-Identifier: Apache-2.0
#include "core/solver/gaslaws.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kGasConstant = 8.314462618;  ///< J/(mol K)
constexpr double kMolarMassAir = 0.0289647;   ///< kg/mol
constexpr double kColdest = 20;               ///< K, below which the ideal gas law is not asked
constexpr double kThesisLatent = 2257;        ///< kJ/kg; the laws were written with this number, whatever the matter
constexpr double kThesisLightest = 0.7;       ///< 700 kg/m3 of 1000, the thesis's table 4.3
constexpr double kThesisOffset = 0.02;        ///< in units of the latent heat

}  // namespace

double idealGasDensity(double pressure, double molarMass, double temperature) {
  return pressure * molarMass / (kGasConstant * std::max(temperature, kColdest));
}

double airDensity(double pressure, double temperature) { return idealGasDensity(pressure, kMolarMassAir, temperature); }

double parcelLift(double ratio, double addedMass) { return (ratio - 1) / (1 + addedMass * ratio); }

double dragRate(double ratio, double dragCoefficient, double diameter) {
  return 0.75 * dragCoefficient * ratio / diameter;
}

double thesisDensityScale(double fraction) {
  const double l = kThesisLatent;
  return 1 - 1 / (1 + std::pow(1 + 12 / l, l / 2 - std::clamp(fraction, 0.0, 1.0) * l));
}

double thesisVolume(double fraction) { return 1 / std::max(kThesisLightest, thesisDensityScale(fraction)); }

double thesisGravity(double fraction) {
  const double l = kThesisLatent, whole = l + kThesisOffset;
  return 10.8 / std::log(whole / kThesisOffset) * std::log(whole / (whole - std::clamp(fraction, 0.0, 1.0) * l)) - 9.8;
}

}  // namespace ps
