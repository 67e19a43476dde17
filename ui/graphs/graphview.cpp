// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/graphview.h"

#include "ui/graphs/endlabels.h"
#include "ui/graphs/sampleseries.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtCore/QStringList>
#include <QtGui/QPainter>
#include <QtGui/QPolygonF>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ps {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Series {
  QString name;
  size_t axis = 0;
  SampleSeries samples, other;  ///< of this run, and of one that it is compared with
  SampleSeries difference{};
};

/// Of what a unit gains in a second, and of what it adds up to: "m/s" gives "m/s²" and "m".
QString perSecond(const QString& unit) {
  if (unit == QStringLiteral("J")) return QStringLiteral("W");
  if (unit.endsWith(QStringLiteral("/s"))) return unit + QStringLiteral("²");
  return unit.isEmpty() ? QStringLiteral("1/s") : unit + QStringLiteral("/s");
}
QString timesSeconds(const QString& unit) {
  if (unit == QStringLiteral("W")) return QStringLiteral("J");
  if (unit.endsWith(QStringLiteral("/s"))) return unit.chopped(2);
  return unit.isEmpty() ? QStringLiteral("s") : unit + QStringLiteral("·s");
}

}  // namespace

struct GraphView::Private {
  std::vector<Series> series;
  std::vector<ReferenceLine> references;
  QString otherRun;
  size_t units = 1;  ///< axes of values; behind them those of differences, in the same order
  bool difference = false;
  bool stale = true;  ///< differences are to be made again
  bool showsDifference() const { return difference && !otherRun.isEmpty(); }
};

GraphView::GraphView(QWidget* parent) : TimePlot(parent), d(std::make_unique<Private>()) {}
GraphView::~GraphView() = default;

int GraphView::addSeries(const QString& name, const QString& unit) {
  std::vector<ValueAxis>& axes = valueAxes();
  if (d->series.empty() && !unit.isEmpty()) axes.front().unit = unit;
  axes.resize(d->units);
  const auto same = std::find_if(axes.begin(), axes.end(), [&](const ValueAxis& axis) { return axis.unit == unit; });
  const auto axis = unit.isEmpty() && d->series.empty() ? size_t{0} : static_cast<size_t>(same - axes.begin());
  if (axis == axes.size()) {
    axes.push_back({});
    axes.back().unit = unit;
    axes.back().logarithmic = axes.front().logarithmic;
    d->units = axes.size();
  }
  d->series.push_back({name, axis, {}, {}});
  layOutAxes();
  dataChanged();
  return static_cast<int>(d->series.size()) - 1;
}

int GraphView::seriesCount() const { return static_cast<int>(d->series.size()); }

void GraphView::removeAllSeries() {
  d->series.clear();
  d->units = 1;
  valueAxes().resize(1);
  valueAxes().front().unit.clear();
  layOutAxes();
  dataChanged();
}

void GraphView::append(int series, double time, double value) {
  if (series < 0 || series >= seriesCount() || !std::isfinite(time)) return;
  Series& to = d->series[static_cast<size_t>(series)];
  to.samples.append(time, value);
  if (!d->stale) to.difference.append(time, value - to.other.lineAt(time));
  dataChanged();
}

void GraphView::clear() {
  for (Series& series : d->series) series.samples.clear();
  d->stale = true;
  dataChanged();
}

void GraphView::clearSeries(int series) {
  d->series.at(static_cast<size_t>(series)).samples.clear();
  d->stale = true;
  dataChanged();
}

void GraphView::beginOther(const QString& run) {
  d->otherRun = run;
  for (Series& series : d->series) series.other.clear();
  d->stale = true;
  layOutAxes();
  dataChanged();
}

void GraphView::appendOther(int series, double time, double value) {
  if (series < 0 || series >= seriesCount() || !std::isfinite(time)) return;
  d->series[static_cast<size_t>(series)].other.append(time, value);
  d->stale = true;
  dataChanged();
}

const QString& GraphView::otherRun() const { return d->otherRun; }

size_t GraphView::otherCount(int series) const { return d->series.at(static_cast<size_t>(series)).other.size(); }

void GraphView::setDifference(bool on) {
  if (d->difference == on) return;
  d->difference = on;
  layOutAxes();
  dataChanged();
}

double GraphView::differenceAt(int series, double time) const {
  if (!d->showsDifference()) return kNaN;
  makeDifferences();
  return d->series.at(static_cast<size_t>(series)).difference.lineAt(time);
}

