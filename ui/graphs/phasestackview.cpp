// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/phasestackview.h"

#include "ui/graphs/sampleseries.h"
#include "ui/theme/legend.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>
#include <QtGui/QPolygonF>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr size_t kPhases = 5;
constexpr double kGrams = 1e3;
const QString kUnit = QStringLiteral("g");

}  // namespace

/// Cumulative mass in grams up to each phase; the last is the total.
struct PhaseStackView::Private {
  std::array<SampleSeries, kPhases> cumulative;
  double massAt(size_t phase, double time) const {
    const double below = phase == 0 ? 0 : cumulative[phase - 1].valueAt(time);
    return cumulative[phase].valueAt(time) - below;
  }
};

PhaseStackView::PhaseStackView(QWidget* parent) : TimePlot(parent), d(std::make_unique<Private>()) {
  setTitle(QStringLiteral("Mass by phase"));
  setPrefixedUnit(kUnit);
}
PhaseStackView::~PhaseStackView() = default;

void PhaseStackView::append(double time, const std::array<double, 5>& kilograms) {
  if (!std::isfinite(time)) return;
  double sum = 0;
  for (size_t phase = 0; phase < kPhases; ++phase) {
    sum += std::max(0.0, kilograms[phase]) * kGrams;
    d->cumulative[phase].append(time, sum);
  }
  dataChanged();
}

void PhaseStackView::clear() {
  for (SampleSeries& series : d->cumulative) series.clear();
  dataChanged();
}

size_t PhaseStackView::sampleCount() const { return d->cumulative[0].size(); }
bool PhaseStackView::hasData() const {
  const SampleSeries& total = d->cumulative[kPhases - 1];
  return total.extent(0, total.size()).high > 0;
}
double PhaseStackView::lastTime() const { return d->cumulative[0].lastTime(); }

std::pair<double, double> PhaseStackView::valueExtent(double, double) const {
  // The total of the whole run: a scale that breathes while one pans would hide what changes.
  const SampleSeries& total = d->cumulative[kPhases - 1];
  const double high = total.extent(0, total.size()).high;
  return {0, high > 0 ? clearOfTitle(0, high) : 1};
}

void PhaseStackView::paintData(QPainter& painter) {
  const ColourMap& map = colourMap(QStringLiteral("phase"));
  const QRectF plot = plotRect();
  const double scale = painter.device()->devicePixelRatioF();
  const auto [first, last] = timeRange();
  const double perColumn = (last - first) / (plot.width() * scale);
  const SampleSeries& times = d->cumulative[0];
  // One sample per device pixel column; all phases of a column from the same sample, so that areas never overlap.
  std::vector<size_t> columns;
  size_t at = times.indexAt(first);
  if (at > 0) --at;
  const size_t end = std::min(times.size(), times.indexAt(last) + 1);
  while (at < end) {
    columns.push_back(at);
    const double column = std::floor((times[at].time - first) / perColumn);
    at = std::max(at + 1, times.indexAt(first + (column + 1) * perColumn));
  }
  if (columns.empty() || columns.back() + 1 != end) columns.push_back(end - 1);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  // From the topmost phase down, each area reaching to the bottom: no seam of the ground shows between two of them.
  for (size_t phase = kPhases; phase-- > 0;) {
    QPolygonF area;
    area << QPointF(x(times[columns.front()].time), y(0));
    for (const size_t index : columns) area << QPointF(x(times[index].time), y(d->cumulative[phase][index].high));
    area << QPointF(x(times[columns.back()].time), y(0));
    painter.setBrush(map.stops[phase].second);
    painter.drawPolygon(area);
  }
}

void PhaseStackView::paintLabels(QPainter& painter) {
  const Theme& theme = Theme::current();
  const QRectF plot = plotRect();
  const QFont font = Theme::font(TextRole::Small);
  const ColourMap& map = colourMap(QStringLiteral("phase"));
  const double end = std::min(lastTime(), timeRange().second);
  paintText(painter, QRectF(plot.left() + 7, plot.top() + 3, plot.width() - 14, 16), Qt::AlignRight | Qt::AlignVCenter,
            axisTitle(), font, theme[Token::Muted]);
  struct Label {
    double middle, top;
    size_t phase;
    QString text;
  };
  std::vector<Label> labels;
  const double total = d->cumulative[kPhases - 1].valueAt(end);
  for (size_t phase = kPhases; phase-- > 0;) {
    const double mass = d->massAt(phase, end);
    if (!(mass > 1e-4 * total)) continue;
    const double middle = y(d->cumulative[phase].valueAt(end) - mass / 2);
    labels.push_back({middle, middle - 8, phase,
                      phaseName(static_cast<api::Phase>(phase)) + QLatin1Char(' ') + formatPrefixed(mass, kUnit, 3)});
  }
  for (size_t i = 0; i < labels.size(); ++i) {
    labels[i].top = std::max(labels[i].top, i == 0 ? plot.top() + titleStrip() - 3 : labels[i - 1].top + 16);
  }
  for (size_t i = labels.size(); i-- > 0;) {
    labels[i].top = std::min(labels[i].top, i + 1 == labels.size() ? plot.bottom() - 17 : labels[i + 1].top - 16);
  }
  const double edge = x(end);
  for (const Label& label : labels) {
    if (label.top < plot.top() + titleStrip() - 4) continue;  // too low a plot for all of them
    const double width = textWidth(label.text, font) + 22;
    const bool right = edge + 6 + width < plot.right() - 2;
    const QRectF swatch(right ? edge + 6 : edge - 6 - width, label.top + 1, 14, 14);
    const QRectF text(swatch.right() + 5, label.top, width - 19, 16);
    if (!right) {
      QColor ground = theme[Token::Field];
      ground.setAlphaF(0.8f);
      paintBox(painter, swatch.united(text).adjusted(-2, 0, 3, 0), ground, QColor(), 3);
    }
    const QColor colour = map.stops[label.phase].second;
    paintBox(painter, swatch, colour, theme[Token::Line2], 3);
    const QColor dark = theme[theme.dark() ? Token::Window : Token::Text],
                 light = theme[theme.dark() ? Token::Text : Token::Panel];
    paintText(painter, swatch, Qt::AlignCenter, map.classes[label.phase].first, font,
              contrast(colour, dark) > contrast(colour, light) ? dark : light);
    paintText(painter, text, Qt::AlignLeft | Qt::AlignVCenter, label.text, font, theme[Token::Text]);
  }
}

QStringList PhaseStackView::readOut(double time) const {
  QStringList lines{formatFixed(time, 2) + QStringLiteral(" s")};
  for (size_t phase = kPhases; phase-- > 0;) {
    const double mass = d->massAt(phase, time);
    if (mass > 0)
      lines << phaseName(static_cast<api::Phase>(phase)) + QStringLiteral("  ") + formatPrefixed(mass, kUnit);
  }
  return lines.size() > 1 ? lines : QStringList();
}

}  // namespace ps
