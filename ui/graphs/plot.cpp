// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/plot.h"

#include "ui/graphs/plot_p.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>
#include <QtWidgets/QAccessibleWidget>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kLeft = 52, kTop = 10, kRight = 16, kBottom = 22, kTitle = 22, kLine = 14;
constexpr int kAlignMiddle = Qt::AlignLeft | Qt::AlignVCenter;

class PlotAccessible final : public QAccessibleWidget {
 public:
  explicit PlotAccessible(Plot* plot) : QAccessibleWidget(plot, QAccessible::Chart) {}
  QString text(QAccessible::Text kind) const override {
    const auto* plot = static_cast<const Plot*>(widget());
    if (kind == QAccessible::Name) return plot->axisTitle();
    return kind == QAccessible::Value ? plot->summary() : QAccessibleWidget::text(kind);
  }
};

QAccessibleInterface* makeAccessible(const QString& /*className*/, QObject* object) {
  auto* plot = qobject_cast<Plot*>(object);
  return plot ? new PlotAccessible(plot) : nullptr;
}

void installAccessibility() {
  static const bool installed = (QAccessible::installFactory(makeAccessible), true);
  (void)installed;
}

}  // namespace

QString amountText(double value, const QString& unit, int significant) {
  if (unit.isEmpty()) return formatNumber(value, significant);
  if (std::abs(value) < 1e-9) value = 0;  // less than a thousandth of the least prefix is rounding
  const UnitPrefix prefix = prefixFor(value, unit);
  return formatNumber(value / prefix.factor, significant) + QLatin1Char(' ') + prefix.symbol + unit;
}

Plot::Plot(QWidget* parent) : QWidget(parent), d(std::make_unique<Private>()) {
  installAccessibility();
  setMouseTracking(true);
  setAcceptDrops(true);
  setFocusPolicy(Qt::StrongFocus);
  setAttribute(Qt::WA_OpaquePaintEvent);
}

Plot::~Plot() = default;

void Plot::setTitle(const QString& title) {
  if (d->title == title) return;
  d->title = title;
  setAccessibleName(title);
  update();
}
QString Plot::title() const { return d->title; }

QString Plot::axisTitle() const {
  const QString unit = d->axes.front().shownUnit();
  return unit.isEmpty() ? d->title : d->title + QStringLiteral(", ") + unit;
}

void Plot::setEmptyText(const QString& text) {
  if (d->emptyText == text) return;
  d->emptyText = text;
  update();
}

void Plot::setUnit(const QString& unit) {
  d->axes.front().unit = unit;
  dataChanged();
}

void Plot::setLogarithmic(bool on) {
  for (ValueAxis& axis : d->axes) {
    if (!axis.mark.isEmpty()) continue;
    if (axis.logarithmic != on) axis.zoom.reset();
    axis.logarithmic = on;
  }
  dataChanged();
}

void Plot::setRange(double first, double last) {
  if (!(last > first)) return;
  d->fitted = false;
  d->first = first;
  d->last = last;
  update();
}

std::pair<double, double> Plot::range() const { return d->fitted ? fittedRange() : std::pair{d->first, d->last}; }
bool Plot::isFitted() const { return d->fitted; }

void Plot::fit() {
  d->fitted = true;
  for (ValueAxis& axis : d->axes) axis.zoom.reset();
  update();
}

void Plot::setValueRange(size_t axis, const std::optional<std::pair<double, double>>& range) {
  if (axis >= d->axes.size() || (range && !(range->second > range->first))) return;
  d->axes[axis].zoom = range;
  update();
}

double Plot::summaryPlace() const { return range().second; }

QString Plot::summary() const {
  if (!hasData()) return d->emptyText;
  QStringList said{placeText(summaryPlace())};
  for (const PlotLine& line : readOut(summaryPlace())) said << line.name + QStringLiteral("  ") + line.value;
  return said.join(QStringLiteral(", "));
}

QRectF Plot::plotRect() const {
  const double left = std::max(kLeft, d->left);
  return {left, kTop, std::max(10.0, width() - left - kRight - d->right), std::max(10.0, height() - kTop - kBottom)};
}

const std::vector<ValueAxis>& Plot::axes() const { return d->axes; }
std::vector<ValueAxis>& Plot::valueAxes() { return d->axes; }

void Plot::setReading(size_t which, std::optional<double> at) {
  d->readings[which] = at;
  d->active = which;
  update();
}
std::optional<double> Plot::reading(size_t which) const { return d->readings[which]; }

std::vector<PlotLine> Plot::measured() const {
  const auto& [a, b] = d->readings;
  return a && b && hasData() ? measure(std::min(*a, *b), std::max(*a, *b)) : std::vector<PlotLine>();
}

