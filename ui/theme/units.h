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

}  // namespace ps
