// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/graphview.h"

#include "ui/graphs/sampleseries.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>
#include <QtGui/QPolygonF>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ps {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Series {
  QString name, unit;
  SampleSeries samples;
};

}  // namespace

struct GraphView::Private {
  std::vector<Series> series;
  std::vector<ReferenceLine> references;
  QString unit;
};

GraphView::GraphView(QWidget* parent) : TimePlot(parent), d(std::make_unique<Private>()) {}
GraphView::~GraphView() = default;

int GraphView::addSeries(const QString& name, const QString& unit) {
  d->series.push_back({name, unit, {}});
  dataChanged();
  return static_cast<int>(d->series.size()) - 1;
}

int GraphView::seriesCount() const { return static_cast<int>(d->series.size()); }

void GraphView::removeAllSeries() {
  d->series.clear();
  dataChanged();
}

void GraphView::append(int series, double time, double value) {
  if (series < 0 || series >= seriesCount() || !std::isfinite(time)) return;
  d->series[static_cast<size_t>(series)].samples.append(time, value);
  dataChanged();
}

void GraphView::clear() {
  for (Series& series : d->series) series.samples.clear();
  dataChanged();
}

void GraphView::clearSeries(int series) {
  d->series.at(static_cast<size_t>(series)).samples.clear();
  dataChanged();
}

void GraphView::setReferenceLines(std::vector<ReferenceLine> lines) {
  d->references = std::move(lines);
  dataChanged();
}

void GraphView::setUnit(const QString& unit) {
  d->unit = unit;
  dataChanged();
}

std::pair<double, double> GraphView::extent(int series, double first, double last) const {
  const SampleSeries& samples = d->series.at(static_cast<size_t>(series)).samples;
  const SampleSeries::Extent extent = samples.extent(samples.indexAt(first), samples.indexAt(last));
  return extent.empty() ? std::pair{kNaN, kNaN} : std::pair{extent.low, extent.high};
}

size_t GraphView::sampleCount(int series) const { return d->series.at(static_cast<size_t>(series)).samples.size(); }

bool GraphView::hasData() const {
  return std::any_of(d->series.begin(), d->series.end(),
                     [](const Series& series) { return !series.samples.extent(0, series.samples.size()).empty(); });
}

double GraphView::lastTime() const {
  double last = 0;
  for (const Series& series : d->series) {
    if (!series.samples.empty()) last = std::max(last, series.samples.lastTime());
  }
  return last;
}

std::pair<double, double> GraphView::valueExtent(double first, double last) const {
  SampleSeries::Extent extent;
  for (const Series& series : d->series) {
    const size_t from = series.samples.indexAt(first);
    extent.add(series.samples.extent(from > 0 ? from - 1 : 0, series.samples.indexAt(last) + 1));
  }
  if (extent.empty()) return {0, 1};
  // A reference line just beyond the data is worth showing; one far away would press the data flat.
  // Less than half a percent is drawn flat: ticks that close would have no end of digits.
  // So is what a prefix of its unit would blow up: a millijoule.
  const double least =
      std::max(prefixedUnit().isEmpty() ? 1e-6 : 1e-3, 5e-3 * std::max(std::abs(extent.low), std::abs(extent.high)));
  const double span = std::max(extent.high - extent.low, least);
  const SampleSeries::Extent drawn = extent;
  for (const ReferenceLine& line : d->references) {
    if (line.value > drawn.low - 0.75 * span && line.value < drawn.high + 0.75 * span) extent.add(line.value);
  }
  const double middle = 0.5 * (extent.low + extent.high);
  extent.low = std::min(extent.low, middle - 0.5 * span);
  extent.high = std::max(extent.high, middle + 0.5 * span);
  const double margin = 0.12 * (extent.high - extent.low);
  return {extent.low - margin, clearOfTitle(extent.low - margin, extent.high)};
}

void GraphView::paintData(QPainter& painter) {
  const Theme& theme = Theme::current();
  const QRectF plot = plotRect();
  for (const ReferenceLine& line : d->references) {
    const double position = snapped(painter, y(line.value)) + hairline(painter) / 2;
    painter.setPen(QPen(theme[Token::ControlEdge], hairline(painter), Qt::CustomDashLine));
    QPen pen = painter.pen();
    pen.setDashPattern({2, 2});
    painter.setPen(pen);
    painter.drawLine(QPointF(plot.left(), position), QPointF(plot.right(), position));
    paintText(painter, QRectF(plot.right() - 100, position - 16, 95, 15), Qt::AlignRight | Qt::AlignVCenter, line.label,
              Theme::font(TextRole::Small), theme[Token::Muted]);
  }
  const double scale = painter.device()->devicePixelRatioF();
  const auto [first, last] = timeRange();
  const double perColumn = (last - first) / (plot.width() * scale);
  painter.setRenderHint(QPainter::Antialiasing);
  for (size_t index = 0; index < d->series.size(); ++index) {
    QPen pen(theme.series(static_cast<int>(index)), 1.5, Qt::SolidLine, Qt::FlatCap, Qt::BevelJoin);
    if (theme.seriesDashed(static_cast<int>(index))) pen.setDashPattern({4, 2.5});
    painter.setPen(pen);
    paintSeries(painter, static_cast<int>(index), first, last, perColumn);
  }
}

