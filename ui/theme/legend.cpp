// SPDX-License-Identifier: Apache-2.0
#include "ui/theme/legend.h"

#include "core/base/error.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/resources.h"
#include "ui/theme/theme.h"

#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtGui/QLinearGradient>
#include <QtGui/QPainter>
#include <QtGui/QPainterPath>

#include <algorithm>
#include <cmath>
#include <map>

namespace ps {
namespace {

constexpr double kMargin = 10, kTitle = 24, kBarWidth = 12, kBarHeight = 192, kClassRow = 20;
constexpr double kPattern = 18;             // right of a class's letter: how it looks without its colour
constexpr double kDarker = 0.58;            // of sRGB: about 0.3 of the light
constexpr double kFoot = 16;                // room for a pivot that lies outside of the range
constexpr double kMark = 12, kMarkGap = 5;  // right of the bar: the number, and what is said of it
constexpr double kTick = 9;                 // right of the bar: the number of a tick

ColourMap parseMap(const QString& name, const QJsonArray& stops, const QJsonArray& classes) {
  ColourMap map;
  map.name = name;
  for (const QJsonValue& stop : stops) {
    map.stops.emplace_back(stop[0].toDouble(), QColor(stop[1].toString()));
    if (!map.stops.back().second.isValid()) throw Error("maps.json:/maps/" + name.toStdString() + ": not a colour");
  }
  for (const QJsonValue& item : classes) map.classes.emplace_back(item[0].toString(), item[1].toString());
  if (map.stops.size() < 2 || (!map.classes.empty() && map.classes.size() != map.stops.size())) {
    throw Error("maps.json:/maps/" + name.toStdString() + ": must have at least two stops, and one for each class");
  }
  return map;
}

std::map<QString, ColourMap> readMaps() {
  const QJsonObject all = QJsonDocument::fromJson(themeResource(QStringLiteral("theme/maps.json"))).object();
  const QJsonObject stops = all[QStringLiteral("maps")].toObject(), classes = all[QStringLiteral("classes")].toObject(),
                    pivots = all[QStringLiteral("pivots")].toObject(),
                    patterns = all[QStringLiteral("patterns")].toObject();
  std::map<QString, ColourMap> maps;
  for (auto it = stops.begin(); it != stops.end(); ++it) {
    ColourMap map = parseMap(it.key(), it.value().toArray(), classes[it.key()].toArray());
    map.pivot = pivots[it.key()].toDouble(-1);
    for (const QJsonValue& pattern : patterns[it.key()].toArray()) map.patterns << pattern.toString();
    maps[it.key()] = std::move(map);
  }
  return maps;
}

QFont titleFont() {
  QFont font = Theme::font(TextRole::Small);
  font.setWeight(QFont::DemiBold);
  return font;
}

double tickStep(double span, int most) {
  const double raw = span / most, decade = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0}) {
    if (decade * factor >= raw * (1 - 1e-9)) return decade * factor;
  }
  return decade * 10;
}

/// As the view darkens matter of a class, see patternAt() of frame.glsl.
void paintPattern(QPainter& painter, const QRectF& rect, const QString& pattern, const QColor& colour) {
  const QColor dark = QColor::fromRgbF(colour.redF() * kDarker, colour.greenF() * kDarker, colour.blueF() * kDarker);
  const double period = rect.height() / 2;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  QPainterPath inside;
  inside.addRoundedRect(rect, 3, 3);
  painter.setClipPath(inside);
  painter.setPen(Qt::NoPen);
  painter.setBrush(dark);
  for (int i = 0; i < 2 && pattern == QLatin1String("dots"); ++i)
    for (int j = 0; j < 2; ++j)
      painter.drawEllipse(rect.topLeft() + period * QPointF(i + 0.5, j + 0.5), 0.3 * period, 0.3 * period);
  for (int i = 0; i < 4 && pattern == QLatin1String("checks"); ++i)
    for (int j = i % 2; j < 4; j += 2)
      painter.drawRect(QRectF(rect.topLeft() + period / 2 * QPointF(i, j), QSizeF(period / 2, period / 2)));
  painter.setPen(QPen(dark, 0.44 * period / std::sqrt(2.0)));
  for (int i = 1; i < 4 && pattern == QLatin1String("stripes"); ++i)
    painter.drawLine(rect.topLeft() + QPointF(i * period, 0), rect.topLeft() + QPointF(0, i * period));
  painter.restore();
}

