// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/timeplot.h"

#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>

#include <algorithm>

namespace ps {

void TimePlot::setDuration(double seconds) {
  if (m_duration == seconds) return;
  m_duration = seconds;
  update();
}

void TimePlot::setPresentTime(double seconds) {
  if (m_present == seconds) return;
  m_present = seconds;
  update();
}

std::pair<double, double> TimePlot::fittedRange() const {
  const double last = std::max(m_duration, hasData() ? lastTime() : 0.0);
  return {0, last > 0 ? last : 10};
}

QString TimePlot::placeText(double at) const { return formatFixed(at, 2) + QStringLiteral(" s"); }

void TimePlot::setMarkers(std::vector<std::pair<double, QString>> markers) {
  if (m_markers == markers) return;
  m_markers = std::move(markers);
  update();
}

void TimePlot::paintBehind(QPainter& painter) {
  const auto [first, last] = range();
  const QRectF plot = plotRect();
  const Theme& theme = Theme::current();
  for (const auto& [time, name] : m_markers) {
    if (time >= first && time <= last)
      paintVerticalLine(painter, x(time) - 0.5, plot.top(), plot.bottom(), theme[Token::ControlEdge]);
  }
  if (m_present >= first && m_present <= last)
    paintVerticalLine(painter, x(m_present) - 0.5, plot.top(), plot.bottom(), theme[Token::Accent]);
}

QRectF TimePlot::markerPlace(double time, double width, const std::vector<QRectF>& taken) const {
  constexpr double kHeight = 15, kRows = 3;
  const QRectF plot = plotRect();
  const auto isFree = [&](const QRectF& place) {
    return std::none_of(taken.begin(), taken.end(), [&](const QRectF& other) { return other.intersects(place); });
  };
  for (int row = 0; row < kRows; ++row) {
    const double top = plot.bottom() - 17 - row * kHeight;
    for (const double left : {labelLeft(x(time) - 4, width), x(time) - 4 - width}) {
      const QRectF place(left, top, width, kHeight);
      if (plot.contains(place) && isFree(place.adjusted(-2, 1, 2, -1))) return place;
    }
  }
  return {};
}

void TimePlot::paintMarkerNames(QPainter& painter, std::vector<QRectF> taken) const {
  const auto [first, last] = range();
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Small);
  QColor ground = theme[Token::Field];
  ground.setAlphaF(0.75f);
  for (const auto& [time, name] : m_markers) {
    if (time < first || time > last) continue;
    const QRectF place = markerPlace(time, textWidth(name, font) + 1, taken);
    if (place.isEmpty()) continue;
    painter.fillRect(place.adjusted(-2, 1, 2, -1), ground);
    paintText(painter, place, Qt::AlignLeft | Qt::AlignVCenter, name, font, theme[Token::Muted]);
    taken.push_back(place);
  }
}

}  // namespace ps
