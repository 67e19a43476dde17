// SPDX-License-Identifier: Apache-2.0
#include "ui/library/phaseview.h"

#include "ui/library/materialcard.h"
#include "ui/library/materiallibrary.h"
#include "ui/theme/legend.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"
#include "ui/theme/units.h"

#include <QtGui/QPainter>
#include <QtGui/QPolygonF>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace ps {
namespace {

constexpr double kLowest = 10, kHighest = 1e8;                    // Pa, ends of the axis of all
constexpr double kLeast = 20, kAround = 0.08;                     // K and share of the axis beyond what is shown
constexpr double kVapour = 1.25;                                  // boiling points that are shown of what has no end
constexpr double kLeft = 54, kTop = 18, kBottom = 17, kGap = 10;  // px
constexpr double kWidest = 300, kLabel = 64, kLine = 14;          // px
constexpr int kLetter = 7;                                        // px above and below the middle of a letter

/// How hot its lines get, K, as far as they say something.
double hottestOf(const Material& values, const PhaseLines& lines) {
  double hottest = 0;
  for (const PhasePoint& point : lines.melting) hottest = std::max(hottest, point.temperature);
  for (const PhasePoint& point : lines.sublimation) hottest = std::max(hottest, point.temperature);
  if (lines.boiling.empty()) return hottest;
  const double end = lines.critical ? lines.critical->temperature : kVapour * phaseDiagramOf(values).boilingPoint(kAir);
  return std::max(hottest, std::min(lines.boiling.back().temperature, end));
}

QString textOf(const LibraryEntry& entry, const PhaseLines& lines) {
  QString text = QStringLiteral("%1 at 1 atm %2").arg(entry.label, transitionsText(entry));
  if (lines.triple)
    text += QStringLiteral("; triple point at %1 and %2")
                .arg(temperatureText(lines.triple->temperature, 1),
                     formatPrefixed(lines.triple->pressure, QStringLiteral("Pa"), 3));
  if (lines.critical)
    text += QStringLiteral("; critical point at %1").arg(temperatureText(lines.critical->temperature, 1));
  return text;
}

/// Where a letter has the most room, the nearer to the middle the better.
std::optional<QPointF> letterPlace(const std::vector<std::pair<double, double>>& spans) {
  std::optional<QPointF> best;
  double most = 0;
  const int rows = static_cast<int>(spans.size());
  for (int row = kLetter; row + kLetter < rows; ++row) {
    double left = 0, right = std::numeric_limits<double>::infinity();
    for (int k = row - kLetter; k <= row + kLetter; ++k) {
      left = std::max(left, spans[static_cast<size_t>(k)].first);
      right = std::min(right, spans[static_cast<size_t>(k)].second);
    }
    const double room = right - left - std::abs(row - rows / 2) / 2.0;
    if (right - left < kLine || (best && room <= most)) continue;
    most = room;
    best = QPointF((left + right) / 2, row + 0.5);
  }
  return best;
}

/// Seen on every ground.
void paintTwice(QPainter& painter, const QPolygonF& line, double width, Qt::PenStyle style) {
  const Theme& theme = Theme::current();
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(theme[Token::Field], style == Qt::SolidLine ? width + 2 : width));
  painter.drawPolyline(line);
  painter.setPen(QPen(theme[Token::Text], width, style));
  painter.drawPolyline(line);
}

}  // namespace

