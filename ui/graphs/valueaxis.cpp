// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/valueaxis.h"

#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ps {
namespace {

/// The largest amount on an axis.
double mostOf(const Ticks& ticks) {
  return ticks.count > 0 ? std::max(std::abs(ticks.at(0)), std::abs(ticks.at(ticks.count - 1))) : 0;
}
bool isPlain(double most) { return most == 0 || (most < 1e6 && most >= 1e-3); }

}  // namespace

double Ticks::at(int index) const {
  const double place = first + index * step;
  return decades ? std::pow(10.0, place) : place;
}

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

Ticks logTicks(double low, double high, int most) {
  if (!(low > 0) || !(high > low) || most < 1) return {};
  const double first = std::ceil(std::log10(low) - 1e-9), last = std::floor(std::log10(high) + 1e-9);
  if (last - first < 2) return niceTicks(low, high, most);
  Ticks ticks{.first = first, .step = std::ceil((last - first + 1) / most), .decades = true};
  ticks.count = static_cast<int>(std::floor((last - first) / ticks.step)) + 1;
  return ticks;
}

QString tickText(const Ticks& ticks, int index) {
  if (ticks.decades) return formatShort(ticks.at(index), 1);
  const double most = mostOf(ticks);
  if (isPlain(most)) return formatFixed(ticks.at(index), ticks.decimals);
  // A power of ten: digits down to the step, and one more for steps of two and a half.
  return formatShort(ticks.at(index),
                     std::clamp(static_cast<int>(std::ceil(std::log10(most / ticks.step))) + 2, 2, 15));
}

QString curveText(const Ticks& axis, double value) {
  const double most = axis.count > 0 ? mostOf(axis) : std::abs(value);
  if (axis.decades || !isPlain(most)) return formatNumber(value, 3);
  const int room = most > 0 ? 3 - static_cast<int>(std::floor(std::log10(most))) : 2;  // four digits of the largest
  return formatFixed(value, std::clamp(axis.decimals + 1, 0, std::max(axis.decimals, room)));
}

double curveTextWidth(const Ticks& axis, double low, double high) {
  const QFont font = Theme::font(TextRole::Small);
  return std::max(textWidth(curveText(axis, low), font), textWidth(curveText(axis, high), font));
}

void ValueAxis::set(std::pair<double, double> extent, int most) {
  std::tie(m_low, m_high) = zoom.value_or(extent);
  m_prefix = unit.isEmpty() ? UnitPrefix{} : prefixFor(std::max(std::abs(m_low), std::abs(m_high)), unit);
  m_ticks =
      logarithmic ? logTicks(onAxis(m_low), onAxis(m_high), most) : niceTicks(onAxis(m_low), onAxis(m_high), most);
}

double ValueAxis::position(double value) const {
  if (!logarithmic) return (value - m_low) / (m_high - m_low);
  if (!(value > 0)) return -1e3;
  return std::log(value / m_low) / std::log(m_high / m_low);
}

double ValueAxis::valueAt(double share) const {
  return logarithmic ? m_low * std::pow(m_high / m_low, share) : m_low + share * (m_high - m_low);
}

void ValueAxis::zoomAbout(double about, double factor) {
  const double low = valueAt(about - about * factor), high = valueAt(about + (1 - about) * factor);
  const double span =
      logarithmic ? std::log(high / low) : (high - low) / std::max({std::abs(low), std::abs(high), 1e-9});
  if (span > 1e-6 && span < 1e9) zoom = {low, high};  // further, digits end
}

void ValueAxis::pan(double share) { zoom = {valueAt(share), valueAt(1 + share)}; }

QString ValueAxis::label(int tick, bool right) const {
  const QString number = tickText(m_ticks, tick);
  return right && tick + 1 == m_ticks.count ? number + QLatin1Char(' ') + mark + shownUnit() : number;
}

double ValueAxis::labelWidth(bool right) const {
  double width = 0;
  for (int i = 0; i < m_ticks.count; ++i)
    width = std::max(width, textWidth(label(i, right), Theme::font(TextRole::Small)));
  return width;
}

void ValueAxis::paint(QPainter& painter, const QRectF& plot, bool right, double offset) const {
  const Theme& theme = Theme::current();
  for (int i = 0; i < m_ticks.count; ++i) {
    const double y = plot.bottom() - plot.height() * position(m_ticks.at(i) * m_prefix.factor);
    if (!right && y > plot.top() + 1 && y < plot.bottom() - 1)
      paintHorizontalLine(painter, plot.left(), plot.right(), y, theme[Token::Line]);
    const QRectF place = right ? QRectF(plot.right() + offset + 7, y - 8, labelWidth(true) + 1, 16)
                               : QRectF(0, y - 8, plot.left() - 7, 16);
    paintText(painter, place, (right ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter, label(i, right),
              Theme::font(TextRole::Small), theme[Token::Muted]);
  }
}

}  // namespace ps
