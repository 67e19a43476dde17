// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"
#include "core/matter/phaselines.h"

#include <QtWidgets/QWidget>

#include <utility>
#include <vector>

namespace ps {

struct LibraryEntry;

/// In which phase materials are over temperature and pressure, in the colours of the phases: a picture of each side by
/// side, with one scale for all that are shown, and lines where rooms and the air's usual pressure are. Its tooltip and
/// its accessible description say the same.
class PhaseView : public QWidget {
  Q_OBJECT
 public:
  explicit PhaseView(QWidget* parent = nullptr);
  void showMaterials(const std::vector<const LibraryEntry*>& entries);
  QSize sizeHint() const override { return {240, 132}; }
  QSize minimumSizeHint() const override { return {120, 132}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Shown {
    QString label;
    Material values;
    PhaseLines lines;
  };
  using Spans = std::vector<std::pair<double, double>>;  ///< px, from and to, of each row of a picture
  void paintRegions(QPainter& painter, const QRectF& plot, const Shown& shown) const;
  void paintLines(QPainter& painter, const QRectF& plot, const Shown& shown) const;
  void paintAxes(QPainter& painter, const QRectF& plot, bool pressures) const;
  QPointF placeOf(const QRectF& plot, const PhasePoint& point) const;
  std::vector<Shown> m_shown;
  double m_cold = 0, m_hot = 1;  ///< K, ends of the axis
};

}  // namespace ps