void paintClasses(QPainter& painter, const QRectF& rect, const ColourMap& map) {
  const Theme& theme = Theme::current();
  double y = rect.top() + kTitle + 4;
  for (size_t i = 0; i < map.classes.size(); ++i, y += kClassRow) {
    const QRectF swatch(rect.left() + kMargin, y + 2, 16, 16);
    const QColor colour = map.stops[i].second;
    paintBox(painter, swatch, colour, theme[Token::Line2], 3);
    const QColor dark = theme[theme.dark() ? Token::Window : Token::Text];
    const QColor light = theme[theme.dark() ? Token::Text : Token::Panel];
    paintText(painter, swatch, Qt::AlignCenter, map.classes[i].first, Theme::font(TextRole::Small),
              contrast(colour, dark) > contrast(colour, light) ? dark : light);
    double left = swatch.right();
    if (!map.patterns.isEmpty()) {
      const QRectF pattern = swatch.translated(kPattern, 0);
      paintBox(painter, pattern, colour, theme[Token::Line2], 3);
      paintPattern(painter, pattern, map.patterns.value(static_cast<qsizetype>(i)), colour);
      left += kPattern;
    }
    paintText(painter, QRectF(left + 8, y, rect.right() - left - 12, kClassRow), Qt::AlignLeft | Qt::AlignVCenter,
              map.classes[i].second, Theme::font(TextRole::Normal), theme[Token::Text2]);
  }
}

/// Labels already set, as heights; a tick whose text would touch one of them is left out.
class Ladder {
 public:
  bool reserve(double y) {
    for (const double taken : m_taken) {
      if (std::abs(taken - y) < 14) return false;
    }
    m_taken.push_back(y);
    return true;
  }

 private:
  std::vector<double> m_taken;
};

struct Scale {
  const QRectF bar;
  const ColourMap& map;
  std::pair<double, double> range;
  double pivot;
  /// The bar shows the part of the map that the range has: warm colours alone where all is above melting.
  double first() const { return legendPosition(map, range, pivot, range.first); }
  double last() const { return legendPosition(map, range, pivot, range.second); }
  double y(double value) const {
    return bar.bottom() - bar.height() * (legendPosition(map, range, pivot, value) - first()) / (last() - first());
  }
  QLinearGradient gradient() const {
    QLinearGradient shown(bar.bottomLeft(), bar.topLeft());
    shown.setColorAt(0, map.at(first()));
    for (const auto& [position, colour] : map.stops) {
      if (position > first() && position < last()) shown.setColorAt((position - first()) / (last() - first()), colour);
    }
    shown.setColorAt(1, map.at(last()));
    return shown;
  }
  bool inside(double value) const { return value >= range.first && value <= range.second; }
};

/// What the scale cannot show is no information: ice under 1 bar melts at 0.0001 °C.
QString markNumber(double value, double step, double unit) {
  const double grain = step / 1000;
  return formatShort(std::round(value / grain) * grain / unit, 3);
}

constexpr double kLabelStep = 14;  // from one label to the next

/// A mark inside of the range, and where its text goes.
struct PlacedMark {
  const LegendMark* mark;
  double y, text;
};

/// From the top to the bottom. Where one lies near an end its text keeps off that end's label, and off its neighbours';
/// a short line leads there.
std::vector<PlacedMark> placeMarks(const Scale& scale, const std::vector<LegendMark>& marks) {
  std::vector<PlacedMark> placed;
  for (const LegendMark& mark : marks) {
    if (scale.inside(mark.value)) placed.push_back({&mark, scale.y(mark.value), scale.y(mark.value)});
  }
  std::stable_sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.y < b.y; });
  double free = scale.bar.top() + kLabelStep;
  for (PlacedMark& each : placed) {
    each.text = std::max(each.text, free);
    free = each.text + kLabelStep;
  }
  free = scale.bar.bottom() - kLabelStep;
  for (size_t i = placed.size(); i-- > 0;) {
    placed[i].text = std::min(placed[i].text, free);
    free = placed[i].text - kLabelStep;
  }
  return placed;
}

