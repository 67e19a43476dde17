// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/stackview.h"

#include "ui/graphs/sampleseries.h"
#include "ui/theme/legend.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>
#include <QtGui/QPolygonF>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kGrams = 1e3;
constexpr double kVisible = 1e-4;  ///< share of the whole below which a part has no label
constexpr double kLow = 44;        ///< px of a plot, below which a label may reach as high as the title

std::vector<StackView::Layer> phaseLayers() {
  std::vector<StackView::Layer> layers;
  const ColourMap& map = colourMap(QStringLiteral("phase"));
  for (size_t phase = 0; phase < 5; ++phase)
    layers.push_back({phaseName(static_cast<api::Phase>(phase)), map.classes[phase].first});
  return layers;
}

}  // namespace

struct StackView::Private {
  std::vector<Layer> layers;
  QString line;
  std::vector<SampleSeries> values;
  SampleSeries above, below, held;  ///< sums of what is above 0 and below it; the line

  /// Where a layer ends away from 0 at a sample, or at a time.
  template <class Of>
  double edge(size_t layer, bool up, Of of) const {
    double sum = 0;
    for (size_t k = 0; k <= layer; ++k) {
      const double value = of(values[k]);
      if (up ? value > 0 : value < 0) sum += value;
    }
    return sum;
  }
};

StackView::StackView(std::vector<Layer> layers, const QString& unit, QWidget* parent)
    : TimePlot(parent), d(std::make_unique<Private>()) {
  d->layers = std::move(layers);
  d->values.resize(d->layers.size());
  setUnit(unit);
}
StackView::~StackView() = default;

void StackView::setLine(const QString& name) { d->line = name; }

void StackView::append(double time, std::span<const double> values, double line) {
  if (!std::isfinite(time)) return;
  double above = 0, below = 0;
  for (size_t k = 0; k < d->values.size(); ++k) {
    const double value = std::isfinite(values[k]) ? values[k] : 0;
    d->values[k].append(time, value);
    (value > 0 ? above : below) += value;
  }
  d->above.append(time, above);
  d->below.append(time, below);
  d->held.append(time, line);
  dataChanged();
}

void StackView::clear() {
  for (SampleSeries& series : d->values) series.clear();
  for (SampleSeries* series : {&d->above, &d->below, &d->held}) series->clear();
  dataChanged();
}

size_t StackView::sampleCount() const { return d->above.size(); }

bool StackView::hasData() const {
  if (!d->line.isEmpty()) return !d->held.empty();
  return d->above.extent(0, d->above.size()).high > 0 || d->below.extent(0, d->below.size()).low < 0;
}

double StackView::lastTime() const { return d->above.empty() ? 0 : d->above.lastTime(); }

/// Of the whole run: a scale that breathes while one pans would hide what changes.
std::pair<double, double> StackView::valueExtent(size_t axis, double, double) const {
  double high = std::max(0.0, d->above.extent(0, d->above.size()).high);
  double low = std::min(0.0, d->below.extent(0, d->below.size()).low);
  if (!d->line.isEmpty()) {
    const SampleSeries::Extent held = d->held.extent(0, d->held.size());
    high = std::max(high, held.high), low = std::min(low, held.low);
  }
  if (!(high - low > 1e-3)) return {low, low + 1};
  return roomFor(axis, low, high, low < 0 ? 0.06 : 0);
}

void StackView::paintLayers(QPainter& painter, const std::vector<size_t>& columns, bool above) const {
  const SampleSeries& times = d->above;
  // From the outermost layer in, each area reaching to 0: no seam of the ground shows between two of them.
  for (size_t layer = d->layers.size(); layer-- > 0;) {
    QPolygonF area;
    bool any = false;
    area << QPointF(x(times[columns.front()].time), y(0));
    for (const size_t index : columns) {
      const double edge = d->edge(layer, above, [&](const SampleSeries& s) { return s[index].high; });
      any = any || edge != 0;
      area << QPointF(x(times[index].time), y(edge));
    }
    area << QPointF(x(times[columns.back()].time), y(0));
    painter.setBrush(colourOf(layer));
    if (any) painter.drawPolygon(area);
    if (!any || !isHatched(layer)) continue;
    painter.setBrush(QBrush(Theme::current()[Token::Window], Qt::BDiagPattern));
    painter.drawPolygon(area);
  }
}

