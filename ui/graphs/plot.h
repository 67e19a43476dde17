// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/graphs/valueaxis.h"
#include "ui/session/sourcemime.h"

#include <QtCore/QRectF>
#include <QtCore/QString>
#include <QtWidgets/QWidget>

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace ps {

/// A line of a box over a plot: what, and how much. `series`: of the curve whose colour marks it; -1: none.
struct PlotLine {
  QString name, value;
  int series = -1;
};

/// What all graphs share: an axis along which data lie, axes of values, zoom by the wheel (with Ctrl of the values),
/// drag to pan, double-click to fit, the read-out under the pointer, two cursors A and B (keys 1 and 2 while it has the
/// focus, dragged, arrows move the last one, Escape takes them away) with a box of what lies between them, a menu, and
/// curves that are dropped on it. Derived classes draw the data.
class Plot : public QWidget {
  Q_OBJECT
 public:
  explicit Plot(QWidget* parent = nullptr);
  ~Plot() override;

  void setTitle(const QString& title);  ///< "Temperature"
  QString title() const;
  void editTitle();                          ///< in its place: Enter ends it with titleEdited(), Escape without
  QString axisTitle() const;                 ///< with the unit of its axis, as of the last paint
  void setEmptyText(const QString& text);    ///< shown while there is no data
  void setUnit(const QString& unit);         ///< of the first axis of values, without a prefix
  void setLogarithmic(bool on);              ///< the axes of values
  void setRange(double first, double last);  ///< along; a zoom by program
  std::pair<double, double> range() const;
  bool isFitted() const;  ///< the range follows the data
  /// Of an axis of values, a zoom by program; nothing: it follows the data. One that there is not is ignored.
  void setValueRange(size_t axis, const std::optional<std::pair<double, double>>& range);
  void fit();  ///< all axes
  /// The values at the end of the data, in words: what a screen reader says.
  QString summary() const;
  /// Rectangle of the plot itself, without axes and labels.
  QRectF plotRect() const;
  const std::vector<ValueAxis>& axes() const;
  /// Cursor A (0) or B (1); nothing: it is not there.
  void setReading(size_t which, std::optional<double> at);
  std::optional<double> reading(size_t which) const;
  /// What lies between both cursors; empty without them.
  std::vector<PlotLine> measured() const;
  /// What keys and buttons do here: {"Ctrl and wheel", "Zoom values"}.
  static std::vector<std::pair<QString, QString>> gestures();
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 Q_SIGNALS:
  void rangeChanged(double first, double last);  ///< by the user
  void fitted();                                 ///< by the user
  void menuRequested(const QPoint& global);
  void titleEdited(const QString& title);
  void sourceDropped(const QString& source);  ///< see kSourceMime

 protected:
  virtual bool hasData() const = 0;
  virtual std::pair<double, double> fittedRange() const = 0;
  virtual std::pair<double, double> valueExtent(size_t axis, double first, double last) const = 0;
  virtual void paintData(QPainter& painter) = 0;
  virtual void paintLabels(QPainter& painter) = 0;
  virtual QString unitAlong() const = 0;
  /// How a place along is told: "12.50 s".
  virtual QString placeText(double at) const = 0;
  virtual std::vector<PlotLine> readOut(double at) const = 0;
  virtual std::vector<PlotLine> measure(double from, double to) const = 0;
  virtual double summaryPlace() const;
  virtual void clicked(double /*at*/) {}
  std::vector<ValueAxis>& valueAxes();
  double x(double at) const;  ///< logical pixels
  double y(double value, size_t axis = 0) const;
  double placeAt(double x) const;
  /// Height of the strip at the plot's top that belongs to its title, logical pixels.
  double titleStrip() const;
  /// The range of an axis that shows `low` to `high` with some room, and below the title.
  std::pair<double, double> roomFor(size_t axis, double low, double high, double margin) const;
  /// Left edge of a label of this width: right of a place where the plot has room, else left of it, else as far to the
  /// right as it fits.
  double labelLeft(double place, double width) const;
  QRectF headingRect() const;  ///< empty without a title
  void paintHeading(QPainter& painter) const;
  void dataChanged();                     ///< schedules a repaint
  virtual void paintBehind(QPainter&) {}  ///< over the data, below the labels

  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void changeEvent(QEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dragLeaveEvent(QDragLeaveEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  struct Private;
  void measureAxes();
  void paintAlong(QPainter& painter) const;
  void paintReadOut(QPainter& painter) const;
  void paintReadings(QPainter& painter) const;
  void paintLines(QPainter& painter, std::pair<double, double> beside, const std::vector<PlotLine>& lines,
                  double& widest) const;
  void drag(const QPointF& to);
  std::unique_ptr<Private> d;
};

/// A value with the prefix of its own: "76.40 MJ", "−0.9000 °C".
QString amountText(double value, const QString& unit, int significant = 4);

}  // namespace ps
