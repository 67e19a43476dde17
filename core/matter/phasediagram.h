// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

/// Equilibrium lines of one substance: Clausius-Clapeyron with a latent heat that falls linearly with temperature for
/// boiling, with a constant latent heat for sublimation, and a straight melting line.
///
///   boiling      ln p = ln p0 + a (1/T0 - 1/T) - b ln(T/T0),  a = (L_v0 + dc T0)/R_s,  b = dc/R_s
///   sublimation  ln p = ln p3 + (L_s/R_s) (1/T3 - 1/T)
///   melting      T = T_m0 + (p - p0) dT_m/dp
///
/// dc, the fall of the latent heat per kelvin, is fitted so that the boiling line meets the triple point. For water the
/// boiling points lie within 0.45 K of IAPWS-95 from 0.6 to 200 kPa (1.7 K at 500 kPa), the sublimation points within
/// 0.07 K of IAPWS R14-08. A substance that sublimes at 101325 Pa (carbon dioxide) has its sublimation point there in
/// boilingPoint0; its boiling line then starts at the triple point. Not modelled: mixtures, retrograde melting lines.
struct PhaseDiagram {
  double meltingPoint0 = 0, boilingPoint0 = 0;       ///< K at 101325 Pa; 0: never melts, never boils
  double latentHeatVaporization = 0;                 ///< J/kg at boilingPoint0 (of sublimers: at the triple point)
  double latentHeatSublimation = 0;                  ///< J/kg at the triple point
  double molarMass = 0;                              ///< kg/mol; 0: the boiling point does not depend on pressure
  double tripleTemperature = 0, triplePressure = 0;  ///< K, Pa; 0: none known
  double criticalTemperature = 0;                    ///< K; 0: none known
  double meltingSlope = 0;                           ///< K/Pa, of the melting line

  /// K at a pressure in Pa; infinity for what never boils. Monotone in the pressure; never above the critical
  /// temperature, where the difference between liquid and vapour ends.
  double boilingPoint(double pressure) const;
  double sublimationPoint(double pressure) const;  ///< K
  double meltingPoint(double pressure) const;      ///< K
  /// True where the solid turns to vapour without a liquid.
  bool sublimes(double pressure) const;

  /// True for what sublimes at 101325 Pa.
  bool sublimesAtReference() const;
  /// K, where latentHeatVaporization holds: boilingPoint0, or the triple point of what sublimes at 101325 Pa.
  double boilingReference() const;

  struct BoilingLine {
    double temperature = 0, pressure = 0;  ///< K, Pa: the point it starts from
    double a = 0, b = 0;                   ///< K, 1
  };
  /// Coefficients of the boiling line; molarMass must be above 0.
  BoilingLine boilingLine() const;
};

}  // namespace ps
