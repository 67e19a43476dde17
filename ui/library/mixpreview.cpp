// SPDX-License-Identifier: Apache-2.0
#include "ui/library/mixpreview.h"

#include "ui/library/materialcard.h"
#include "ui/session/swatches.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"
#include "ui/theme/units.h"

#include <QtGui/QPainter>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kAround = 40;  // K on either side of the first and the last change of phase
constexpr float kShades = 24;   // a share that is dragged asks for few pictures
constexpr int kBar = 13, kSwatch = 32, kLine = 36, kGap = 8, kNames = 132, kLeft = 64, kBelow = 18, kInset = 4;

struct Range {
  double cold, hot;  ///< K
};

/// What has anything to say for one: its changes of phase, or rooms.
Range rangeOf(const api::Caloric& caloric) {
  Range range{kRoom, kRoom};
  if (caloric.melts || caloric.sublimes) range = {caloric.solidus, caloric.liquidus};
  if (std::isfinite(caloric.boilingPoint)) range.hot = std::max(range.hot, caloric.boilingPoint);
  return range;
}

}  // namespace

MixPreview::MixPreview(Swatches& swatches, QWidget* parent) : QWidget(parent), m_swatches(swatches) {
  connect(&swatches, &Swatches::arrived, this, qOverload<>(&QWidget::update));
  setAccessibleName(QStringLiteral("Phases and heating curves of the parts and of the mixture"));
}

void MixPreview::showMaterials(const Material& first, const Material& second, const Material* mixture) {
  const std::array<const Material*, kCount> all{&first, &second, mixture};
  std::array<api::Caloric, kCount> calorics{};
  Range range{1e9, 0};
  for (size_t k = 0; k < all.size(); ++k) {
    m_labels[k] = k == Mixed ? QStringLiteral("Mixture") : all[k] ? QString::fromStdString(all[k]->label) : QString();
    m_bands[k] = all[k] ? bandsOf(*all[k]) : std::vector<PhaseBand>{};
    m_curves[k].clear();
    m_looks[k].reset();
    if (!all[k]) continue;
    m_looks[k] = swatchOf(*all[k]);
    if (k == Mixed) {
      for (float& part : m_looks[k]->look) part = std::round(part * kShades) / kShades;
    }
    calorics[k] = BakedMaterial(*all[k], kAir).caloric();
    const Range own = rangeOf(calorics[k]);
    range = {std::min(range.cold, own.cold), std::max(range.hot, own.hot)};
  }
  for (size_t k = 0; k < all.size(); ++k) {
    if (!all[k]) continue;
    m_curves[k] = heatingCurve(calorics[k], std::max(1.0, range.cold - kAround), range.hot + kAround);
    const double start = m_curves[k].front().enthalpy;
    for (HeatingCorner& corner : m_curves[k]) corner.enthalpy -= start;
  }
  update();
}

QColor MixPreview::colourOf(int which) const {
  return which == Mixed ? Theme::current()[Token::Curve] : Theme::current().series(static_cast<size_t>(which));
}

void MixPreview::paintBars(QPainter& painter) const {
  for (int k = 0; k < kCount; ++k) {
    if (m_bands[static_cast<size_t>(k)].empty()) continue;
    const QRectF row(0, k * kLine + (kSwatch - kBar) / 2.0, width(), kBar);
    if (const auto& look = m_looks[static_cast<size_t>(k)])
      paintSwatch(painter, QRectF(0, k * kLine, kSwatch, kSwatch), *look, m_swatches);
    paintText(painter, QRectF(kSwatch + 6, row.top() - 2, kNames - kSwatch - 12, kBar + 4),
              Qt::AlignLeft | Qt::AlignVCenter, m_labels[static_cast<size_t>(k)], Theme::font(TextRole::Small),
              colourOf(k));
    paintBands(painter, row.adjusted(kNames, 0, 0, 0), m_bands[static_cast<size_t>(k)]);
  }
}

void MixPreview::paintCurves(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const QRectF plot(kLeft, kCount * kLine + kGap, width() - kLeft - 1, height() - kCount * kLine - kGap - kBelow);
  const QRectF drawn = plot.adjusted(kInset, kInset, -kInset, -kInset);  // lines end in sight
  double cold = 1e9, hot = 0, most = 0;
  for (const auto& curve : m_curves) {
    if (curve.empty()) continue;
    cold = std::min(cold, curve.front().temperature);
    hot = std::max(hot, curve.back().temperature);
    most = std::max(most, curve.back().enthalpy);
  }
  paintBox(painter, plot, theme[Token::Field], theme[Token::Line2], 0);
  if (!(hot > cold) || !(most > 0)) return;
  const auto at = [&](const HeatingCorner& corner) {
    return QPointF(drawn.left() + drawn.width() * corner.enthalpy / most,
                   drawn.bottom() - drawn.height() * (corner.temperature - cold) / (hot - cold));
  };
  const QFont font = Theme::font(TextRole::Small);
  const auto label = [&](double y, double kelvin) {
    paintText(painter, QRectF(0, y - 8, kLeft - 6, 16), Qt::AlignRight | Qt::AlignVCenter, temperatureText(kelvin, 0),
              font, theme[Token::Muted]);
  };
  label(plot.top() + 8, hot);
  label(plot.bottom() - 8, cold);
  paintText(painter, QRectF(plot.left(), plot.bottom() + 2, plot.width(), 16), Qt::AlignRight | Qt::AlignVCenter,
            QStringLiteral("heat, up to %1 kJ/kg").arg(formatShort(most / 1000, 3)), font, theme[Token::Muted]);
  painter.setClipRect(plot);
  painter.setBrush(Qt::NoBrush);
  for (int k = 0; k < kCount; ++k) {
    QPolygonF line;
    for (const HeatingCorner& corner : m_curves[static_cast<size_t>(k)]) line << at(corner);
    painter.setPen(QPen(colourOf(k), k == Mixed ? 2.5 : 1.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(line);
  }
}

void MixPreview::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  paintBars(painter);
  paintCurves(painter);
}

}  // namespace ps