void StackView::paintData(QPainter& painter) {
  const QRectF plot = plotRect();
  const double scale = painter.device()->devicePixelRatioF();
  const auto [first, last] = range();
  const double perColumn = (last - first) / (plot.width() * scale);
  const SampleSeries& times = d->above;
  // One sample per device pixel column; all layers of a column from the same sample, so that areas never overlap.
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
  paintLayers(painter, columns, true);
  if (d->below.extent(0, d->below.size()).low < 0) {
    paintLayers(painter, columns, false);
    paintHorizontalLine(painter, plot.left(), plot.right(), y(0), Theme::current()[Token::ControlEdge]);
  }
  if (d->line.isEmpty()) return;
  QPolygonF line;
  for (const size_t index : columns) line << QPointF(x(times[index].time), y(d->held[index].high));
  QPen pen(Theme::current()[Token::Text], 1.5, Qt::CustomDashLine, Qt::FlatCap, Qt::BevelJoin);
  pen.setDashPattern({2, 1.5});
  painter.setPen(pen);
  painter.drawPolyline(line);
}

/// At the right, where least is drawn; in a plot so low that labels stand as high as it, on the side that they leave.
QRectF StackView::paintTitle(QPainter& painter, double present) const {
  const QRectF plot = plotRect();
  if (plot.height() < kLow && present > plot.center().x()) {
    paintHeading(painter);
    return headingRect();
  }
  const QFont font = Theme::font(TextRole::Small);
  const double wide = std::min(textWidth(axisTitle(), font) + 1, plot.width() - 14);
  const QRectF place(plot.right() - 7 - wide, plot.top() + 3, wide, 16);
  paintText(painter, place, Qt::AlignRight | Qt::AlignVCenter, axisTitle(), font, Theme::current()[Token::Muted]);
  return place;
}

void StackView::paintLabels(QPainter& painter) {
  const Theme& theme = Theme::current();
  const QRectF plot = plotRect();
  const QFont font = Theme::font(TextRole::Small);
  const double end = std::min(labelTime(lastTime()), range().second);
  std::vector<QRectF> taken{paintTitle(painter, x(end))};
  struct Label {
    double top;
    size_t layer;
    QString text;
  };
  std::vector<Label> labels;
  const auto at = [end](const SampleSeries& s) { return s.valueAt(end); };
  const double total = d->above.valueAt(end) - d->below.valueAt(end);
  for (size_t layer = 0; layer < d->layers.size(); ++layer) {
    const double value = at(d->values[layer]);
    if (!(std::abs(value) > kVisible * total)) continue;
    const double middle = y(d->edge(layer, value > 0, at) - value / 2);
    labels.push_back(
        {middle - 8, layer, d->layers[layer].name + QLatin1Char(' ') + amountText(value, axes()[0].unit, 3)});
  }
  std::sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.top < b.top; });
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
    const double left = labelLeft(edge - 2, width);
    const QRectF swatch(left, label.top + 1, 14, 14);
    const QRectF text(swatch.right() + 5, label.top, width - 19, 16);
    taken.push_back(swatch.united(text).adjusted(-2, 0, 3, 0));
    // Over what is drawn: left of the place, and right of it while that is not the end.
    if (left < x(lastTime())) {
      QColor ground = theme[Token::Field];
      ground.setAlphaF(0.92f);
      paintBox(painter, taken.back(), ground, QColor(), 3);
    }
    const QColor colour = colourOf(label.layer);
    paintBox(painter, swatch, colour, theme[Token::Line2], 3);
    const QColor dark = theme[theme.dark() ? Token::Window : Token::Text],
                 light = theme[theme.dark() ? Token::Text : Token::Panel];
    paintText(painter, swatch, Qt::AlignCenter, d->layers[label.layer].letter, font,
              contrast(colour, dark) > contrast(colour, light) ? dark : light);
    paintText(painter, text, Qt::AlignLeft | Qt::AlignVCenter, label.text, font, theme[Token::Text]);
  }
  paintMarkerNames(painter, std::move(taken));
}

