// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QRectF>
#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtWidgets/QWidget>

#include <memory>
#include <utility>

namespace ps {

/// Positions of an axis' ticks: the finest step of 1, 2, 2.5 or 5 times a power of ten that gives at most `most` ticks.
struct Ticks {
  double first = 0, step = 1;
  int count = 0;
  int decimals = 0;  ///< that tell the ticks apart
  double at(int index) const { return first + index * step; }
};
Ticks niceTicks(double low, double high, int most);
/// A tick's label, with as many digits as tell it from its neighbours.
QString tickText(const Ticks& ticks, int index);
/// A value beside a curve: three significant digits (four from 100 on), but at least the decimals of the axis' labels
/// and at most one more, so that what is nearly zero reads "0.0" on an axis of tens.
QString curveText(const Ticks& axis, double value);

/// What live plots share: the time axis (s), zoom by wheel, drag to pan, double-click to fit, the cursor line of the
/// present time, the read-out under the pointer. Derived classes draw values.
class TimePlot : public QWidget {
  Q_OBJECT
 public:
  explicit TimePlot(QWidget* parent = nullptr);
  ~TimePlot() override;

  void setTitle(const QString& title);  ///< "Temperature, °C"
  QString title() const;
  QString axisTitle() const;  ///< with the unit of the axis as of the last paint, where it takes a prefix
  /// Unit of the values without a prefix, "J" or "g": the axis takes the prefix that suits it, and the title says it.
  /// "" for values that are shown as they are.
  void setPrefixedUnit(const QString& unit);
  void setEmptyText(const QString& text);  ///< shown while there is no data
  /// The axis shows at least [0, seconds] while it is fitted; longer data extend it.
  void setDuration(double seconds);
  /// Line of the present time; NaN hides it.
  void setPresentTime(double seconds);
  void setTimeRange(double first, double last);  ///< s; a zoom by program
  std::pair<double, double> timeRange() const;
  bool isFitted() const;  ///< the range follows the data
  void fit();
  /// The values at the end of the data, in words: what a screen reader says.
  QString summary() const;
  /// Rectangle of the plot itself, without axes and labels.
  QRectF plotRect() const;
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 Q_SIGNALS:
  void timeRangeChanged(double first, double last);  ///< by the user; connect plots to one another with setTimeRange
  void fitted();                                     ///< by the user
  void seekRequested(double seconds);                ///< clicked

 protected:
  virtual bool hasData() const = 0;
  virtual double lastTime() const = 0;  ///< s, of the data
  virtual std::pair<double, double> valueExtent(double first, double last) const = 0;
  virtual void paintData(QPainter& painter) = 0;
  virtual void paintLabels(QPainter& painter) = 0;
  /// Lines of the read-out at a time.
  virtual QStringList readOut(double time) const = 0;
  double x(double time) const;  ///< logical pixels
  double y(double value) const;
  double timeAt(double x) const;
  double presentTime() const;
  const Ticks& valueTicks() const;    ///< of the value axis, as of the last paint, in its unit with prefix
  double onAxis(double value) const;  ///< a value in the unit of the axis
  QString prefixedUnit() const;
  /// Height of the strip at the plot's top that belongs to its title, logical pixels.
  double titleStrip() const;
  /// Upper end of a value axis from `low` on, so that `high` stays below the title.
  double clearOfTitle(double low, double high) const;
  void dataChanged();  ///< schedules a repaint

  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  struct Private;
  void paintReadOut(QPainter& painter) const;
  std::unique_ptr<Private> d;
};

}  // namespace ps
