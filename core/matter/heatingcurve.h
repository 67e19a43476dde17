// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/views.h>

#include <vector>

namespace ps {

/// A corner of a heating curve, and which phase matter is in from there to the next.
struct HeatingCorner {
  double enthalpy, temperature;  ///< J/kg, 0 for the solid at its melting point at 101325 Pa; K
  api::Phase phase;
};

/// How temperature rises with the heat that a kilogram in balance has got, at the pressure that the caloric data are
/// for: straight pieces, since heat capacities are constants, from one temperature in K to another. Plateaus and the
/// range of melting are whole. What lies beyond the last corner is left out.
std::vector<HeatingCorner> heatingCurve(const api::Caloric& caloric, double firstKelvin, double lastKelvin);

}  // namespace ps
