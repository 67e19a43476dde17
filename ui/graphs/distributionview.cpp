// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/distributionview.h"

#include "ui/graphs/graphexport.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>
#include <QtGui/QPolygonF>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

float place(const api::Float4& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

}  // namespace

void DistributionView::show(const Snapshot& snapshot, const Graph& graph, const ParticleField* field) {
  m_bins.clear();
  m_profile = graph.kind == Graph::Kind::Profile;
  const ShownField shown(snapshot, graph.field);
  if (shown && field && snapshot.bodyIds) {
    const SeriesUnit unit(field->unit);
    setUnit(m_profile ? unit.shown : QString());
    m_ofValues = unit;
    m_ofAlong = m_profile ? SeriesUnit("m") : unit;
    m_title = m_profile ? field->label + " [" + field->unit + "]" : "particles";
    m_titleAlong = m_profile ? std::string("xyz").substr(static_cast<size_t>(graph.axis), 1) + "_m"
                             : field->label + " [" + field->unit + "]";
    const auto& ids = *snapshot.bodyIds;
    const auto body = static_cast<size_t>(std::find(ids.begin(), ids.end(), graph.body) - ids.begin());
    std::vector<double> along, values;
    for (size_t i = 0; i < snapshot.position.size(); ++i) {
      if (graph.body.empty() ? snapshot.motion[i] == api::Motion::Static : snapshot.body[i] != body) continue;
      const double value = unit.of(double{shown[i]});
      if (!std::isfinite(value)) continue;
      values.push_back(value);
      along.push_back(m_profile ? double{place(snapshot.position[i], graph.axis)} : value);
    }
    fill(along, values);
  }
  dataChanged();
}

void DistributionView::fill(const std::vector<double>& along, const std::vector<double>& values) {
  if (along.empty()) return;
  const auto [low, high] = std::minmax_element(along.begin(), along.end());
  const double least = std::max(1e-6, 1e-4 * std::abs(*high));  // what is everywhere alike is one bin among others
  const double room = std::max(0.0, (least - (*high - *low)) / 2);
  m_low = *low - room, m_high = *high + room;
  m_bins.resize(kBins);
  for (size_t i = 0; i < along.size(); ++i) {
    const double share = (along[i] - m_low) / (m_high - m_low) * double{kBins};
    Bin& bin = m_bins[std::min(static_cast<size_t>(share), kBins - 1)];
    bin.low = bin.count == 0 ? values[i] : std::min(bin.low, values[i]);
    bin.high = bin.count == 0 ? values[i] : std::max(bin.high, values[i]);
    bin.sum += values[i];
    ++bin.count;
  }
}

std::pair<double, double> DistributionView::fittedRange() const {
  return m_bins.empty() ? std::pair{0.0, 1.0} : std::pair{m_low, m_high};
}

std::pair<double, double> DistributionView::valueExtent(size_t axis, double, double) const {
  double low = INFINITY, high = -INFINITY, most = 1;
  for (const Bin& bin : m_bins) {
    if (bin.count == 0) continue;
    low = std::min(low, bin.low), high = std::max(high, bin.high), most = std::max(most, bin.count);
  }
  const bool logarithmic = axes()[axis].logarithmic;
  if (!m_profile) return roomFor(axis, logarithmic ? 0.8 : 0, most, 0);
  if (logarithmic) return high > 0 ? roomFor(axis, std::max(low, high * 1e-6), high, 0.06) : std::pair{1e-3, 1.0};
  const double span = std::max({high - low, 1e-6, 5e-3 * std::max(std::abs(low), std::abs(high))});
  const double middle = (low + high) / 2;
  return roomFor(axis, std::min(low, middle - span / 2), std::max(high, middle + span / 2), 0.08);
}

