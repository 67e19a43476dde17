// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/heatingcurve.h"
#include "core/matter/phasediagram.h"
#include "ui/curves/curvetarget.h"

#include <QtWidgets/QWidget>

#include <vector>

namespace ps {

/// What a material does as it is heated, or at which temperature and pressure it is what, from its data as the scene
/// has changed them, with its particles on it: the mean of those of each phase, and how many they are.
class MatterDiagram : public QWidget {
  Q_OBJECT
 public:
  enum class Kind { Heating, Phases };
  MatterDiagram(Kind kind, Session& session, CurveTarget& target, QWidget* parent = nullptr);
  QString caption() const;  ///< of what at which pressure, and the summary
  QString summary() const;  ///< how many particles are in which phase, or why there is no diagram
  const std::vector<HeatingCorner>& corners() const { return m_corners; }
  QSize minimumSizeHint() const override { return {260, 100}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  struct Axis {
    double first = 0, last = 1;
  };
  void rebuild();
  void showParticles();
  QRectF plot() const;
  QPointF at(double x, double y) const;
  void paintAxes(QPainter& painter) const;
  void paintHeating(QPainter& painter) const;
  void paintPhases(QPainter& painter) const;
  void paintDot(QPainter& painter, const QPointF& centre, size_t phase) const;
  Kind m_kind;
  Session& m_session;
  CurveTarget& m_target;
  QString m_problem;
  std::vector<HeatingCorner> m_corners;
  PhaseDiagram m_diagram;
  double m_pressure = 101325;  ///< Pa
  Axis m_x, m_y;               ///< kJ/kg and °C; or °C and the decimal logarithm of Pa
  MaterialNow m_now;
};

}  // namespace ps
