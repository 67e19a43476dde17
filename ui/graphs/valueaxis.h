// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/theme/numbers.h"

#include <QtCore/QRectF>
#include <QtCore/QString>

#include <optional>
#include <utility>

class QPainter;

namespace ps {

/// Positions of an axis' ticks: the finest step of 1, 2, 2.5 or 5 times a power of ten that gives at most `most` ticks.
struct Ticks {
  double first = 0, step = 1;
  int count = 0;
  int decimals = 0;      ///< that tell the ticks apart
  bool decades = false;  ///< `first` and `step` are of the logarithm to base ten
  double at(int index) const;
};
Ticks niceTicks(double low, double high, int most);
/// Powers of ten within [low, high], both above 0; of less than two decades as niceTicks().
Ticks logTicks(double low, double high, int most);
/// A tick's label, with as many digits as tell it from its neighbours.
QString tickText(const Ticks& ticks, int index);
/// A value beside a curve, with the decimals of the axis' labels and one more where they leave room for it: as many for
/// every value, so that it keeps its width while it runs.
QString curveText(const Ticks& axis, double value);
/// Room that curveText() needs for whatever lies on an axis from `low` to `high`, logical pixels of the small font.
double curveTextWidth(const Ticks& axis, double low, double high);

/// An axis of values, linear or logarithmic, at the left or the right of a plot.
class ValueAxis {
 public:
  QString unit;  ///< as people see it; takes a prefix where it can: "J", not "°C"
  QString mark;  ///< before the unit: "Δ " on an axis of differences, which is never logarithmic
  bool logarithmic = false;
  std::optional<std::pair<double, double>> zoom;  ///< values shown; nothing: as far as the data go
  /// Takes over what is shown; `most` ticks.
  void set(std::pair<double, double> extent, int most);
  double low() const { return m_low; }
  double high() const { return m_high; }
  /// Share of the axis below a value: 0 at its lower end; on a logarithmic one what is not above 0 lies far below.
  double position(double value) const;
  double valueAt(double position) const;
  /// Another part of it: `factor` of its length about a position, or moved by a share of it.
  void zoomAbout(double about, double factor);
  void pan(double share);
  const Ticks& ticks() const { return m_ticks; }  ///< in its unit with prefix
  double onAxis(double value) const { return value / m_prefix.factor; }
  QString shownUnit() const { return m_prefix.symbol + unit; }
  double labelWidth(bool right) const;  ///< of its tick labels, logical pixels
  void paint(QPainter& painter, const QRectF& plot, bool right, double offset) const;

 private:
  /// At the right the topmost says the unit; the title says that of the axis at the left.
  QString label(int tick, bool right) const;
  double m_low = 0, m_high = 1;
  UnitPrefix m_prefix;
  Ticks m_ticks;
};

}  // namespace ps
