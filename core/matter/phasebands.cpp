// SPDX-License-Identifier: Apache-2.0
#include "core/matter/phasebands.h"

#include "core/matter/material.h"

#include <cmath>
#include <limits>

namespace ps {

std::vector<PhaseBand> bandsOf(const Material& material, double pressure) {
  const PhaseDiagram diagram = phaseDiagramOf(material);
  const double end = std::numeric_limits<double>::infinity();
  const bool melts = diagram.meltingPoint0 > 0;
  if (diagram.sublimes(pressure)) {
    const double at = diagram.sublimationPoint(pressure);
    return {{0, at, api::Phase::Solid}, {at, end, api::Phase::Gas}};
  }
  const double melting = melts ? diagram.meltingPoint(pressure) : 0, boiling = diagram.boilingPoint(pressure);
  std::vector<PhaseBand> bands;
  if (melts) bands.push_back({0, melting, api::Phase::Solid});
  // What never melts is what it is made as; who states how thick a liquid it is means one.
  const bool flows = melts || material.properties.contains("viscosity");
  if (!melts && !std::isfinite(boiling)) return {{0, end, flows ? api::Phase::Liquid : api::Phase::Solid}};
  bands.push_back({melting, boiling, api::Phase::Liquid});
  if (std::isfinite(boiling)) bands.push_back({boiling, end, api::Phase::Gas});
  return bands;
}

}  // namespace ps
