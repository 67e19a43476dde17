// SPDX-License-Identifier: Apache-2.0
#include "core/matter/heatingcurve.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

double solidAt(const api::Caloric& c, double t) { return c.heatCapacitySolid * (t - c.meltingPoint0); }
double liquidAt(const api::Caloric& c, double t) {
  return c.latentHeatFusion + c.heatCapacityLiquid * (t - c.meltingPoint0);
}
double gasAt(const api::Caloric& c, double t) {
  return liquidAt(c, c.boilingPoint0) + c.latentHeatVaporization + c.heatCapacityGas * (t - c.boilingPoint0);
}

}  // namespace

std::vector<HeatingCorner> heatingCurve(const api::Caloric& c, double firstKelvin, double lastKelvin) {
  using api::Phase;
  std::vector<HeatingCorner> corners;
  double from = firstKelvin;  // where the piece that comes next begins
  if (c.sublimes) {
    if (from < c.meltingPoint) {
      corners.push_back({solidAt(c, from), from, Phase::Solid});
      corners.push_back({solidAt(c, c.meltingPoint), c.meltingPoint, Phase::Boiling});
      from = c.meltingPoint;
    }
    corners.push_back({gasAt(c, from), from, Phase::Gas});
    corners.push_back({gasAt(c, std::max(from, lastKelvin)), std::max(from, lastKelvin), Phase::Gas});
    return corners;
  }
  if (c.melts && from < c.solidus) {
    corners.push_back({solidAt(c, from), from, Phase::Solid});
    corners.push_back({solidAt(c, c.solidus), c.solidus, Phase::Melting});
    from = c.liquidus;
  }
  corners.push_back({liquidAt(c, from), from, Phase::Liquid});
  const double end = std::max(from, lastKelvin);
  if (std::isfinite(c.boilingPoint) && end >= c.boilingPoint && from <= c.boilingPoint) {
    corners.push_back({liquidAt(c, c.boilingPoint), c.boilingPoint, Phase::Boiling});
    corners.push_back({gasAt(c, c.boilingPoint), c.boilingPoint, Phase::Gas});
    corners.push_back({gasAt(c, end), end, Phase::Gas});
  } else {
    corners.push_back({liquidAt(c, end), end, Phase::Liquid});
  }
  return corners;
}

}  // namespace ps
