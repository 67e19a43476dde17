// SPDX-License-Identifier: Apache-2.0
#include "core/matter/phasediagram.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ps {
namespace {

constexpr double kGasConstant = 8.314462618;   // J/(mol K)
constexpr double kReferencePressure = 101325;  // Pa
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// log and Newton's last bits differ between C libraries; what comes out reaches the state hash.
double rounded(double kelvin) { return std::round(kelvin * 1048576.0) / 1048576.0; }

}  // namespace

bool PhaseDiagram::sublimesAtReference() const {
  return tripleTemperature > 0 && triplePressure > kReferencePressure && boilingPoint0 > 0 &&
         boilingPoint0 < tripleTemperature;
}

double PhaseDiagram::boilingReference() const { return sublimesAtReference() ? tripleTemperature : boilingPoint0; }

PhaseDiagram::BoilingLine PhaseDiagram::boilingLine() const {
  BoilingLine line;
  const double specificGas = kGasConstant / molarMass;
  line.temperature = boilingReference();
  line.pressure = sublimesAtReference() ? triplePressure : kReferencePressure;
  double capacityDifference = 0;
  if (tripleTemperature > 0 && triplePressure > 0 && !sublimesAtReference()) {
    const double t0 = line.temperature, t3 = tripleTemperature, inverse = 1 / t0 - 1 / t3;
    const double left = specificGas * std::log(triplePressure / line.pressure) - latentHeatVaporization * inverse;
    const double right = t0 * inverse - std::log(t3 / t0);
    if (std::abs(right) > 1e-9) capacityDifference = left / right;
  }
  line.a = (latentHeatVaporization + capacityDifference * line.temperature) / specificGas;
  line.b = capacityDifference / specificGas;
  return line;
}

double PhaseDiagram::boilingPoint(double pressure) const {
  if (boilingPoint0 <= 0) return kInfinity;
  const double highest = criticalTemperature > 0 ? criticalTemperature : kInfinity;
  if (molarMass <= 0 || latentHeatVaporization <= 0) return std::min(boilingReference(), highest);
  const BoilingLine line = boilingLine();
  if (pressure == line.pressure) return std::min(line.temperature, highest);
  const double target = std::log(std::max(pressure, 1e-9) / line.pressure);
  const auto excess = [&](double t) {
    return line.a * (1 / line.temperature - 1 / t) - line.b * std::log(t / line.temperature) - target;
  };
  // The line rises up to a/b, far above any critical point; beyond it there is no vapour to be in balance with.
  const double top = std::min(highest, line.b > 0 ? 0.999 * line.a / line.b : 20 * line.temperature);
  if (excess(top) <= 0) return top == highest ? highest : rounded(top);
  double low = 0.02 * line.temperature, high = top;
  double t = std::clamp(line.temperature / std::max(0.05, 1 - target * line.temperature / line.a), low, high);
  for (int i = 0; i < 60; ++i) {  // Newton, kept inside the bracket
    const double f = excess(t);
    (f > 0 ? high : low) = t;
    double next = t - f / (line.a / (t * t) - line.b / t);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - t) < 1e-10 * t) break;
    t = next;
  }
  return rounded(t);
}

double PhaseDiagram::sublimationPoint(double pressure) const {
  if (tripleTemperature <= 0 || triplePressure <= 0) return boilingPoint(pressure);
  double slope = latentHeatSublimation * molarMass / kGasConstant;
  if (sublimesAtReference()) {  // two points of the line are known
    slope = std::log(triplePressure / kReferencePressure) / (1 / boilingPoint0 - 1 / tripleTemperature);
  }
  if (!(slope > 0)) return tripleTemperature;
  const double inverse = 1 / tripleTemperature - std::log(std::max(pressure, 1e-9) / triplePressure) / slope;
  return rounded(std::clamp(1 / std::max(inverse, 1e-6), 1.0, tripleTemperature));
}

double PhaseDiagram::meltingPoint(double pressure) const {
  if (meltingPoint0 <= 0) return 0;
  return std::max(1.0, meltingPoint0 + meltingSlope * (pressure - kReferencePressure));
}

bool PhaseDiagram::sublimes(double pressure) const {
  if (meltingPoint0 <= 0 || boilingPoint0 <= 0) return false;  // what never boils has no vapour to turn to
  if (tripleTemperature > 0 && triplePressure > 0) return pressure < triplePressure;
  return boilingPoint(pressure) <= meltingPoint(pressure);
}

}  // namespace ps