QSize Plot::sizeHint() const { return {440, 132}; }
QSize Plot::minimumSizeHint() const { return {120, 60}; }

double Plot::x(double at) const {
  const QRectF plot = plotRect();
  const auto [first, last] = range();
  return plot.left() + plot.width() * (at - first) / (last - first);
}

double Plot::y(double value, size_t axis) const {
  const QRectF plot = plotRect();
  return plot.bottom() - plot.height() * d->axes[axis].position(value);
}

double Plot::placeAt(double position) const {
  const QRectF plot = plotRect();
  const auto [first, last] = range();
  return first + (last - first) * (position - plot.left()) / plot.width();
}

double Plot::titleStrip() const { return std::min(kTitle, plotRect().height() / 2); }

std::pair<double, double> Plot::roomFor(size_t axis, double low, double high, double margin) const {
  const double below = titleStrip() / plotRect().height();
  if (d->axes[axis].logarithmic) {
    const double span = std::max(std::log(high / low), 0.1);
    low *= std::exp(-margin * span);
    return {low, low * std::exp(std::log(high / low) / (1 - below))};
  }
  low -= margin * (high - low) / (1 + margin);
  return {low, low + (high - low) / (1 - below)};
}

double Plot::labelLeft(double place, double width) const {
  const QRectF plot = plotRect();
  if (place + 8 + width < plot.right() - 2) return place + 8;
  if (place - 8 - width > plot.left() + 2) return place - 8 - width;
  return std::max(plot.left() + 2, plot.right() - 2 - width);
}

void Plot::dataChanged() { update(); }

void Plot::measureAxes() {
  const auto [first, last] = range();
  const int most = std::max(2, static_cast<int>(plotRect().height() / 26));
  d->right = 0;
  for (size_t k = 0; k < d->axes.size(); ++k) {
    ValueAxis& axis = d->axes[k];
    axis.set(valueExtent(k, first, last), most);
    if (k > 0) d->right += axis.labelWidth(true) + 12;
  }
  d->left = d->axes.front().labelWidth(false) + 9;
}

void Plot::paintEvent(QPaintEvent*) {
  const Theme& theme = Theme::current();
  QPainter painter(this);
  painter.fillRect(rect(), theme[Token::Panel]);
  const bool shows = hasData();
  if (shows) measureAxes();
  const QRectF plot = plotRect();
  painter.fillRect(snapped(painter, plot), theme[Token::Field]);
  if (!shows) {
    paintBox(painter, plot, QColor(), theme[d->dropping ? Token::Accent : Token::Line], 0);
    paintHeading(painter);
    paintText(painter, plot, Qt::AlignCenter, d->emptyText, Theme::font(TextRole::Normal), theme[Token::Muted]);
    if (hasFocus()) paintFocusRing(painter, QRectF(rect()).adjusted(1, 1, -1, -1), 4);
    return;
  }
  paintAlong(painter);
  double offset = 0;
  for (size_t k = 0; k < d->axes.size(); ++k) {
    d->axes[k].paint(painter, plot, k > 0, offset);
    if (k > 0) offset += d->axes[k].labelWidth(true) + 12;
  }
  painter.save();
  painter.setClipRect(plot);
  paintData(painter);
  painter.restore();
  paintBox(painter, plot.adjusted(0, 0, 1, 1), QColor(), theme[d->dropping ? Token::Accent : Token::Line2], 0);
  paintBehind(painter);
  paintLabels(painter);
  paintReadings(painter);
  paintReadOut(painter);
  if (hasFocus()) paintFocusRing(painter, QRectF(rect()).adjusted(1, 1, -1, -1), 4);
}

QRectF Plot::headingRect() const {
  if (d->title.isEmpty()) return {};
  const QRectF plot = plotRect();
  const double width = textWidth(axisTitle(), Theme::font(TextRole::Small)) + 1;
  return {plot.left() + 7, plot.top() + 3, std::min(width, plot.width() - 14), 16};
}

void Plot::paintHeading(QPainter& painter) const {
  if (d->title.isEmpty()) return;
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Small);
  QColor ground = theme[Token::Field];
  ground.setAlphaF(0.75f);
  const QRectF heading = headingRect();
  painter.fillRect(heading.adjusted(-2, 1, 2, -1), ground);  // the line of the present time passes here
  paintText(painter, heading, kAlignMiddle, axisTitle(), font, theme[Token::Text2]);
}

