// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QPointF>
#include <QtCore/QRectF>
#include <QtCore/QString>

#include <functional>
#include <vector>

class QPainter;

namespace ps {

/// What a line is called and where it stands now, written at its end. Logical pixels.
struct EndLabel {
  QPointF end;     ///< of the line
  int series = 0;  ///< by which its colour goes
  QString name, value;
  double valueWidth = 0;  ///< that the longest value takes
  double top = 0;         ///< of its text
};

/// Paints a dot at each end and beside it the label, from the top down as near to its line as keeps texts apart:
/// `leftOf(place, width)` is where it begins. Where `room` is too low for all of them they stand in it in columns
/// instead, each after a dot of its colour; without their values, elided, and counted at the end, as there is less
/// room. False: a name is not there as a whole. `taken` gets where they stand.
bool paintEndLabels(QPainter& painter, std::vector<EndLabel> labels, const QRectF& room,
                    const std::function<double(double, double)>& leftOf, std::vector<QRectF>& taken);

}  // namespace ps
