// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/timeplot.h"

#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

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

void TimePlot::paintBehind(QPainter& painter) {
  const auto [first, last] = range();
  const QRectF plot = plotRect();
  if (m_present >= first && m_present <= last)
    paintVerticalLine(painter, x(m_present) - 0.5, plot.top(), plot.bottom(), Theme::current()[Token::Accent]);
}

}  // namespace ps