std::vector<PlotLine> StackView::readOut(double time) const {
  std::vector<PlotLine> lines;
  for (size_t layer = d->layers.size(); layer-- > 0;) {
    const double value = d->values[layer].valueAt(time);
    if (std::isfinite(value) && value != 0) lines.push_back({d->layers[layer].name, amountText(value, axes()[0].unit)});
  }
  const double held = d->held.valueAt(time);
  if (!d->line.isEmpty() && std::isfinite(held)) lines.push_back({d->line, amountText(held, axes()[0].unit)});
  return lines;
}

/// What is expected of the line is what the areas add up to.
std::vector<PlotLine> StackView::measure(double from, double to) const {
  const QString& unit = axes()[0].unit;
  std::vector<PlotLine> lines{{QStringLiteral("A to B: ") + placeText(to - from), QStringLiteral("change")}};
  const auto change = [&](const SampleSeries& series) { return series.valueAt(to) - series.valueAt(from); };
  for (size_t layer = d->layers.size(); layer-- > 0;) {
    const double value = change(d->values[layer]);
    if (std::isfinite(value) && value != 0) lines.push_back({d->layers[layer].name, amountText(value, unit)});
  }
  const double held = change(d->held), given = change(d->above) + change(d->below);
  if (d->line.isEmpty() || !std::isfinite(held)) return lines;
  lines.push_back({d->line, amountText(held, unit)});
  lines.push_back({QStringLiteral("expected, as given"), amountText(given, unit)});
  lines.push_back({QStringLiteral("balance open by"), amountText(held - given, unit, 2)});
  return lines;
}

PhaseStackView::PhaseStackView(QWidget* parent) : StackView(phaseLayers(), QStringLiteral("g"), parent) {
  setTitle(QStringLiteral("Mass by phase"));
}

void PhaseStackView::append(double time, const std::array<double, 5>& kilograms) {
  std::array<double, 5> grams{};
  for (size_t i = 0; i < grams.size(); ++i) grams[i] = std::max(0.0, kilograms[i]) * kGrams;
  StackView::append(time, grams);
}

QColor PhaseStackView::colourOf(size_t layer) const { return colourMap(QStringLiteral("phase")).stops[layer].second; }

/// What melts is as dark as what is solid, where colours do not show, and what boils as bright as a liquid.
bool PhaseStackView::isHatched(size_t layer) const {
  const auto phase = static_cast<api::Phase>(layer);
  return phase == api::Phase::Melting || phase == api::Phase::Boiling;
}

EnergyStackView::EnergyStackView(QWidget* parent)
    : StackView({{QStringLiteral("Through walls"), QStringLiteral("W")},
                 {QStringLiteral("Through air"), QStringLiteral("A")},
                 {QStringLiteral("By radiation"), QStringLiteral("R")},
                 {QStringLiteral("By heaters"), QStringLiteral("H")},
                 {QStringLiteral("With matter"), QStringLiteral("M")}},
                QStringLiteral("J"), parent) {
  setTitle(QStringLiteral("Heat since the start"));
  setLine(QStringLiteral("In matter"));
}

void EnergyStackView::append(double time, const Parts& given, double held) {
  StackView::append(time, std::array{given.walls, given.air, given.radiation, given.heaters, given.matter}, held);
}

QColor EnergyStackView::colourOf(size_t layer) const { return Theme::current().series(static_cast<int>(layer)); }

}  // namespace ps
