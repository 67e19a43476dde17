// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/graphs/timeplot.h"

#include <QtCore/QString>

#include <memory>
#include <vector>

namespace ps {

class SampleSeries;

/// A dashed line across a graph: {0, "melts"}. In the unit of its first axis.
struct ReferenceLine {
  double value = 0;
  QString label;
};

/// Lines over time, fed live: the minimum and maximum of each pixel column are drawn, so no spike is lost at any zoom.
/// Lines of one unit share an axis.
class GraphView : public TimePlot {
  Q_OBJECT
 public:
  explicit GraphView(QWidget* parent = nullptr);
  ~GraphView() override;

  /// Adds a line; returns its index. Values are in the unit, as people see it (convert before: kelvin to °C); without
  /// one they are of the first axis. Colours follow the theme's series in order.
  int addSeries(const QString& name, const QString& unit = {});
  int seriesCount() const;
  void removeAllSeries();
  /// Adds a sample. Times ascend per series: the last one's time again replaces its value, an earlier one is ignored.
  /// A value that is not finite leaves a gap.
  void append(int series, double time, double value);
  void clear() override;         ///< keeps the lines: after a reset
  void clearSeries(int series);  ///< all samples of one
  /// The same quantities in another run are dashed lines behind these, and the read-out tells the difference. Takes
  /// those away that were there.
  void beginOther(const QString& run);
  void appendOther(int series, double time, double value);
  size_t otherCount(int series) const;
  /// Whether, where there is another run, this one's difference from it is a dotted line on an axis of its own.
  void setDifference(bool on);
  /// Its value at a time in s; NaN where there is none.
  double differenceAt(int series, double time) const;
  const QString& otherRun() const;  ///< its name; "": there is none
  void setReferenceLines(std::vector<ReferenceLine> lines);
  /// Samples of a series as drawn in a column [first, last): lowest and highest; nothing: {NaN, NaN}.
  std::pair<double, double> extent(int series, double first, double last) const;
  size_t sampleCount(int series) const;

 protected:
  bool hasData() const override;
  double lastTime() const override;
  std::pair<double, double> valueExtent(size_t axis, double first, double last) const override;
  void paintData(QPainter& painter) override;
  void paintLabels(QPainter& painter) override;
  std::vector<PlotLine> readOut(double time) const override;
  std::vector<PlotLine> measure(double from, double to) const override;

 private:
  struct Private;
  void layOutAxes();
  void makeDifferences() const;
  void paintReferences(QPainter& painter) const;
  void paintDifferences(QPainter& painter, double perColumn) const;
  void paintSeries(QPainter& painter, const SampleSeries& samples, size_t axis, double perColumn) const;
  std::unique_ptr<Private> d;
};

}  // namespace ps
