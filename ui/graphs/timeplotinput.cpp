// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/timeplot.h"
#include "ui/graphs/timeplot_p.h"

#include <QtGui/QKeyEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QWheelEvent>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ps {
namespace {

constexpr double kClick = 4;        ///< pixels; a shorter movement is a click
constexpr double kShortest = 0.05;  ///< s, the narrowest range

}  // namespace

void TimePlot::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !plotRect().contains(event->position())) return;
  d->pressed = true;
  d->panning = false;
  d->pressedAt = event->position();
  std::tie(d->pressedFirst, d->pressedLast) = timeRange();
}

void TimePlot::mouseMoveEvent(QMouseEvent* event) {
  d->hover = event->position();
  if (d->pressed && (d->panning || std::abs(d->hover.x() - d->pressedAt.x()) >= kClick)) {
    d->panning = true;
    setCursor(Qt::ClosedHandCursor);
    const double span = d->pressedLast - d->pressedFirst;
    const double shift = (d->pressedAt.x() - d->hover.x()) / plotRect().width() * span;
    setTimeRange(d->pressedFirst + shift, d->pressedLast + shift);
    Q_EMIT timeRangeChanged(d->first, d->last);
  }
  update();
}

void TimePlot::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !d->pressed) return;
  d->pressed = false;
  unsetCursor();
  if (!d->panning) Q_EMIT seekRequested(timeAt(event->position().x()));
  d->panning = false;
  update();
}

void TimePlot::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  fit();
  Q_EMIT fitted();
}

void TimePlot::leaveEvent(QEvent*) {
  d->hover = QPointF(-1, -1);
  update();
}

void TimePlot::wheelEvent(QWheelEvent* event) {
  const double steps = event->angleDelta().y() / 120.0;
  if (steps == 0 || !hasData()) {
    event->ignore();
    return;
  }
  event->accept();
  const auto [first, last] = timeRange();
  const double about = std::clamp(timeAt(event->position().x()), first, last);
  const double longest = 4 * std::max({d->duration, lastTime(), 1.0});
  const double span = std::clamp((last - first) * std::pow(0.8, steps), kShortest, longest);
  const double share = (about - first) / (last - first);
  setTimeRange(about - share * span, about + (1 - share) * span);
  Q_EMIT timeRangeChanged(d->first, d->last);
}

void TimePlot::keyPressEvent(QKeyEvent* event) {
  const bool in = event->key() == Qt::Key_Plus, out = event->key() == Qt::Key_Minus;
  if (!in && !out) {
    QWidget::keyPressEvent(event);
    return;
  }
  const auto [first, last] = timeRange();
  const double middle = (first + last) / 2, half = (last - first) / 2 * (in ? 0.8 : 1.25);
  setTimeRange(middle - half, middle + half);
  Q_EMIT timeRangeChanged(d->first, d->last);
}

void TimePlot::changeEvent(QEvent* event) {
  if (event->type() == QEvent::StyleChange || event->type() == QEvent::PaletteChange) update();
  QWidget::changeEvent(event);
}

}  // namespace ps
