// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/plot.h"
#include "ui/graphs/plot_p.h"
#include "ui/theme/reach.h"

#include <QtCore/QMimeData>
#include <QtGui/QContextMenuEvent>
#include <QtGui/QDropEvent>
#include <QtGui/QKeyEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QShortcut>
#include <QtGui/QWheelEvent>
#include <QtWidgets/QLineEdit>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ps {
namespace {

constexpr double kClick = 4;         ///< pixels; a shorter movement is a click
constexpr double kGrip = 5;          ///< pixels beside a cursor that take hold of it
constexpr double kNarrowest = 1e-4;  ///< share of the data's range

bool isOwnKey(int key) { return key == Qt::Key_1 || key == Qt::Key_2 || key == Qt::Key_Plus || key == Qt::Key_Minus; }
bool movesReading(int key) { return key == Qt::Key_Left || key == Qt::Key_Right; }

}  // namespace

std::vector<std::pair<QString, QString>> Plot::gestures() {
  return {{QStringLiteral("Wheel, + and −"), QStringLiteral("Zoom along")},
          {QStringLiteral("Ctrl and wheel"), QStringLiteral("Zoom values")},
          {QStringLiteral("Drag"), QStringLiteral("Pan")},
          {QStringLiteral("Double-click"), QStringLiteral("Fit")},
          {QStringLiteral("1, 2"), QStringLiteral("Set cursor A, B")},
          {QStringLiteral("←, →"), QStringLiteral("Move the last cursor, with Shift a tenth")},
          {QStringLiteral("Esc"), QStringLiteral("Take the cursors away")},
          {QStringLiteral("Right-click"), QStringLiteral("Plot, split, export")}};
}

void Plot::editTitle() {
  auto* line = new QLineEdit(d->title, this);
  line->setAccessibleName(QStringLiteral("Title"));
  line->setMaxLength(200);
  const QRectF plot = plotRect();
  line->setGeometry(QRectF(plot.left() + 2, plot.top() + 1, std::min(220.0, plot.width() - 4), 22).toRect());
  line->selectAll();
  line->show();
  line->setFocus();
  connect(line, &QLineEdit::returnPressed, this, [this, line] { Q_EMIT titleEdited(line->text()); });
  connect(line, &QLineEdit::editingFinished, line, &QObject::deleteLater);  // also where the focus leaves
  auto* escape = new QShortcut(QKeySequence(Qt::Key_Escape), line, nullptr, nullptr, Qt::WidgetShortcut);
  connect(escape, &QShortcut::activated, this, [this] { setFocus(); });
}

/// The window has shortcuts of the same keys.
bool Plot::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    const auto* press = static_cast<QKeyEvent*>(event);
    const bool any = d->readings[0] || d->readings[1];
    const bool plain = !(press->modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier));
    if (plain && (isOwnKey(press->key()) || (any && (movesReading(press->key()) || press->key() == Qt::Key_Escape)))) {
      event->accept();
      return true;
    }
  }
  return QWidget::event(event);
}

void Plot::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !plotRect().adjusted(0, -9, 0, 0).contains(event->position())) return;
  for (size_t which = 0; which < 2; ++which) {
    const auto& at = d->readings[which];
    if (at && std::abs(x(*at) - event->position().x()) <= reachOf(*event, kGrip)) d->held = which;
  }
  d->pressed = true;
  d->panning = false;
  d->pressedAt = event->position();
  std::tie(d->pressedFirst, d->pressedLast) = range();
  d->pressedZoom.clear();
  for (const ValueAxis& axis : d->axes) d->pressedZoom.push_back(axis.zoom);
}

void Plot::mouseMoveEvent(QMouseEvent* event) {
  d->hover = event->position();
  if (d->pressed) drag(d->hover);
  update();
}

/// Values move only where they are zoomed: else they follow the data.
void Plot::drag(const QPointF& to) {
  const QPointF way = d->pressedAt - to;
  if (d->held) {
    const auto [first, last] = range();
    setReading(*d->held, std::clamp(placeAt(to.x()), first, last));
    return;
  }
  if (!d->panning && std::max(std::abs(way.x()), std::abs(way.y())) < kClick) return;
  d->panning = true;
  setCursor(Qt::ClosedHandCursor);
  for (size_t k = 0; k < d->axes.size(); ++k) {
    if (!d->pressedZoom[k]) continue;
    d->axes[k].zoom = d->pressedZoom[k];
    d->axes[k].set(*d->pressedZoom[k], 2);
    d->axes[k].pan(-way.y() / plotRect().height());
  }
  const double shift = way.x() / plotRect().width() * (d->pressedLast - d->pressedFirst);
  if (shift == 0 && d->fitted) return;
  setRange(d->pressedFirst + shift, d->pressedLast + shift);
  Q_EMIT rangeChanged(d->first, d->last);
}

