// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/experiments/casemeasure.h"
#include "ui/graphs/graphview.h"

namespace ps {

/// A graph on which a wanted curve is drawn by hand: a drag draws, over what it passes anew; Del clears.
class WantedView : public GraphView {
  Q_OBJECT
 public:
  explicit WantedView(QWidget* parent = nullptr);
  /// Ascending in time, in the graph's unit.
  const Series& wanted() const { return m_wanted; }
  void setWanted(Series wanted);

 Q_SIGNALS:
  void wantedChanged();  ///< at the end of a stroke, and when it is cleared

 protected:
  bool hasData() const override;
  double lastTime() const override;
  std::pair<double, double> valueExtent(size_t axis, double first, double last) const override;
  void paintData(QPainter& painter) override;
  std::vector<PlotLine> readOut(double time) const override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void drawTo(const QPointF& at);
  Series m_wanted;
  bool m_drawing = false;
  QPointF m_last;                      ///< of the stroke, logical pixels
  std::pair<double, double> m_held{};  ///< the value axis while a stroke goes on: it stays under the hand
};

}  // namespace ps