/// One device pixel column after the other. Where a column's samples lie close together, a smooth line passes through
/// their middle; where they spread, the column is filled from its lowest to its highest, so that no spike is lost
/// however many samples a column holds (and because stroking thousands of near-vertical segments takes a hundred times
/// longer). A gap breaks the line.
void GraphView::paintSeries(QPainter& painter, int index, double first, double last, double perColumn) const {
  const SampleSeries& samples = d->series[static_cast<size_t>(index)].samples;
  if (samples.empty()) return;
  constexpr double kSmooth = 1.5, kHalf = 0.75;  // logical pixels: spread drawn as a line; half the line's width
  constexpr qsizetype kChunk = 48;               // points stroked at a time: the cost of a stroke grows faster
  const double width = hairline(painter) / std::max(1.0, std::floor(painter.device()->devicePixelRatioF()));
  const QColor colour = painter.pen().color();
  QPolygonF line;
  const auto flush = [&] {
    if (line.size() == 1)
      painter.drawPoint(line.front());
    else if (line.size() > 1)
      painter.drawPolyline(line);
    line.clear();
  };
  const auto lineTo = [&](const QPointF& point) {
    line << point;
    if (line.size() < kChunk) return;
    flush();
    line << point;
  };
  size_t at = samples.indexAt(first);
  if (at > 0) --at;
  const size_t end = std::min(samples.size(), samples.indexAt(last) + 1);
  while (at < end) {
    const double column = std::floor((samples[at].time - first) / perColumn);
    const size_t next = std::clamp(samples.indexAt(first + (column + 1) * perColumn), at + 1, end);
    const SampleSeries::Extent extent = samples.extent(at, next);
    if (extent.empty()) {
      flush();
    } else if (const double top = y(extent.high), bottom = y(extent.low); bottom - top <= kSmooth) {
      lineTo({next == at + 1 ? x(samples[at].time) : x(first + (column + 0.5) * perColumn), (top + bottom) / 2});
    } else {
      const double left = snapped(painter, x(first + column * perColumn));
      double from = top, to = bottom;
      if (!line.isEmpty()) {  // meets the column before
        from = std::min(from, line.back().y());
        to = std::max(to, line.back().y());
        flush();
      }
      painter.fillRect(QRectF(left, from - kHalf, width, to - from + 2 * kHalf), colour);
      lineTo({left + width / 2,
              std::clamp(y(std::isnan(samples[next - 1].high) ? extent.high : samples[next - 1].high), top, bottom)});
    }
    at = next;
  }
  flush();
}

void GraphView::paintLabels(QPainter& painter) {
  const Theme& theme = Theme::current();
  const QRectF plot = plotRect();
  const QFont font = Theme::font(TextRole::Small);
  QColor ground = theme[Token::Field];
  ground.setAlphaF(0.75f);
  const QRectF heading(plot.left() + 7, plot.top() + 3, std::min(textWidth(axisTitle(), font) + 1, plot.width() - 14),
                       16);
  if (!title().isEmpty())
    painter.fillRect(heading.adjusted(-2, 1, 2, -1), ground);  // the line of the present time passes here
  paintText(painter, heading, Qt::AlignLeft | Qt::AlignVCenter, axisTitle(), font, theme[Token::Text2]);
  struct Label {
    double top;
    QPointF end;
    size_t series;
    QString text;
  };
  std::vector<Label> labels;
  const auto [first, last] = timeRange();
  for (size_t i = 0; i < d->series.size(); ++i) {
    const SampleSeries& samples = d->series[i].samples;
    if (samples.empty() || !std::isfinite(samples.lastValue()) || samples.lastTime() < first ||
        samples.lastTime() > last)
      continue;
    const QPointF end(x(samples.lastTime()), y(samples.lastValue()));
    labels.push_back({end.y() - 8, end, i,
                      d->series[i].name + QLatin1Char(' ') + curveText(valueTicks(), onAxis(samples.lastValue()))});
  }
  // From the top down, each label at its line's end or as little below it as keeps the texts apart.
  std::sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.top < b.top; });
  for (size_t i = 0; i < labels.size(); ++i) {
    labels[i].top = std::max(labels[i].top, i == 0 ? plot.top() + titleStrip() - 3 : labels[i - 1].top + 15);
  }
  for (size_t i = labels.size(); i-- > 0;) {
    labels[i].top = std::min(labels[i].top, i + 1 == labels.size() ? plot.bottom() - 16 : labels[i + 1].top - 15);
  }
  painter.setRenderHint(QPainter::Antialiasing);
  for (const Label& label : labels) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(theme.series(static_cast<int>(label.series)));
    painter.drawEllipse(label.end, 3, 3);
    if (label.top < plot.top() + titleStrip() - 4) continue;  // too low a plot for all of them
    // Right of the end where the plot has room, else left of it.
    const double width = textWidth(label.text, font);
    const bool right = label.end.x() + 8 + width < plot.right() - 2;
    QRectF rect(right ? label.end.x() + 8 : label.end.x() - 8 - width, label.top, width + 1, 16);
    painter.fillRect(rect.adjusted(-2, 1, 2, -1), ground);
    paintText(painter, rect, Qt::AlignLeft | Qt::AlignVCenter, label.text, font, theme[Token::Text]);
  }
}

QStringList GraphView::readOut(double time) const {
  QStringList lines{formatFixed(time, 2) + QStringLiteral(" s")};
  for (const Series& series : d->series) {
    const double value = series.samples.valueAt(time);
    const QString unit = series.unit.isEmpty() ? d->unit : series.unit;
    const QString text = !prefixedUnit().isEmpty() ? formatPrefixed(value, prefixedUnit())
                         : unit.isEmpty()          ? formatNumber(value)
                                                   : formatNumber(value) + QLatin1Char(' ') + unit;
    if (std::isfinite(value)) lines << series.name + QStringLiteral("  ") + text;
  }
  return lines.size() > 1 ? lines : QStringList();
}

}  // namespace ps