/// Zooms of the axes that stay are kept.
void GraphView::layOutAxes() {
  std::vector<ValueAxis>& axes = valueAxes();
  axes.resize(d->showsDifference() ? 2 * d->units : d->units);
  for (size_t k = d->units; k < axes.size(); ++k) {
    axes[k].unit = axes[k - d->units].unit;
    axes[k].mark = QStringLiteral("Δ ");
  }
}

/// Samples of both runs come apart in time where frames were thinned.
void GraphView::makeDifferences() const {
  if (!std::exchange(d->stale, false)) return;
  for (Series& series : d->series) {
    series.difference.clear();
    for (size_t i = 0; i < series.samples.size(); ++i) {
      const SampleSeries::Sample& sample = series.samples[i];
      series.difference.append(sample.time, (sample.low + sample.high) / 2 - series.other.lineAt(sample.time));
    }
  }
}

void GraphView::setReferenceLines(std::vector<ReferenceLine> lines) {
  d->references = std::move(lines);
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
    for (const SampleSeries* samples : {&series.samples, &series.other}) {
      if (!samples->empty()) last = std::max(last, samples->lastTime());
    }
  }
  return last;
}

std::pair<double, double> GraphView::valueExtent(size_t axis, double first, double last) const {
  const ValueAxis& shown = axes()[axis];
  SampleSeries::Extent extent;
  const bool differences = axis >= d->units;
  if (differences) makeDifferences(), extent.add(0);
  for (const Series& series : d->series) {
    if (series.axis != axis % d->units) continue;
    const auto shownOnes = differences ? std::vector{&series.difference} : std::vector{&series.samples, &series.other};
    for (const SampleSeries* samples : shownOnes) {
      const size_t from = samples->indexAt(first);
      extent.add(samples->extent(from > 0 ? from - 1 : 0, samples->indexAt(last) + 1));
    }
  }
  if (shown.logarithmic) {
    if (!(extent.high > 0)) return {1e-3, 1};
    return roomFor(axis, std::min(extent.positive, extent.high / 2), extent.high, 0.06);
  }
  if (extent.empty()) return {0, 1};
  // A reference line just beyond the data is worth showing; one far away would press the data flat.
  // Less than half a percent is drawn flat: ticks that close would have no end of digits.
  // So is what a prefix of its unit would blow up: a millijoule.
  const bool prefixed = prefixFor(1e6, shown.unit).factor > 1;
  const double least = std::max(prefixed ? 1e-3 : 1e-6, 5e-3 * std::max(std::abs(extent.low), std::abs(extent.high)));
  const double span = std::max(extent.high - extent.low, least);
  const SampleSeries::Extent drawn = extent;
  for (size_t i = 0; axis == 0 && i < d->references.size(); ++i) {
    const double value = d->references[i].value;
    if (value > drawn.low - 0.75 * span && value < drawn.high + 0.75 * span) extent.add(value);
  }
  const double middle = 0.5 * (extent.low + extent.high);
  return roomFor(axis, std::min(extent.low, middle - 0.5 * span), std::max(extent.high, middle + 0.5 * span), 0.12);
}

void GraphView::paintReferences(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const QRectF plot = plotRect();
  for (const ReferenceLine& line : d->references) {
    const double position = snapped(painter, y(line.value)) + hairline(painter) / 2;
    QPen pen(theme[Token::ControlEdge], hairline(painter), Qt::CustomDashLine);
    pen.setDashPattern({2, 2});
    painter.setPen(pen);
    painter.drawLine(QPointF(plot.left(), position), QPointF(plot.right(), position));
    paintText(painter, QRectF(plot.right() - 100, position - 16, 95, 15), Qt::AlignRight | Qt::AlignVCenter, line.label,
              Theme::font(TextRole::Small), theme[Token::Muted]);
  }
}

/// Dotted in the colour of their curve, about a line at none.
void GraphView::paintDifferences(QPainter& painter, double perColumn) const {
  if (!d->showsDifference()) return;
  makeDifferences();
  const Theme& theme = Theme::current();
  for (size_t index = 0; index < d->series.size(); ++index) {
    const Series& series = d->series[index];
    const size_t axis = d->units + series.axis;
    const double none = snapped(painter, y(0, axis)) + hairline(painter) / 2;
    painter.setPen(QPen(theme[Token::Line2], hairline(painter)));
    painter.drawLine(QPointF(plotRect().left(), none), QPointF(plotRect().right(), none));
    QPen pen(theme.series(static_cast<int>(index)), 1.5, Qt::SolidLine, Qt::FlatCap, Qt::BevelJoin);
    pen.setDashPattern({1, 2});
    painter.setPen(pen);
    paintSeries(painter, series.difference, axis, perColumn);
  }
}

