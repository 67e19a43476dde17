// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

/// Density in kg/m3 of an ideal gas of `molarMass` kg/mol at a pressure in Pa and a temperature in K; below 20 K the
/// law is not asked and that of 20 K stands.
double idealGasDensity(double pressure, double molarMass, double temperature);
double airDensity(double pressure, double temperature);  ///< kg/m3, dry air

/// Upward acceleration as a multiple of g of a parcel in air that is `ratio` times as dense as it: Archimedes' force on
/// the parcel's mass and the air that it must push aside, (ratio - 1)/(1 + C ratio), C the added mass coefficient.
double parcelLift(double ratio, double addedMass);

/// Rate k in 1/m of quadratic drag dv/dt = -k |v| v on a sphere of diameter `diameter` m in air `ratio` times as dense:
/// k = 3 Cd ratio/(4 D).
double dragRate(double ratio, double dragCoefficient, double diameter);

}  // namespace ps