PhaseView::PhaseView(QWidget* parent) : QWidget(parent) {
  setAccessibleName(QStringLiteral("Phase diagram"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void PhaseView::showMaterials(const std::vector<const LibraryEntry*>& entries) {
  m_shown.clear();
  m_cold = m_hot = kRoom;
  QStringList texts;
  for (const LibraryEntry* entry : entries) {
    Shown shown{entry->label, entry->values, phaseLines(phaseDiagramOf(entry->values), kLowest, kHighest)};
    for (const auto* line : {&shown.lines.melting, &shown.lines.boiling, &shown.lines.sublimation}) {
      for (const PhasePoint& point : *line) m_cold = std::min(m_cold, point.temperature);
    }
    m_hot = std::max(m_hot, hottestOf(shown.values, shown.lines));
    texts << textOf(*entry, shown.lines);
    m_shown.push_back(std::move(shown));
  }
  const double around = std::max(kLeast, kAround * (m_hot - m_cold));
  m_cold = std::max(0.0, m_cold - around);
  m_hot += around;
  setAccessibleDescription(texts.join(QLatin1Char('\n')));
  setToolTip(accessibleDescription());
  setVisible(!entries.empty());
  update();
}

QPointF PhaseView::placeOf(const QRectF& plot, const PhasePoint& point) const {
  return {plot.left() + plot.width() * (point.temperature - m_cold) / (m_hot - m_cold),
          plot.bottom() - plot.height() * std::log(point.pressure / kLowest) / std::log(kHighest / kLowest)};
}

void PhaseView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const auto count = static_cast<double>(m_shown.size());
  const double width = std::min(kWidest, std::floor((this->width() - kLeft - kGap * (count - 1)) / count));
  QRectF plot(kLeft, kTop, width, height() - kTop - kBottom);
  for (const Shown& shown : m_shown) {
    paintText(painter, QRectF(plot.left(), 0, width, kTop - 2), Qt::AlignLeft | Qt::AlignVCenter, shown.label,
              Theme::font(TextRole::Small), Theme::current()[Token::Text2]);
    painter.setClipRect(plot);
    painter.setRenderHint(QPainter::Antialiasing, false);
    paintRegions(painter, plot, shown);
    painter.setRenderHint(QPainter::Antialiasing);
    paintLines(painter, plot, shown);
    painter.setClipping(false);
    paintAxes(painter, plot, &shown == &m_shown.front());
    plot.translate(width + kGap, 0);
  }
}

/// Row by row, which is one pressure each.
void PhaseView::paintRegions(QPainter& painter, const QRectF& plot, const Shown& shown) const {
  const ColourMap map = colourMap(QStringLiteral("phase"));
  const auto rows = static_cast<size_t>(plot.height());
  constexpr std::array kPhases{api::Phase::Solid, api::Phase::Liquid, api::Phase::Gas};
  std::array<Spans, kPhases.size()> spans;
  spans.fill(Spans(rows, {0, 0}));
  for (size_t row = 0; row < rows; ++row) {
    const double share = 1 - (static_cast<double>(row) + 0.5) / plot.height();
    for (const PhaseBand& band : bandsOf(shown.values, kLowest * std::pow(kHighest / kLowest, share))) {
      const double from = std::clamp(band.from, m_cold, m_hot), to = std::clamp(band.to, m_cold, m_hot);
      const double left = placeOf(plot, {from, kLowest}).x(), right = placeOf(plot, {to, kLowest}).x();
      const QRectF part(left, plot.top() + static_cast<double>(row), right - left, 1);
      painter.fillRect(part, map.stops[static_cast<size_t>(band.phase)].second);
      const auto phase = std::find(kPhases.begin(), kPhases.end(), band.phase) - kPhases.begin();
      spans[static_cast<size_t>(phase)][row] = {left, right};
    }
  }
  for (size_t k = 0; k < kPhases.size(); ++k) {
    const std::optional<QPointF> place = letterPlace(spans[k]);
    if (!place) continue;
    const QRectF letter(place->x() - kLine / 2, plot.top() + place->y() - kLine / 2, kLine, kLine);
    paintText(painter, letter, Qt::AlignCenter, phaseLetter(kPhases[k]), Theme::font(TextRole::Small),
              inkOn(map.stops[static_cast<size_t>(kPhases[k])].second));
  }
}

void PhaseView::paintLines(QPainter& painter, const QRectF& plot, const Shown& shown) const {
  const auto mark = [&](const PhasePoint& from, const PhasePoint& to) {
    paintTwice(painter, QPolygonF{{placeOf(plot, from), placeOf(plot, to)}}, 1, Qt::DashLine);
  };
  mark({kRoom, kLowest}, {kRoom, kHighest});
  mark({m_cold, kAir}, {m_hot, kAir});
  for (const auto* line : {&shown.lines.melting, &shown.lines.boiling, &shown.lines.sublimation}) {
    QPolygonF points;
    for (const PhasePoint& point : *line) points << placeOf(plot, point);
    if (points.size() > 1) paintTwice(painter, points, 1.25, Qt::SolidLine);
  }
  painter.setPen(QPen(Theme::current()[Token::Field], 1));
  painter.setBrush(Theme::current()[Token::Text]);
  for (const auto& point : {shown.lines.triple, shown.lines.critical}) {
    if (point) painter.drawEllipse(placeOf(plot, *point), 3, 3);
  }
}

/// Ends of the axes, and what the two marks are; the mark's words win where both have no room.
void PhaseView::paintAxes(QPainter& painter, const QRectF& plot, bool pressures) const {
  const QFont font = Theme::font(TextRole::Small);
  const QColor colour = Theme::current()[Token::Muted];
  const auto pressure = [&](double pascal, const QString& text) {
    const double y = std::clamp(placeOf(plot, {m_cold, pascal}).y(), plot.top() + kLine / 2, plot.bottom() - kLine / 2);
    paintText(painter, QRectF(0, y - kLine / 2, kLeft - 5, kLine), Qt::AlignRight | Qt::AlignVCenter, text, font,
              colour);
  };
  if (pressures) {
    for (const double end : {kLowest, kHighest}) pressure(end, formatPrefixed(end, QStringLiteral("Pa"), 2));
    pressure(kAir, QStringLiteral("1 atm"));
  }
  const auto room = [&](double kelvin) { return textWidth(temperatureText(kelvin, 0), font); };
  const QRectF words(plot.left(), plot.bottom() + 2, plot.width(), kLine);
  const double half = room(kRoom) / 2;
  const double middle = std::clamp(placeOf(plot, {kRoom, kAir}).x(), words.left() + half, words.right() - half);
  paintText(painter, QRectF(middle - kLabel / 2, words.top(), kLabel, kLine), Qt::AlignCenter,
            temperatureText(kRoom, 0), font, colour);
  if (words.left() + room(m_cold) + kGap < middle - half)
    paintText(painter, words, Qt::AlignLeft | Qt::AlignVCenter, temperatureText(m_cold, 0), font, colour);
  if (middle + half + kGap < words.right() - room(m_hot))
    paintText(painter, words, Qt::AlignRight | Qt::AlignVCenter, temperatureText(m_hot, 0), font, colour);
}

}  // namespace ps
