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

/// Density of boiling matter as a share of the liquid's by the thesis's law (eq. 4.9) at a vaporised fraction 0 to 1,
/// as printed: 0.0025 at 1. The thesis's own table ends at 0.7, see thesisVolume().
double thesisDensityScale(double fraction);
/// Volume of boiling matter as a multiple of the liquid's: the inverse of thesisDensityScale() held to 0.7 at least,
/// the density of gas in the thesis's table 4.3.
double thesisVolume(double fraction);
/// Acceleration in m/s2 against the direction of gravity by the thesis's law (eq. 4.10): -9.8 for liquid, +1 for
/// vapour, nearly a jump at the end. It holds for no other gravity.
double thesisGravity(double fraction);

}  // namespace ps
