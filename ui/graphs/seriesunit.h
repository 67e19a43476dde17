// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/theme/units.h"

#include <QtCore/QString>

#include <string>

namespace ps {

/// How values of an SI unit are shown in graphs: kelvin as people prefer it, kilograms in grams, pure numbers without a
/// unit. shown = scale (stored - zero).
struct SeriesUnit {
  QString shown;
  double zero = 0, scale = 1;
  explicit SeriesUnit(const std::string& unit) : shown(QString::fromStdString(unit == "1" ? "" : unit)) {
    if (unit == "K") shown = temperatureSymbol(), zero = kelvinOf(0), scale = degreesPerKelvin();
    if (unit == "kg") shown = QStringLiteral("g"), scale = 1000;
  }
  double of(double stored) const { return scale * (stored - zero); }
  double stored(double value) const { return value / scale + zero; }
};

}  // namespace ps