void Plot::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !d->pressed) return;
  d->pressed = false;
  unsetCursor();
  if (!d->panning && !d->held) clicked(placeAt(event->position().x()));
  d->panning = false;
  d->held.reset();
  update();
}

void Plot::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  fit();
  Q_EMIT fitted();
}

void Plot::leaveEvent(QEvent*) {
  d->hover = QPointF(-1, -1);
  d->readOutWidth = 0;
  update();
}

void Plot::wheelEvent(QWheelEvent* event) {
  // Ctrl or not, some platforms turn it sideways with Alt alone.
  const double steps = event->angleDelta().y() / 120.0;
  if (steps == 0 || !hasData()) {
    event->ignore();
    return;
  }
  event->accept();
  const QRectF plot = plotRect();
  const double factor = std::pow(0.8, steps);
  if (event->modifiers() & Qt::ControlModifier) {
    const double about = std::clamp((plot.bottom() - event->position().y()) / plot.height(), 0.0, 1.0);
    for (ValueAxis& axis : d->axes) axis.zoomAbout(about, factor);
    update();
    return;
  }
  const auto [first, last] = range();
  const auto [start, end] = fittedRange();
  const double about = std::clamp(placeAt(event->position().x()), first, last);
  const double span = std::clamp((last - first) * factor, kNarrowest * (end - start), 4 * (end - start));
  const double share = (about - first) / (last - first);
  setRange(about - share * span, about + (1 - share) * span);
  Q_EMIT rangeChanged(d->first, d->last);
}

void Plot::keyPressEvent(QKeyEvent* event) {
  const auto [first, last] = range();
  const int key = event->key();
  if (key == Qt::Key_1 || key == Qt::Key_2) {
    // Under the pointer, or a third from either side.
    const size_t which = key == Qt::Key_1 ? 0 : 1;
    const bool pointed = plotRect().contains(d->hover);
    const double share = (1.0 + static_cast<double>(which)) / 3;
    setReading(which, pointed ? placeAt(d->hover.x()) : first + (last - first) * share);
  } else if (key == Qt::Key_Escape && (d->readings[0] || d->readings[1])) {
    d->readings = {};
    d->measuredWidth = 0;
    update();
  } else if (movesReading(key) && d->readings[d->active]) {
    const double step = (event->modifiers() & Qt::ShiftModifier ? 0.1 : 1) * (last - first) / plotRect().width();
    const double at = *d->readings[d->active] + (key == Qt::Key_Left ? -step : step);
    setReading(d->active, std::clamp(at, first, last));
  } else if (key == Qt::Key_Plus || key == Qt::Key_Minus) {
    const double middle = (first + last) / 2, half = (last - first) / 2 * (key == Qt::Key_Plus ? 0.8 : 1.25);
    setRange(middle - half, middle + half);
    Q_EMIT rangeChanged(d->first, d->last);
  } else {
    QWidget::keyPressEvent(event);
  }
}

void Plot::changeEvent(QEvent* event) {
  if (event->type() == QEvent::StyleChange || event->type() == QEvent::PaletteChange) update();
  QWidget::changeEvent(event);
}

void Plot::contextMenuEvent(QContextMenuEvent* event) { Q_EMIT menuRequested(event->globalPos()); }

void Plot::dragEnterEvent(QDragEnterEvent* event) {
  d->dropping = event->mimeData()->hasFormat(QLatin1String(kSourceMime));
  if (d->dropping) event->acceptProposedAction();
  update();
}

void Plot::dragLeaveEvent(QDragLeaveEvent*) {
  d->dropping = false;
  update();
}

void Plot::dropEvent(QDropEvent* event) {
  d->dropping = false;
  update();
  event->acceptProposedAction();
  Q_EMIT sourceDropped(QString::fromUtf8(event->mimeData()->data(QLatin1String(kSourceMime))));
}

}  // namespace ps