void GraphView::paintData(QPainter& painter) {
  const Theme& theme = Theme::current();
  const QRectF plot = plotRect();
  paintReferences(painter);
  const double scale = painter.device()->devicePixelRatioF();
  const auto [first, last] = range();
  const double perColumn = (last - first) / (plot.width() * scale);
  painter.setRenderHint(QPainter::Antialiasing);
  for (size_t index = 0; index < d->series.size(); ++index) {
    const Series& other = d->series[index];
    if (other.other.empty()) continue;
    QPen pen(theme.series(static_cast<int>(index)), 1, Qt::SolidLine, Qt::FlatCap, Qt::BevelJoin);
    pen.setDashPattern({3, 3});
    painter.setPen(pen);
    paintSeries(painter, other.other, other.axis, perColumn);
  }
  for (size_t index = 0; index < d->series.size(); ++index) {
    QPen pen(theme.series(static_cast<int>(index)), 1.5, Qt::SolidLine, Qt::FlatCap, Qt::BevelJoin);
    if (theme.seriesDashed(static_cast<int>(index))) pen.setDashPattern({4, 2.5});
    painter.setPen(pen);
    paintSeries(painter, d->series[index].samples, d->series[index].axis, perColumn);
  }
  paintDifferences(painter, perColumn);
}

/// One device pixel column after the other. Where a column's samples lie close together, a smooth line passes through
/// their middle; where they spread, the column is filled from its lowest to its highest, so that no spike is lost
/// however many samples a column holds (and because stroking thousands of near-vertical segments takes a hundred times
/// longer). A gap breaks the line.
void GraphView::paintSeries(QPainter& painter, const SampleSeries& samples, size_t axis, double perColumn) const {
  if (samples.empty()) return;
  const auto [first, last] = range();
  constexpr double kSmooth = 1.5, kHalf = 0.75;  // logical pixels: spread drawn as a line; half the line's width
  constexpr qsizetype kChunk = 48;               // points stroked at a time: the cost of a stroke grows faster
  const double width = hairline(painter) / std::max(1.0, std::floor(painter.device()->devicePixelRatioF()));
  const QColor colour = painter.pen().color();
  const QRectF plot = plotRect();
  const ValueAxis& shown = axes()[axis];
  // As x() and y(), which look at all data for what is shown.
  const auto across = [&](double time) { return plot.left() + plot.width() * (time - first) / (last - first); };
  const auto up = [&](double value) { return plot.bottom() - plot.height() * shown.position(value); };
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
  size_t samplesWide = 1;  // the column before
  while (at < end) {
    const double column = std::floor((samples[at].time - first) / perColumn);
    const size_t next = std::clamp(samples.columnEnd(first + (column + 1) * perColumn, at, samplesWide), at + 1, end);
    samplesWide = next - at;
    const SampleSeries::Extent extent = samples.extent(at, next);
    if (extent.empty()) {
      flush();
    } else if (const double top = up(extent.high), bottom = up(extent.low); bottom - top <= kSmooth) {
      lineTo(
          {next == at + 1 ? across(samples[at].time) : across(first + (column + 0.5) * perColumn), (top + bottom) / 2});
    } else {
      const double left = snapped(painter, across(first + column * perColumn));
      double from = top, to = bottom;
      if (!line.isEmpty()) {  // meets the column before
        from = std::min(from, line.back().y());
        to = std::max(to, line.back().y());
        flush();
      }
      painter.fillRect(QRectF(left, from - kHalf, width, to - from + 2 * kHalf), colour);
      lineTo({left + width / 2,
              std::clamp(up(std::isnan(samples[next - 1].high) ? extent.high : samples[next - 1].high), top, bottom)});
    }
    at = next;
  }
  flush();
}

