// SPDX-License-Identifier: Apache-2.0
#include "ui/fitting/wantedview.h"

#include "ui/theme/theme.h"

#include <QtGui/QKeyEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QPainter>
#include <QtGui/QPolygonF>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kEach = 8;    ///< logical pixels between two points of a stroke
constexpr double kRoom = 0.3;  ///< of the values' span, free above and below: what is wanted lies elsewhere

double valueAt(const Series& series, double time) {
  const size_t k =
      static_cast<size_t>(std::upper_bound(series.time.begin(), series.time.end(), time) - series.time.begin());
  if (k == 0 || (k == series.time.size() && series.time.back() != time)) return std::nan("");
  if (k == series.time.size()) return series.value.back();
  const double share = (time - series.time[k - 1]) / (series.time[k] - series.time[k - 1]);
  return series.value[k - 1] + share * (series.value[k] - series.value[k - 1]);
}

}  // namespace

WantedView::WantedView(QWidget* parent) : GraphView(parent) { setCursor(Qt::CrossCursor); }

void WantedView::setWanted(Series wanted) {
  m_wanted = std::move(wanted);
  dataChanged();
  Q_EMIT wantedChanged();
}

bool WantedView::hasData() const { return GraphView::hasData() || !m_wanted.time.empty(); }

double WantedView::lastTime() const {
  return std::max(GraphView::lastTime(), m_wanted.time.empty() ? 0.0 : m_wanted.time.back());
}

std::pair<double, double> WantedView::valueExtent(size_t axis, double first, double last) const {
  if (m_drawing) return m_held;
  auto [low, high] = GraphView::valueExtent(axis, first, last);
  for (const double value : m_wanted.value) low = std::min(low, value), high = std::max(high, value);
  const double room = kRoom * (high - low);
  return {low - room, high + room};
}

void WantedView::paintData(QPainter& painter) {
  GraphView::paintData(painter);
  QPolygonF line;
  for (size_t k = 0; k < m_wanted.time.size(); ++k) line << QPointF(x(m_wanted.time[k]), y(m_wanted.value[k]));
  QPen pen(Theme::current()[Token::Curve], 1.75, Qt::SolidLine, Qt::RoundCap);
  pen.setDashPattern({3, 2.5});
  painter.setPen(pen);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.drawPolyline(line);
  painter.setPen(Qt::NoPen);
  painter.setBrush(Theme::current()[Token::Curve]);
  for (const QPointF& point : line) painter.drawEllipse(point, 2.25, 2.25);
}

std::vector<PlotLine> WantedView::readOut(double time) const {
  std::vector<PlotLine> lines = GraphView::readOut(time);
  const double value = valueAt(m_wanted, time);
  if (std::isfinite(value)) lines.push_back({QStringLiteral("wanted"), amountText(value, axes()[0].unit)});
  return lines;
}

void WantedView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !hasData() || !plotRect().contains(event->position())) return;
  m_held = {axes()[0].low(), axes()[0].high()};
  m_drawing = true;
  m_last = QPointF(-1e9, 0);
  drawTo(event->position());
}

/// Takes out what the hand passes and puts the new point in its place.
void WantedView::drawTo(const QPointF& at) {
  const QRectF plot = plotRect();
  const QPointF here(std::clamp(at.x(), plot.left(), plot.right()), std::clamp(at.y(), plot.top(), plot.bottom()));
  const double value = axes()[0].valueAt((plot.bottom() - here.y()) / plot.height());
  const double time = std::max(0.0, placeAt(here.x()));
  const double from = m_last.x() < plot.left() ? here.x() - kEach / 2 : m_last.x();
  const double low = placeAt(std::min(from, here.x())), high = placeAt(std::max(from, here.x()));
  const double start = m_last.x() < plot.left() ? -1 : placeAt(m_last.x());
  Series kept;
  bool placed = false;
  const auto place = [&] {
    kept.time.push_back(time), kept.value.push_back(value);
    placed = true;
  };
  for (size_t k = 0; k < m_wanted.time.size(); ++k) {
    const double t = m_wanted.time[k];
    if (t >= low && t <= high && t != start) continue;
    if (t == time) continue;
    if (!placed && t > time) place();
    kept.time.push_back(t), kept.value.push_back(m_wanted.value[k]);
  }
  if (!placed) place();
  m_wanted = std::move(kept);
  m_last = here;
  dataChanged();
}

void WantedView::mouseMoveEvent(QMouseEvent* event) {
  if (!m_drawing) return GraphView::mouseMoveEvent(event);
  if (std::abs(event->position().x() - m_last.x()) >= kEach) drawTo(event->position());
}

void WantedView::mouseReleaseEvent(QMouseEvent* event) {
  if (!m_drawing || event->button() != Qt::LeftButton) return;
  m_drawing = false;
  dataChanged();
  Q_EMIT wantedChanged();
}

void WantedView::mouseDoubleClickEvent(QMouseEvent* event) { mousePressEvent(event); }

void WantedView::keyPressEvent(QKeyEvent* event) {
  if (event->key() != Qt::Key_Delete && event->key() != Qt::Key_Backspace) return GraphView::keyPressEvent(event);
  setWanted({});
}

}  // namespace ps
