// SPDX-License-Identifier: Apache-2.0
#include "core/matter/phaselines.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr int kSteps = 80;  // over the whole range

std::optional<PhasePoint> criticalPoint(const PhaseDiagram& diagram) {
  if (diagram.criticalTemperature <= 0 || diagram.boilingPoint0 <= 0) return std::nullopt;
  if (diagram.molarMass <= 0 || diagram.latentHeatVaporization <= 0) return std::nullopt;
  const PhaseDiagram::BoilingLine line = diagram.boilingLine();
  const double t = diagram.criticalTemperature;
  return PhasePoint{
      t, line.pressure * std::exp(line.a * (1 / line.temperature - 1 / t) - line.b * std::log(t / line.temperature))};
}

}  // namespace

PhaseLines phaseLines(const PhaseDiagram& diagram, double lowest, double highest) {
  PhaseLines lines;
  std::vector<double> pressures;
  for (int i = 0; i <= kSteps; ++i) pressures.push_back(lowest * std::pow(highest / lowest, i / double{kSteps}));
  if (diagram.tripleTemperature > 0 && diagram.triplePressure > 0)
    lines.triple = PhasePoint{diagram.tripleTemperature, diagram.triplePressure};
  lines.critical = criticalPoint(diagram);
  for (const auto& end : {lines.triple, lines.critical}) {  // lines meet there, or end
    if (end && end->pressure > lowest && end->pressure < highest) pressures.push_back(end->pressure);
  }
  std::sort(pressures.begin(), pressures.end());
  for (const double p : pressures) {
    const bool sublimes = diagram.sublimes(p);
    if (sublimes || (lines.triple && p == lines.triple->pressure))
      lines.sublimation.push_back({diagram.sublimationPoint(p), p});
    if (sublimes) continue;
    if (diagram.meltingPoint0 > 0) lines.melting.push_back({diagram.meltingPoint(p), p});
    const double boiling = diagram.boilingPoint(p);
    if (std::isfinite(boiling) && !(lines.critical && p > lines.critical->pressure))
      lines.boiling.push_back({boiling, p});
  }
  return lines;
}

}  // namespace ps
