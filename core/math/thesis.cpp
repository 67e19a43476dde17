// SPDX-License-Identifier: Apache-2.0
#include "core/math/thesis.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kLatentHeat = 2257;  // kJ/kg
constexpr double kSharpness = 0.02;   // kJ/kg, keeps the logarithm finite

}  // namespace

double thesisDensityScale(double gasFraction) {
  const double f = std::clamp(gasFraction, 0.0, 1.0);
  return 1 - 1 / (1 + std::pow(1 + 12 / kLatentHeat, kLatentHeat * (0.5 - f)));
}

double thesisGravity(double gasFraction) {
  const double f = std::clamp(gasFraction, 0.0, 1.0), whole = kLatentHeat + kSharpness;
  return 10.8 / std::log(whole / kSharpness) * std::log(whole / (whole - f * kLatentHeat)) - 9.8;
}

}  // namespace ps