void Plot::paintAlong(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Small);
  const QRectF plot = plotRect();
  const auto [low, high] = range();
  const Ticks ticks = niceTicks(low, high, std::max(2, static_cast<int>(plot.width() / 64)));
  const QString unit = unitAlong().isEmpty() ? QString() : QLatin1Char(' ') + unitAlong();
  for (int i = 0; i < ticks.count; ++i) {
    const double place = x(ticks.at(i));
    if (place > plot.left() + 1 && place < plot.right() - 1)
      paintVerticalLine(painter, place, plot.top(), plot.bottom(), theme[Token::Line]);
    const QString number = tickText(ticks, i), text = i + 1 == ticks.count ? number + unit : number;
    const double width = textWidth(text, font);
    // The last label ends at the plot's edge rather than beyond it.
    const double left = std::min(place - textWidth(number, font) / 2, plot.right() + kRight - 4 - width);
    paintText(painter, QRectF(left, plot.bottom() + 3, width + 1, 16), kAlignMiddle, text, font, theme[Token::Muted]);
  }
}

/// Names at the left, values at the right of a column that grows with them and does not shrink while it is shown.
void Plot::paintLines(QPainter& painter, std::pair<double, double> beside, const std::vector<PlotLine>& lines,
                      double& widest) const {
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Small);
  double names = 0;
  for (const PlotLine& line : lines) {
    names = std::max(names, textWidth(line.name, font) + (line.series < 0 ? 0 : 12));
    widest = std::max(widest, textWidth(line.value, font));
  }
  // Right of what it is about, else left of it, else over it.
  QRectF box(beside.second + 12, plotRect().top() + 4, names + widest + 28,
             kLine * static_cast<double>(lines.size()) + 8);
  if (box.right() > width() - 2) box.moveRight(beside.first - 12);
  if (box.left() < 2) box.moveRight(std::max(plotRect().right() - 4, box.width() + 2));
  paintBox(painter, box, theme[Token::Header], theme[Token::Line2], 4);
  double top = box.top() + 4;
  for (const PlotLine& line : lines) {
    const QRectF row(box.left() + 8, top, box.width() - 16, kLine);
    if (line.series >= 0) {
      painter.setRenderHint(QPainter::Antialiasing);
      painter.setPen(Qt::NoPen);
      painter.setBrush(theme.series(line.series));
      painter.drawEllipse(QPointF(row.left() + 3, row.center().y()), 3, 3);
    }
    paintText(painter, row.adjusted(line.series < 0 ? 0 : 12, 0, 0, 0), kAlignMiddle, line.name, font,
              theme[line.value.isEmpty() ? Token::Muted : Token::Text2]);
    paintText(painter, row, Qt::AlignRight | Qt::AlignVCenter, line.value, font, theme[Token::Text]);
    top += kLine;
  }
}

void Plot::paintReadOut(QPainter& painter) const {
  const QRectF plot = plotRect();
  if (!plot.contains(d->hover) || d->panning || d->held || (d->readings[0] && d->readings[1])) return;
  std::vector<PlotLine> lines = readOut(placeAt(d->hover.x()));
  if (lines.empty()) return;
  lines.insert(lines.begin(), {placeText(placeAt(d->hover.x())), {}});
  paintVerticalLine(painter, d->hover.x(), plot.top(), plot.bottom(), Theme::current()[Token::ControlEdge]);
  paintLines(painter, {d->hover.x(), d->hover.x()}, lines, d->readOutWidth);
}

void Plot::paintReadings(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const QRectF plot = plotRect();
  const auto& [a, b] = d->readings;
  if (a && b) {
    QColor between = theme[Token::Accent];
    between.setAlphaF(0.12f);
    painter.fillRect(QRectF(QPointF(x(*a), plot.top()), QPointF(x(*b), plot.bottom())).normalized().intersected(plot),
                     between);
  }
  const QFont font = Theme::font(TextRole::Small);
  for (size_t which = 0; which < 2; ++which) {
    const auto& at = d->readings[which];
    if (!at || x(*at) < plot.left() || x(*at) > plot.right()) continue;
    paintVerticalLine(painter, x(*at) - 0.5, plot.top(), plot.bottom(), theme[Token::Accent]);
    const QRectF flag(x(*at) - 8, plot.top() - 9, 16, 14);
    paintBox(painter, flag, theme[Token::Accent], QColor(), 3);
    paintText(painter, flag, Qt::AlignCenter, which == 0 ? QStringLiteral("A") : QStringLiteral("B"), font,
              theme[Token::OnAccent]);
  }
  const std::vector<PlotLine> lines = measured();
  if (lines.empty()) return;
  const auto place = [&](double at) { return std::clamp(x(at), plot.left(), plot.right()); };
  paintLines(painter, std::minmax({place(*a), place(*b)}), lines, d->measuredWidth);
}

}  // namespace ps
