// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/heatingcurve.h"
#include "core/matter/material.h"
#include "ui/library/materiallibrary.h"

#include <QtWidgets/QWidget>

#include <array>
#include <vector>

namespace ps {

/// Two materials and what becomes of them: the phases of each over temperature, and how each warms with the heat that a
/// kilogram gets, from the coldest solid on, under the air's usual pressure.
class MixPreview : public QWidget {
  Q_OBJECT
 public:
  enum Which { First, Second, Mixed, kCount };
  explicit MixPreview(QWidget* parent = nullptr);
  /// Without a mixture, the two alone.
  void showMaterials(const Material& first, const Material& second, const Material* mixture);
  const std::vector<HeatingCorner>& curve(Which which) const { return m_curves[which]; }
  QSize minimumSizeHint() const override { return {420, 190}; }
  QSize sizeHint() const override { return {560, 210}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintBars(QPainter& painter) const;
  void paintCurves(QPainter& painter) const;
  QColor colourOf(int which) const;
  std::array<QString, kCount> m_labels;
  std::array<std::vector<PhaseBand>, kCount> m_bands;
  std::array<std::vector<HeatingCorner>, kCount> m_curves;
};

}  // namespace ps
