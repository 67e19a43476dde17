// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/curves/curvetarget.h"

#include <QtWidgets/QWidget>

namespace ps {

/// A curve of another material, for comparison.
struct OverlayCurve {
  std::string material;
  QString label;
  Response response;
};

/// The response that is tuned, over temperature: axes in the units that people see, logarithmic where declared. Points
/// are dragged (Shift fine, Ctrl up and down only, Alt all of them), added by a double click on the curve, removed by
/// Del, nudged by arrows (Shift fine); Page up and down choose; the wheel zooms, F fits. Smooth pieces have handles at
/// the selected point: dragged, they state the slope on both of its sides (Ctrl on one). Esc takes a drag back.
/// A material that is dropped on it, or a body's, is drawn beside it. Below it a histogram of where the material's
/// particles are. Accessible as a chart that says its value.
class CurveView : public QWidget {
  Q_OBJECT
 public:
  explicit CurveView(CurveTarget& target, QWidget* parent = nullptr);

  void fit();            ///< both axes around points, melting range and particles
  void showParticles();  ///< where they are now; as often as the caller thinks fit
  void setOverlays(std::vector<OverlayCurve> overlays);
  const MaterialNow& particles() const { return m_now; }
  QString summary() const;  ///< what it shows, as a sentence

  QRectF plot() const;
  /// Logical pixels of a temperature in K and a value, and back.
  QPointF at(double kelvin, double value) const;
  /// Of the selected point, before it and after it; nothing where no smooth piece meets it there.
  std::optional<QPointF> handleAt(bool after) const;
  double kelvinAt(double x) const;
  double valueAt(double y) const;
  QSize sizeHint() const override { return {640, 420}; }
  QSize minimumSizeHint() const override { return {300, 220}; }

 protected:
  bool event(QEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  bool logarithmic() const;
  double level(double value) const;
  double ofLevel(double level) const;
  double levelSlope(double value) const;
  double bounded(double value) const;
  bool hasLeft(const Response& before) const;
  int pointAt(const QMouseEvent& event) const;
  /// What the pointer holds: a point, or a handle of the selected one.
  enum class Grip { None, Point, Before, After };
  Grip gripAt(const QMouseEvent& event) const;
  void dragTo(const QPointF& position, Qt::KeyboardModifiers modifiers);
  void turnTo(const QPointF& position, bool oneSide);
  void dropDrag(bool keep);
  void nudge(double x, double y, bool fine);
  void walk(int index);
  void removeChosen();
  void addAt(double kelvin, double value);
  QRectF histogram() const;
  void paintGrid(QPainter& painter) const;
  void paintBands(QPainter& painter) const;
  void paintCurves(QPainter& painter) const;
  void paintLine(QPainter& painter, const Response& response, const QColor& colour, double width, bool dashed) const;
  void paintHandles(QPainter& painter) const;
  void paintMarker(QPainter& painter) const;
  void paintHistogram(QPainter& painter) const;

  CurveTarget& m_target;
  Response m_shown;
  std::vector<OverlayCurve> m_overlays;
  MaterialNow m_now;
  double m_first = 250, m_last = 350;  ///< K
  double m_low = 0, m_high = 1;        ///< levels: log10 of the value on a logarithmic axis
  Grip m_grip = Grip::None;
  Response m_before;               ///< a drag's start
  QPointF m_from, m_way, m_start;  ///< px: where the pointer was last, how far it has moved the grip, where that began
};

}  // namespace ps
