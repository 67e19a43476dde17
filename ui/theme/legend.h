// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QRectF>
#include <QtCore/QSizeF>
#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtGui/QColor>

#include <utility>
#include <vector>

class QPainter;

namespace ps {

/// A colour map of resources/theme/maps.json: "temperature", "ember", "phase", "density_error", "speed".
struct ColourMap {
  QString name;
  std::vector<std::pair<double, QColor>> stops;      ///< position 0..1, ascending
  double pivot = -1;                                 ///< position that sits on the melting point; below 0: none
  std::vector<std::pair<QString, QString>> classes;  ///< letter and name of each stop where colours are classes
  QStringList patterns;  ///< of classes: "plain", "stripes", "dots", "checks", as the view draws them; may be empty
  /// Colour at a position of 0..1; `classes` are not mixed.
  QColor at(double position) const;
};
/// Throws Error when there is no such map.
const ColourMap& colourMap(const QString& name);

/// What a legend says beside its colours.
struct LegendText {
  QString title;
  QString unit;       ///< behind the upper end
  double scale = 1;   ///< numbers are divided by it: 1000 with "kJ/kg" for values in J/kg
  QString without{};  ///< in place of colours and numbers where the range has no length: "none here"
};

/// A line across the gradient, at a value in the legend's unit: {0, "melts"}.
struct LegendMark {
  double value = 0;
  QString label;
};

/// The gradient inside a legend's rectangle, from the range's upper end at its top to the lower one at its bottom.
QRectF legendBar(const QRectF& rect, const ColourMap& map);
/// Size that paintLegend wants, in logical pixels.
QSizeF legendSize(const ColourMap& map, const LegendText& text, const std::vector<LegendMark>& marks = {});

/// Draws a legend on its translucent ground over the viewport: title, gradient with ticks, phase marks; a map of
/// classes as swatches with letters. `range`: values at the ends; without a length there is nothing to show. `pivot`:
/// value at the map's pivot, where it has one: both sides are linear by themselves, up to their own ends. Where the
/// pivot lies outside of the range the bar shows one side alone, and says below where the pivot is. Marks near an end
/// have their text beside that of the end, never in its place.
void paintLegend(QPainter& painter, const QRectF& rect, const ColourMap& map, std::pair<double, double> range,
                 const LegendText& text, const std::vector<LegendMark>& marks, double pivot = 0);
/// Position 0..1 on the map of a value, with the pivot rule of paintLegend.
double legendPosition(const ColourMap& map, std::pair<double, double> range, double pivot, double value);

}  // namespace ps
