// SPDX-License-Identifier: Apache-2.0
#include "core/matter/mixedphases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace ps {
namespace {

constexpr double kGasConstant = 8.314462618;   // J/(mol K)
constexpr double kReferencePressure = 101325;  // Pa
constexpr double kReference = 293.15;          // K
constexpr double kGuldberg = 1.5;              // critical temperature over boiling point

struct Part {
  double mass = 0, moles = 0;  ///< shares
  PhaseDiagram diagram;
  double latentFusion = 0, solidus = 0, liquidus = 0;
  double solidCapacity = 0, liquidCapacity = 0, gasCapacity = 0;

  Part(const Material& material, double massShare, double molesShare)
      : mass(massShare), moles(molesShare), diagram(phaseDiagramOf(material)) {
    const auto value = [&](const char* key) { return valueOf(material, key, kReference); };
    latentFusion = value("latent_heat_fusion");
    solidus = value("solidus");
    liquidus = value("liquidus");
    solidCapacity = value("heat_capacity_solid");
    liquidCapacity = value("heat_capacity_liquid");
    gasCapacity = value("heat_capacity_gas");
    if (solidus >= liquidus) solidus = liquidus = diagram.meltingPoint0;
  }
  bool melts() const { return diagram.meltingPoint0 > 0; }
  bool boils() const { return diagram.boilingPoint0 > 0; }
  double mostBoiling() const {
    return diagram.criticalTemperature > 0 ? diagram.criticalTemperature : kGuldberg * diagram.boilingReference();
  }
};

using Parts = std::array<Part, 2>;

/// Where a function that falls through 0 between two temperatures does.
template <class Falling>
double crossing(double low, double high, Falling excess) {
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

bool molesKnown(const Parts& parts) {
  return std::all_of(parts.begin(), parts.end(), [](const Part& p) { return p.diagram.molarMass > 0; });
}

struct Melting {
  double solidus, liquidus;  ///< K
};

/// Of two that melt sharply, at their melting points.
Melting idealMelting(const Parts& parts) {
  const double one = parts[0].diagram.meltingPoint0, other = parts[1].diagram.meltingPoint0;
  if (!molesKnown(parts) || parts[0].latentFusion <= 0 || parts[1].latentFusion <= 0) {
    const double mean = parts[0].mass * one + parts[1].mass * other;
    return {mean, mean};
  }
  const auto sum = [&](double t, double sign) {
    double total = 0;
    for (const Part& p : parts) {
      const double heat = p.latentFusion * p.diagram.molarMass / kGasConstant;
      total += p.moles * std::exp(sign * heat * (1 / t - 1 / p.diagram.meltingPoint0));
    }
    return total;
  };
  const auto [low, high] = std::minmax(one, other);
  return {crossing(low, high, [&](double t) { return 1 - sum(t, -1); }),
          crossing(low, high, [&](double t) { return sum(t, 1) - 1; })};
}

/// What the parts take up by mass, carried to a temperature by Kirchhoff's law.
template <class Latent>
double latentSum(const Parts& parts, Latent latent) {
  return parts[0].mass * latent(parts[0]) + parts[1].mass * latent(parts[1]);
}

void addMelting(const Parts& parts, std::map<std::string, double>& out) {
  Melting melting{};
  double below = 0, above = 0, slope = 0, melts = 0;
  for (const Part& p : parts) {
    if (!p.melts()) continue;
    melting = {p.diagram.meltingPoint0, p.diagram.meltingPoint0};
    below += p.mass * (p.diagram.meltingPoint0 - p.solidus);
    above += p.mass * (p.liquidus - p.diagram.meltingPoint0);
    slope += p.mass * p.diagram.meltingSlope;
    melts += p.mass;
  }
  if (melts <= 0) return;
  if (parts[0].melts() && parts[1].melts()) melting = idealMelting(parts);
  const double middle = 0.5 * (melting.solidus + melting.liquidus);
  out["melting_temperature"] = middle;
  out["solidus"] = std::min(middle, melting.solidus - below / melts);
  out["liquidus"] = std::max(middle, melting.liquidus + above / melts);
  out["melting_slope"] = slope / melts;
  out["latent_heat_fusion"] = latentSum(parts, [&](const Part& p) {
    if (!p.melts()) return 0.0;
    return p.latentFusion + (p.liquidCapacity - p.solidCapacity) * (middle - p.diagram.meltingPoint0);
  });
}

/// Pa at a temperature in K, on a part's boiling line; 0 for what never boils.
double vapourPressure(const Part& part, double t) {
  if (!part.boils()) return 0;
  const PhaseDiagram::BoilingLine line = part.diagram.boilingLine();
  return line.pressure * std::exp(line.a * (1 / line.temperature - 1 / t) - line.b * std::log(t / line.temperature));
}

/// K; 0: never.
double boilingOf(const Parts& parts) {
  double low = std::numeric_limits<double>::infinity(), high = 0, byMass = 0, boils = 0;
  bool lines = true;
  for (const Part& p : parts) {
    if (!p.boils()) continue;
    low = std::min(low, p.diagram.boilingReference());
    high = std::max(high, p.diagram.boilingReference());
    byMass += p.mass * p.diagram.boilingReference();
    boils += p.mass;
    lines = lines && p.diagram.molarMass > 0 && p.diagram.latentHeatVaporization > 0;
  }
  if (boils <= 0) return 0;
  const bool both = parts[0].boils() && parts[1].boils();
  if (!lines) return byMass / boils;
  if (!both) high = (parts[0].boils() ? parts[0] : parts[1]).mostBoiling();
  const auto lack = [&](double t) {
    return kReferencePressure - parts[0].moles * vapourPressure(parts[0], t) -
           parts[1].moles * vapourPressure(parts[1], t);
  };
  if (!both && lack(high) > 0) return 0;
  return crossing(low, high, lack);
}

void addBoiling(const Parts& parts, std::map<std::string, double>& out) {
  if (!parts[0].boils() && !parts[1].boils()) return;
  const double boiling = boilingOf(parts);
  out["boiling_temperature"] = boiling;
  if (boiling <= 0) return;
  out["latent_heat_vaporization"] = latentSum(parts, [&](const Part& p) {
    if (!p.boils()) return 0.0;
    return p.diagram.latentHeatVaporization +
           (p.gasCapacity - p.liquidCapacity) * (boiling - p.diagram.boilingReference());
  });
  double critical = 0, moles = 0;
  for (const Part& p : parts) {
    if (!p.boils()) continue;
    if (p.diagram.criticalTemperature <= 0) return;
    critical += p.moles * p.diagram.criticalTemperature;
    moles += p.moles;
  }
  if (critical / moles > boiling) out["critical_temperature"] = critical / moles;
}

}  // namespace

double moleShare(const Material& first, const Material& second, double massShare) {
  const double one = valueOf(first, "molar_mass", kReference), other = valueOf(second, "molar_mass", kReference);
  if (one <= 0 || other <= 0) return massShare;
  const double a = (1 - massShare) / one, b = massShare / other;
  return b / (a + b);
}

std::pair<double, double> temperaturesOf(const Material& first, const Material& second) {
  double low = 400, high = 400;  // around 20 °C for what neither melts nor boils
  for (const Material* part : {&first, &second}) {
    const PhaseDiagram diagram = phaseDiagramOf(*part);
    for (const double point : {diagram.meltingPoint0, diagram.boilingPoint0}) {
      if (point > 0) low = std::min(low, point);
      high = std::max(high, 1.25 * point);
    }
  }
  return {0.5 * low, high};
}

std::map<std::string, double> mixedPhases(const Material& first, const Material& second, double massShare) {
  const double moles = moleShare(first, second, massShare);
  const Parts parts{Part(first, 1 - massShare, 1 - moles), Part(second, massShare, moles)};
  std::map<std::string, double> out;
  addMelting(parts, out);
  addBoiling(parts, out);
  return out;
}

}  // namespace ps