void paintMark(QPainter& painter, const QRectF& rect, const Scale& scale, const PlacedMark& at, const QString& number) {
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Small);
  const double left = scale.bar.right();
  if (std::abs(at.text - at.y) < 1) {
    paintHorizontalLine(painter, left, left + kMark - 5, at.y, theme[Token::Text]);
  } else {
    painter.setPen(QPen(theme[Token::Text], hairline(painter)));
    painter.drawPolyline(QPolygonF{QPointF(left, at.y), QPointF(left + 3, at.y), QPointF(left + kMark - 4, at.text)});
  }
  paintText(painter, QRectF(left + kMark, at.text - 8, rect.right() - left - kMark, 16),
            Qt::AlignLeft | Qt::AlignVCenter, number, font, theme[Token::Text]);
  const double x = left + kMark + textWidth(number, font) + kMarkGap;
  paintText(painter, QRectF(x, at.text - 8, rect.right() - x - 4, 16), Qt::AlignLeft | Qt::AlignVCenter, at.mark->label,
            font, theme[Token::Text2]);
}

void paintTicks(QPainter& painter, const QRectF& rect, const Scale& scale, const LegendText& words,
                const std::vector<LegendMark>& marks) {
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Small);
  Ladder ladder;
  const auto label = [&](double value, const QString& text) {
    const double y = scale.y(value), left = scale.bar.right() + kTick;
    paintHorizontalLine(painter, scale.bar.right(), left - 5, y, theme[Token::Text2]);
    paintText(painter, QRectF(left, y - 8, rect.right() - left, 16), Qt::AlignLeft | Qt::AlignVCenter, text, font,
              theme[Token::Text2]);
  };
  const auto ends = {std::pair{scale.range.second, true}, std::pair{scale.range.first, false}};
  for (const auto& [value, top] : ends) {
    const QString text = top ? formatQuantity(value / words.scale, words.unit, 3) : formatShort(value / words.scale, 3);
    if (ladder.reserve(scale.y(value))) label(value, text);
  }
  const double step = tickStep(scale.range.second - scale.range.first, 6);
  for (const PlacedMark& placed : placeMarks(scale, marks)) {
    ladder.reserve(placed.text);
    paintMark(painter, rect, scale, placed, markNumber(placed.mark->value, step, words.scale));
  }
  for (const LegendMark& mark : marks) {
    if (scale.map.pivot <= 0 || mark.value != scale.pivot || scale.inside(mark.value)) continue;
    const QString arrow = mark.value < scale.range.first ? QStringLiteral("↓ ") : QStringLiteral("↑ ");
    paintText(painter, QRectF(scale.bar.left(), rect.bottom() - kFoot - 2, rect.width() - 2 * kMargin, kFoot),
              Qt::AlignLeft | Qt::AlignVCenter,
              arrow + markNumber(mark.value, step, words.scale) + QLatin1Char(' ') + mark.label, font,
              theme[Token::Text2]);
  }
  for (double value = std::ceil(scale.range.first / step) * step; value < scale.range.second; value += step) {
    if (ladder.reserve(scale.y(value)))
      label(value, formatShort(std::abs(value) < step / 1e6 ? 0 : value / words.scale, 3));
  }
}

}  // namespace

QColor ColourMap::at(double position) const {
  if (!(position > stops.front().first)) return stops.front().second;
  for (size_t i = 1; i < stops.size(); ++i) {
    const auto& [x1, c1] = stops[i];
    if (position > x1) continue;
    const auto& [x0, c0] = stops[i - 1];
    const double t = (position - x0) / (x1 - x0);
    if (!classes.empty()) return t < 0.5 ? c0 : c1;
    const auto mix = [t](float a, float b) { return static_cast<float>(a + (b - a) * t); };
    return QColor::fromRgbF(mix(c0.redF(), c1.redF()), mix(c0.greenF(), c1.greenF()), mix(c0.blueF(), c1.blueF()));
  }
  return stops.back().second;
}

const ColourMap& colourMap(const QString& name) {
  static const std::map<QString, ColourMap> maps = readMaps();
  const auto found = maps.find(name);
  if (found == maps.end()) throw Error("There is no colour map '" + name.toStdString() + "'");
  return found->second;
}

