// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/timeplot.h"

#include "ui/graphs/timeplot_p.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>
#include <QtWidgets/QAccessibleWidget>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ps {
namespace {

constexpr double kLeft = 52, kTop = 10, kRight = 16, kBottom = 22, kTitle = 22;
constexpr int kAlignMiddle = Qt::AlignLeft | Qt::AlignVCenter;

void paintTimeAxis(QPainter& painter, const QRectF& plot, std::pair<double, double> range, const Ticks& ticks) {
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Small);
  for (int i = 0; i < ticks.count; ++i) {
    const double x = plot.left() + plot.width() * (ticks.at(i) - range.first) / (range.second - range.first);
    if (x > plot.left() + 1 && x < plot.right() - 1)
      paintVerticalLine(painter, x, plot.top(), plot.bottom(), theme[Token::Line]);
    const bool last = i + 1 == ticks.count;
    const QString text = formatFixed(ticks.at(i), ticks.decimals) + (last ? QStringLiteral(" s") : QString());
    const double width = textWidth(text, font);
    // The last label ends at the plot's edge rather than beyond it.
    const double left =
        std::min(x - textWidth(formatFixed(ticks.at(i), ticks.decimals), font) / 2, plot.right() + kRight - 4 - width);
    paintText(painter, QRectF(left, plot.bottom() + 3, width + 1, 16), kAlignMiddle, text, font, theme[Token::Muted]);
  }
}

void paintValueAxis(QPainter& painter, const QRectF& plot, std::pair<double, double> range, const Ticks& ticks) {
  const Theme& theme = Theme::current();
  for (int i = 0; i < ticks.count; ++i) {
    const double y = plot.bottom() - plot.height() * (ticks.at(i) - range.first) / (range.second - range.first);
    if (y > plot.top() + 1 && y < plot.bottom() - 1)
      paintHorizontalLine(painter, plot.left(), plot.right(), y, theme[Token::Line]);
    paintText(painter, QRectF(0, y - 8, plot.left() - 7, 16), Qt::AlignRight | Qt::AlignVCenter, tickText(ticks, i),
              Theme::font(TextRole::Small), theme[Token::Muted]);
  }
}

double widthOf(const Ticks& ticks) {
  double width = 0;
  for (int i = 0; i < ticks.count; ++i)
    width = std::max(width, textWidth(tickText(ticks, i), Theme::font(TextRole::Small)));
  return width;
}

class PlotAccessible final : public QAccessibleWidget {
 public:
  explicit PlotAccessible(TimePlot* plot) : QAccessibleWidget(plot, QAccessible::Chart) {}
  QString text(QAccessible::Text kind) const override {
    const auto* plot = static_cast<const TimePlot*>(widget());
    if (kind == QAccessible::Name) return plot->title();
    return kind == QAccessible::Value ? plot->summary() : QAccessibleWidget::text(kind);
  }
};

QAccessibleInterface* makeAccessible(const QString& /*className*/, QObject* object) {
  auto* plot = qobject_cast<TimePlot*>(object);
  return plot ? new PlotAccessible(plot) : nullptr;
}

void installAccessibility() {
  static const bool installed = (QAccessible::installFactory(makeAccessible), true);
  (void)installed;
}

}  // namespace

Ticks niceTicks(double low, double high, int most) {
  Ticks ticks;
  const double span = high - low;
  if (!(span > 0) || !std::isfinite(span) || most < 1) return ticks;
  int exponent = static_cast<int>(std::floor(std::log10(span / most)));
  for (bool found = false; !found; ++exponent) {
    for (const double factor : {1.0, 2.0, 2.5, 5.0}) {
      const double decade = std::pow(10.0, std::abs(exponent));
      const double step = exponent < 0 ? factor / decade : factor * decade;
      const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
      if (last - first + 1 > most) continue;
      ticks.step = step;
      ticks.first = first * step + 0.0;
      ticks.count = static_cast<int>(last - first) + 1;
      ticks.decimals = std::max(0, -exponent) + (factor == 2.5 && exponent <= 0 ? 1 : 0);
      found = true;
      break;
    }
  }
  return ticks;
}

QString tickText(const Ticks& ticks, int index) {
  const double most = std::max(std::abs(ticks.at(0)), std::abs(ticks.at(ticks.count - 1)));
  if (most == 0 || (most < 1e6 && most >= 1e-3)) return formatFixed(ticks.at(index), ticks.decimals);
  // A power of ten: digits down to the step, and one more for steps of two and a half.
  return formatShort(ticks.at(index),
                     std::clamp(static_cast<int>(std::ceil(std::log10(most / ticks.step))) + 2, 2, 15));
}

QString curveText(const Ticks& axis, double value) {
  const double most =
      axis.count > 0 ? std::max(std::abs(axis.at(0)), std::abs(axis.at(axis.count - 1))) : std::abs(value);
  const int significant = std::abs(value) >= 100 ? 4 : 3;
  if (!(most < 1e6 && most >= 1e-3)) return formatNumber(value, significant);  // the axis has powers of ten
  const int wanted =
      value == 0 ? significant : significant - 1 - static_cast<int>(std::floor(std::log10(std::abs(value))));
  return formatFixed(value, std::clamp(wanted, axis.decimals, axis.decimals + 1));
}

TimePlot::TimePlot(QWidget* parent) : QWidget(parent), d(std::make_unique<Private>()) {
  installAccessibility();
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setAttribute(Qt::WA_OpaquePaintEvent);
}

TimePlot::~TimePlot() = default;

void TimePlot::setTitle(const QString& title) {
  d->title = title;
  setAccessibleName(title);
  update();
}
QString TimePlot::title() const { return d->title; }

