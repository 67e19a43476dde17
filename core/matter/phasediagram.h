// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

/// Equilibrium lines of one substance (PHYSICS 3.2): Clausius-Clapeyron with a linear latent heat for boiling, constant
/// latent heat for sublimation, linear melting line.
struct PhaseDiagram {
  double meltingPoint0 = 0, boilingPoint0 = 0;       ///< K at 101325 Pa
  double latentHeatVaporization = 0;                 ///< J/kg at boilingPoint0
  double latentHeatSublimation = 0;                  ///< J/kg at the triple point
  double molarMass = 0;                              ///< kg/mol; 0: the boiling point does not depend on pressure
  double tripleTemperature = 0, triplePressure = 0;  ///< K, Pa; 0: none known
  double criticalTemperature = 0;                    ///< K; 0: none known

  /// K at a pressure in Pa. Monotone in the pressure; never above the critical temperature.
  double boilingPoint(double pressure) const;
  double sublimationPoint(double pressure) const;
  double meltingPoint(double pressure) const;
  /// True where the solid turns to vapour without a liquid.
  bool sublimes(double pressure) const;
};

}  // namespace ps
