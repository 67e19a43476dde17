// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/heatingcurve.h"
#include "core/matter/material.h"
#include "ui/film/swatch.h"
#include "ui/library/materiallibrary.h"

#include <QtWidgets/QWidget>

#include <array>
#include <optional>
#include <vector>

namespace ps {

class Swatches;

/// Two materials and what becomes of them: how each looks, the phases of each over temperature, and how each warms with
/// the heat that a kilogram gets, from the coldest solid on, under the air's usual pressure.
class MixPreview : public QWidget {
  Q_OBJECT
 public:
  enum Which { First, Second, Mixed, kCount };
  explicit MixPreview(Swatches& swatches, QWidget* parent = nullptr);
  /// Without a mixture, the two alone.
  void showMaterials(const Material& first, const Material& second, const Material* mixture);
  const std::vector<HeatingCorner>& curve(Which which) const { return m_curves[which]; }
  const std::optional<Swatch>& swatch(Which which) const { return m_looks[which]; }
  QSize minimumSizeHint() const override { return {420, 240}; }
  QSize sizeHint() const override { return {560, 260}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintBars(QPainter& painter) const;
  void paintCurves(QPainter& painter) const;
  QColor colourOf(int which) const;
  std::array<QString, kCount> m_labels;
  Swatches& m_swatches;
  std::array<std::optional<Swatch>, kCount> m_looks;
  std::array<std::vector<PhaseBand>, kCount> m_bands;
  std::array<std::vector<HeatingCorner>, kCount> m_curves;
};

}  // namespace ps