void TimePlot::setPrefixedUnit(const QString& unit) {
  d->unit = unit;
  dataChanged();
}
QString TimePlot::prefixedUnit() const { return d->unit; }
double TimePlot::onAxis(double value) const { return value / d->prefix.factor; }
QString TimePlot::axisTitle() const {
  return d->unit.isEmpty() ? d->title : d->title + QStringLiteral(", ") + d->prefix.symbol + d->unit;
}

void TimePlot::setEmptyText(const QString& text) {
  if (d->emptyText == text) return;
  d->emptyText = text;
  update();
}

void TimePlot::setDuration(double seconds) {
  if (d->duration == seconds) return;
  d->duration = seconds;
  update();
}

void TimePlot::setPresentTime(double seconds) {
  if (d->present == seconds) return;
  d->present = seconds;
  update();
}

void TimePlot::setTimeRange(double first, double last) {
  if (!(last > first)) return;
  d->fitted = false;
  d->first = first;
  d->last = last;
  update();
}

std::pair<double, double> TimePlot::timeRange() const {
  if (!d->fitted) return {d->first, d->last};
  const double last = std::max(d->duration, hasData() ? lastTime() : 0.0);
  return {0, last > 0 ? last : 10};
}

bool TimePlot::isFitted() const { return d->fitted; }

void TimePlot::fit() {
  d->fitted = true;
  update();
}

QString TimePlot::summary() const { return hasData() ? readOut(lastTime()).join(QStringLiteral(", ")) : d->emptyText; }

QRectF TimePlot::plotRect() const {
  const double left = std::max(kLeft, d->left);
  return {left, kTop, std::max(10.0, width() - left - kRight), std::max(10.0, height() - kTop - kBottom)};
}

QSize TimePlot::sizeHint() const { return {440, 132}; }
QSize TimePlot::minimumSizeHint() const { return {180, 80}; }

double TimePlot::x(double time) const {
  const QRectF plot = plotRect();
  const auto [first, last] = timeRange();
  return plot.left() + plot.width() * (time - first) / (last - first);
}

double TimePlot::y(double value) const {
  const QRectF plot = plotRect();
  return plot.bottom() - plot.height() * (value - d->low) / (d->high - d->low);
}

double TimePlot::timeAt(double position) const {
  const QRectF plot = plotRect();
  const auto [first, last] = timeRange();
  return first + (last - first) * (position - plot.left()) / plot.width();
}

double TimePlot::presentTime() const { return d->present; }

const Ticks& TimePlot::valueTicks() const { return d->values; }

double TimePlot::titleStrip() const { return std::min(kTitle, plotRect().height() / 2); }

double TimePlot::clearOfTitle(double low, double high) const {
  return low + (high - low) / (1 - titleStrip() / plotRect().height());
}

void TimePlot::dataChanged() { update(); }

void TimePlot::paintEvent(QPaintEvent*) {
  const Theme& theme = Theme::current();
  QPainter painter(this);
  painter.fillRect(rect(), theme[Token::Panel]);
  const auto range = timeRange();
  if (hasData()) {
    std::tie(d->low, d->high) = valueExtent(range.first, range.second);
    if (!d->unit.isEmpty()) d->prefix = prefixFor(std::max(std::abs(d->low), std::abs(d->high)));
    d->values = niceTicks(onAxis(d->low), onAxis(d->high), std::max(2, static_cast<int>(plotRect().height() / 26)));
    d->left = widthOf(d->values) + 9;
  }
  const QRectF plot = plotRect();
  painter.fillRect(snapped(painter, plot), theme[Token::Field]);
  if (!hasData()) {
    paintBox(painter, plot, QColor(), theme[Token::Line], 0);
    paintText(painter, plot, Qt::AlignCenter, d->emptyText, Theme::font(TextRole::Normal), theme[Token::Muted]);
    return;
  }
  const Ticks times = niceTicks(range.first, range.second, std::max(2, static_cast<int>(plot.width() / 64)));
  paintTimeAxis(painter, plot, range, times);
  paintValueAxis(painter, plot, {onAxis(d->low), onAxis(d->high)}, d->values);
  painter.save();
  painter.setClipRect(plot);
  paintData(painter);
  painter.restore();
  paintBox(painter, plot.adjusted(0, 0, 1, 1), QColor(), theme[Token::Line2], 0);
  if (d->present >= range.first && d->present <= range.second) {
    paintVerticalLine(painter, x(d->present) - 0.5, plot.top(), plot.bottom(), theme[Token::Accent]);
  }
  paintLabels(painter);
  paintReadOut(painter);
  if (hasFocus()) paintFocusRing(painter, QRectF(rect()).adjusted(1, 1, -1, -1), 4);
}

void TimePlot::paintReadOut(QPainter& painter) const {
  const QRectF plot = plotRect();
  if (!plot.contains(d->hover) || d->panning) return;
  const QStringList lines = readOut(timeAt(d->hover.x()));
  if (lines.isEmpty()) return;
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Small);
  paintVerticalLine(painter, d->hover.x(), plot.top(), plot.bottom(), theme[Token::ControlEdge]);
  double width = 0;
  for (const QString& line : lines) width = std::max(width, textWidth(line, font));
  QRectF box(d->hover.x() + 12, plot.top() + 4, width + 16, 14.0 * static_cast<double>(lines.size()) + 8);
  if (box.right() > this->width() - 2) box.moveRight(d->hover.x() - 12);
  paintBox(painter, box, theme[Token::Header], theme[Token::Line2], 4);
  double top = box.top() + 4;
  for (const QString& line : lines) {
    paintText(painter, QRectF(box.left() + 8, top, width + 2, 14), kAlignMiddle, line, font,
              theme[top < box.top() + 5 ? Token::Muted : Token::Text]);
    top += 14;
  }
}

}  // namespace ps
