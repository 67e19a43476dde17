// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/graphs/timeplot.h"
#include "ui/theme/numbers.h"

#include <limits>

namespace ps {

struct TimePlot::Private {
  QString title;
  QString emptyText = QStringLiteral("Drag a probe here to plot it");
  double duration = 0;
  double present = std::numeric_limits<double>::quiet_NaN();
  bool fitted = true;
  double first = 0, last = 10;  ///< s, shown while not fitted
  double low = 0, high = 1;     ///< values shown, as of the last paint
  QString unit;                 ///< see setPrefixedUnit
  UnitPrefix prefix;            ///< of the value axis, as of the last paint
  Ticks values;                 ///< of the value axis, as of the last paint
  double left = 0;              ///< room for the value axis, logical pixels, as of the last paint
  QPointF hover{-1, -1};        ///< outside: no read-out
  bool pressed = false, panning = false;
  QPointF pressedAt;
  double pressedFirst = 0, pressedLast = 0;
};

}  // namespace ps