QRectF legendBar(const QRectF& rect, const ColourMap& map) {
  const double foot = map.pivot > 0 ? kFoot : 0;
  return {rect.left() + kMargin, rect.top() + kTitle + 10, kBarWidth, rect.height() - kTitle - 22 - foot};
}

QSizeF legendSize(const ColourMap& map, const LegendText& text, const std::vector<LegendMark>& marks) {
  constexpr double kLeast = 92, kMost = 180;
  const QFont font = Theme::font(TextRole::Small);
  double width = std::max(kLeast, std::ceil(textWidth(text.title, titleFont())) + 2 * kMargin);
  for (const auto& [letter, name] : map.classes)
    width = std::max(width, std::ceil(textWidth(name, Theme::font(TextRole::Normal))) + 36 + kMargin +
                                (map.patterns.isEmpty() ? 0 : kPattern));
  // For the widest number that marks have, so that the legend stays as wide as it is while they move.
  const double number = textWidth(QStringLiteral("−000.0"), font);
  if (map.classes.empty() && !text.unit.isEmpty())
    width = std::max(width,
                     std::ceil(kMargin + kBarWidth + kTick + number + textWidth(QChar(0x202F) + text.unit, font) + 6));
  if (map.classes.empty() && !text.without.isEmpty())
    width = std::max(width, std::ceil(kMargin + kBarWidth + kTick + textWidth(text.without, font) + kMargin));
  for (const LegendMark& mark : marks) {
    width =
        std::max(width, std::ceil(kMargin + kBarWidth + kMark + number + kMarkGap + textWidth(mark.label, font) + 6));
  }
  width = std::min(width, kMost);
  if (!map.classes.empty()) return {width, kTitle + 10 + kClassRow * static_cast<double>(map.classes.size())};
  return {width, kTitle + 8 + kBarHeight + 14 + (map.pivot > 0 ? kFoot : 0)};
}

double legendPosition(const ColourMap& map, std::pair<double, double> range, double pivot, double value) {
  const auto [low, high] = range;
  if (!(high > low)) return 0.5;
  // A pivot that is farther off than the range is long counts as that far: half of a side's colours are left at least.
  const double t = (value - low) / (high - low), p = std::clamp((pivot - low) / (high - low), -1.0, 2.0);
  double position = t;
  if (map.pivot > 0) {
    position = t < p ? map.pivot * t / p : p < 1 ? map.pivot + (1 - map.pivot) * (t - p) / (1 - p) : map.pivot;
  }
  return std::clamp(position, 0.0, 1.0);
}

void paintLegend(QPainter& painter, const QRectF& rect, const ColourMap& map, std::pair<double, double> range,
                 const LegendText& text, const std::vector<LegendMark>& marks, double pivot) {
  const Theme& theme = Theme::current();
  painter.save();
  paintBox(painter, rect, theme[Token::Overlay], theme[Token::Line2], 4);
  paintText(painter, QRectF(rect.left() + kMargin, rect.top() + 4, rect.width() - 2 * kMargin, kTitle - 4),
            Qt::AlignLeft | Qt::AlignVCenter, text.title, titleFont(), theme[Token::Text]);
  if (!map.classes.empty()) {
    paintClasses(painter, rect, map);
    painter.restore();
    return;
  }
  const QRectF bar = legendBar(rect, map);
  const Scale scale{bar, map, range, pivot};
  painter.setRenderHint(QPainter::Antialiasing);
  QPainterPath path;
  path.addRoundedRect(snapped(painter, bar), 2, 2);
  if (range.second > range.first) {
    painter.fillPath(path, scale.gradient());
    paintTicks(painter, rect, scale, text, marks);
  } else {
    // Any of the map's colours would say that something is there.
    painter.fillPath(path, theme[Token::Field]);
    painter.strokePath(path, QPen(theme[Token::Line2], 1));
    paintText(painter, QRectF(bar.right() + kTick, bar.center().y() - 8, rect.right() - bar.right() - kTick, 16),
              Qt::AlignLeft | Qt::AlignVCenter, text.without, Theme::font(TextRole::Small), theme[Token::Text2]);
  }
  painter.restore();
}

}  // namespace ps