/// A tip has them all where the plot has no room for their names.
void GraphView::paintLabels(QPainter& painter) {
  const QRectF plot = plotRect();
  paintHeading(painter);
  std::vector<EndLabel> labels;
  const auto [first, last] = range();
  const auto add = [&](size_t i, const QString& name, const SampleSeries& samples, size_t axis, double value,
                       double time) {
    if (samples.empty() || !std::isfinite(value) || time < first || time > last) return;
    const QPointF end(x(time), y(value, axis));
    if (!plot.adjusted(-1, -1, 1, 1).contains(end)) return;
    const ValueAxis& of = axes()[axis];
    const QString unit = axis > 0 ? QLatin1Char(' ') + of.shownUnit() : QString();
    const double width = curveTextWidth(of.ticks(), of.onAxis(of.low()), of.onAxis(of.high()));
    labels.push_back({end, static_cast<int>(i), name, curveText(of.ticks(), of.onAxis(value)) + unit,
                      width + textWidth(unit, Theme::font(TextRole::Small))});
  };
  for (size_t i = 0; i < d->series.size(); ++i) {
    const Series& s = d->series[i];
    if (s.samples.empty()) continue;
    const double now = labelTime(s.samples.lastTime());
    add(i, s.name, s.samples, s.axis, s.samples.valueAt(now), now);
    if (!d->showsDifference() || s.difference.empty() || s.other.empty()) continue;
    const double end = std::min(now, s.other.lastTime());
    add(i, QStringLiteral("Δ ") + s.name, s.difference, d->units + s.axis, s.difference.valueAt(end), end);
  }
  QStringList names;
  for (const EndLabel& label : labels) names << label.name;
  const QRectF room(plot.left() + 2, plot.top() + titleStrip() - 3, plot.width() - 4, plot.height() - titleStrip() + 3);
  std::vector<QRectF> taken{headingRect()};
  const bool whole = paintEndLabels(
      painter, std::move(labels), room, [this](double place, double width) { return labelLeft(place, width); }, taken);
  paintMarkerNames(painter, std::move(taken));
  const QString tip = whole ? QString() : names.join(QLatin1Char('\n'));
  if (toolTip() != tip) setToolTip(tip);
}

std::vector<PlotLine> GraphView::readOut(double time) const {
  std::vector<PlotLine> lines;
  for (size_t i = 0; i < d->series.size(); ++i) {
    const auto& [name, axis, samples, other, difference] = d->series[i];
    const double value = samples.valueAt(time);
    const double before = other.empty() ? kNaN : other.lineAt(time);
    const QString& unit = axes()[axis].unit;
    if (std::isfinite(value)) lines.push_back({name, amountText(value, unit), static_cast<int>(i)});
    if (std::isfinite(before)) lines.push_back({d->otherRun, amountText(before, unit), static_cast<int>(i)});
    if (std::isfinite(value - before))
      lines.push_back({QStringLiteral("difference"), amountText(value - before, unit)});
  }
  return lines;
}

/// Of a curve that stays beside a line that is known, its mean is compared with that.
std::vector<PlotLine> GraphView::measure(double from, double to) const {
  std::vector<PlotLine> lines{
      {QStringLiteral("A to B: ") + placeText(to - from), QStringLiteral("change · slope · area")}};
  const double span = axes().front().high() - axes().front().low();
  for (size_t i = 0; i < d->series.size(); ++i) {
    const auto& [name, axis, samples, other, difference] = d->series[i];
    const double change = samples.valueAt(to) - samples.valueAt(from), area = samples.integral(from, to);
    if (!std::isfinite(change) || !(to > from)) continue;
    const QString& unit = axes()[axis].unit;
    lines.push_back({name,
                     amountText(change, unit) + QStringLiteral(" · ") +
                         amountText(change / (to - from), perSecond(unit)) + QStringLiteral(" · ") +
                         amountText(area, timesSeconds(unit)),
                     static_cast<int>(i)});
    const SampleSeries::Extent extent = samples.extent(samples.indexAt(from), samples.indexAt(to) + 1);
    for (const ReferenceLine& line : d->references) {
      const double mean = area / (to - from);
      if (axis > 0 || std::max(std::abs(extent.high - line.value), std::abs(extent.low - line.value)) > 0.05 * span)
        continue;
      lines.push_back({QStringLiteral("mean, %1 at %2").arg(line.label, amountText(line.value, unit)),
                       amountText(mean, unit) + QStringLiteral(", off by ") + amountText(mean - line.value, unit, 2)});
    }
  }
  return lines;
}

}  // namespace ps
