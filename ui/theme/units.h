// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>

#include <array>
#include <optional>

namespace ps {

/// What a unit means: SI value = number * scale + offset, and the exponents of m, kg, s, K, mol, rad.
struct Unit {
  double scale = 1, offset = 0;
  std::array<int, 6> dimension{};
  bool operator==(const Unit&) const = default;
};

/// Reads "W/(m·K)", "W/m·K" (everything after a slash divides), "kJ/kg", "mPa·s", "1/K", "m²", "s^-1", "°C", "%", "×",
/// "". nullopt for what is no unit. Only a lone temperature (°C, °F) has an offset.
std::optional<Unit> parseUnit(const QString& text);

/// How people want to see temperatures, everywhere in the program; inside and in files they stay in kelvin.
enum class TemperatureUnit { Celsius, Kelvin, Fahrenheit };
TemperatureUnit temperatureUnit();  ///< any thread
void setTemperatureUnit(TemperatureUnit unit);
QString temperatureSymbol();             ///< "°C"
double shownTemperature(double kelvin);  ///< in that unit
double kelvinOf(double shown);           ///< and back
double degreesPerKelvin();               ///< of a difference
/// "20.5 °C"
QString temperatureText(double kelvin, int decimals);

}  // namespace ps
