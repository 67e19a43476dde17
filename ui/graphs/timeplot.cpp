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
  const QFont font = Theme::font(TextRole::Small);
  for (const auto& [time, name] : m_markers) {
    if (time < first || time > last) continue;
    paintVerticalLine(painter, x(time) - 0.5, plot.top(), plot.bottom(), theme[Token::ControlEdge]);
    const double wide = textWidth(name, font) + 1;
    const QRectF place(labelLeft(x(time) - 4, wide), plot.bottom() - 17, wide, 15);
    QColor ground = theme[Token::Field];
    ground.setAlphaF(0.75f);
    painter.fillRect(place.adjusted(-2, 1, 2, -1), ground);
    paintText(painter, place, Qt::AlignLeft | Qt::AlignVCenter, name, font, theme[Token::Muted]);
  }
  if (m_present >= first && m_present <= last)
    paintVerticalLine(painter, x(m_present) - 0.5, plot.top(), plot.bottom(), Theme::current()[Token::Accent]);
}

}  // namespace ps