void DistributionView::paintData(QPainter& painter) {
  const QColor colour = Theme::current().series(0);
  painter.setRenderHint(QPainter::Antialiasing, m_profile);
  QColor between = colour;
  between.setAlphaF(m_profile ? 0.28f : 0.85f);
  QPolygonF means;  // in steps, as far as bins with particles lie side by side
  const auto flush = [&] {
    painter.setPen(QPen(colour, 1.5));
    if (m_profile) painter.drawPolyline(means);
    means.clear();
  };
  for (size_t i = 0; i < m_bins.size(); ++i) {
    const Bin& bin = m_bins[i];
    if (bin.count == 0) {
      flush();
      continue;
    }
    const double top = y(m_profile ? bin.high : bin.count), bottom = m_profile ? y(bin.low) : plotRect().bottom();
    const double left = x(edge(i)), right = x(edge(i + 1)), gap = m_profile || right - left < 3 ? 0 : 1;
    painter.fillRect(QRectF(QPointF(left, top), QPointF(right - gap, std::max(bottom, top + 1))), between);
    means << QPointF(left, y(bin.mean())) << QPointF(right, y(bin.mean()));
  }
  flush();
}

QString DistributionView::placeText(double at) const { return amountText(at, m_ofAlong.shown, 3); }

const DistributionView::Bin* DistributionView::binAt(double at) const {
  const double share = (at - m_low) / (m_high - m_low) * double{kBins};
  return share >= 0 && share <= double{kBins} && !m_bins.empty()
             ? &m_bins[std::min(static_cast<size_t>(share), kBins - 1)]
             : nullptr;
}

std::vector<PlotLine> DistributionView::readOut(double at) const {
  const Bin* bin = binAt(at);
  if (!bin || (m_profile && bin->count == 0)) return {};
  const QString& unit = axes()[0].unit;
  std::vector<PlotLine> lines;
  if (m_profile) {
    lines = {{QStringLiteral("Highest"), amountText(bin->high, unit)},
             {QStringLiteral("Mean"), amountText(bin->mean(), unit)},
             {QStringLiteral("Lowest"), amountText(bin->low, unit)}};
  }
  lines.push_back({QStringLiteral("Particles"), formatFixed(bin->count)});
  return lines;
}

std::vector<PlotLine> DistributionView::measure(double from, double to) const {
  double count = 0, sum = 0;
  for (size_t i = 0; i < m_bins.size(); ++i) {
    const double middle = (edge(i) + edge(i + 1)) / 2;
    if (middle < from || middle > to) continue;
    count += m_bins[i].count;
    sum += m_bins[i].sum;
  }
  const QString& unit = m_profile ? axes()[0].unit : m_ofAlong.shown;
  std::vector<PlotLine> lines{{QStringLiteral("A to B"), placeText(to - from)},
                              {QStringLiteral("Particles"), formatFixed(count)}};
  if (count > 0) lines.push_back({QStringLiteral("Mean"), amountText(sum / count, unit)});
  const Bin *first = binAt(from), *last = binAt(to);
  if (!m_profile || !first || !last || first->count == 0 || last->count == 0 || !(to > from)) return lines;
  const double change = last->mean() - first->mean();
  lines.push_back({QStringLiteral("Change"), amountText(change, unit)});
  lines.push_back(
      {QStringLiteral("Slope"), formatNumber(change / (to - from)) + QLatin1Char(' ') + unit + QStringLiteral("/m")});
  return lines;
}

QByteArray DistributionView::csv() const {
  QByteArray text = quotedCell("from " + m_titleAlong) + ',' + quotedCell("to " + m_titleAlong) + ",particles";
  if (m_profile)
    text += ',' + quotedCell("mean " + m_title) + ',' + quotedCell("lowest " + m_title) + ',' +
            quotedCell("highest " + m_title);
  text += '\n';
  for (size_t i = 0; i < m_bins.size(); ++i) {
    const Bin& bin = m_bins[i];
    text += numberCell(m_ofAlong.stored(edge(i))) + ',' + numberCell(m_ofAlong.stored(edge(i + 1))) + ',' +
            numberCell(bin.count);
    if (m_profile && bin.count > 0)
      text += ',' + numberCell(m_ofValues.stored(bin.mean())) + ',' + numberCell(m_ofValues.stored(bin.low)) + ',' +
              numberCell(m_ofValues.stored(bin.high));
    else if (m_profile)
      text += ",,,";
    text += '\n';
  }
  return text;
}

}  // namespace ps
