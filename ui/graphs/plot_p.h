// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/graphs/plot.h"

namespace ps {

struct Plot::Private {
  QString title;
  QString emptyText = QStringLiteral("Drag a probe here to plot it");
  std::vector<ValueAxis> axes = std::vector<ValueAxis>(1);
  bool fitted = true;
  double first = 0, last = 10;                    ///< shown while not fitted
  double left = 0, right = 0;                     ///< room for axes of values, logical pixels, as of the last paint
  QPointF hover{-1, -1};                          ///< outside: no read-out
  std::array<std::optional<double>, 2> readings;  ///< cursors A and B
  size_t active = 0;                              ///< the cursor that was set last
  std::optional<size_t> held;                     ///< the cursor that is dragged
  bool pressed = false, panning = false, dropping = false;
  QPointF pressedAt;
  double pressedFirst = 0, pressedLast = 0;
  std::vector<std::optional<std::pair<double, double>>> pressedZoom;  ///< of the axes
  mutable double readOutWidth = 0, measuredWidth = 0;  ///< of columns of values: they grow, and so nothing jitters
};

}  // namespace ps
