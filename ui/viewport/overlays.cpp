// SPDX-License-Identifier: Apache-2.0
#include "ui/viewport/overlays.h"

#include "core/sketch/stampform.h"
#include "ui/theme/legend.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"
#include "ui/theme/units.h"
#include "ui/tools/brushsettings.h"

#include <QtCore/QStringList>
#include <QtGui/QPainter>
#include <QtGui/QPainterPath>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kMargin = 10, kPadding = 8, kLine = 22;
// px: of the bar of a legend that may be lacking, so that 100 are left; and above it that it leaves free.
constexpr double kShorter = 92, kAboveLegend = 100;

void paintGround(QPainter& painter, const QRectF& rect, double radius = 4) {
  const Theme& theme = Theme::current();
  paintBox(painter, rect, theme[Token::Overlay], theme[Token::Line], radius);
}

void paintViewLabel(QPainter& painter, const OverlayState& state) {
  const QFont font = Theme::font(TextRole::Normal);
  const QRectF rect(kMargin, state.top + kMargin, textWidth(state.viewName, font) + 2 * kPadding, kLine);
  paintGround(painter, rect);
  paintText(painter, rect, Qt::AlignCenter, state.viewName, font, Theme::current()[Token::Text]);
}

/// A round length near 90 pixels at the target's depth.
void paintScaleBar(QPainter& painter, const OverlayState& state) {
  const double metresPerPixel = pixelSize(state.camera, static_cast<int>(state.size.height()), state.camera.distance);
  const double wanted = 90 * metresPerPixel;
  double length = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double factor : {5.0, 2.0}) {
    if (length * factor <= wanted) {
      length *= factor;
      break;
    }
  }
  const double pixels = length / metresPerPixel;
  const QString text = lengthText(length);
  const QFont font = Theme::font(TextRole::Normal);
  const QRectF rect(kMargin, state.size.height() - kMargin - 26, pixels + textWidth(text, font) + 3.5 * kPadding, 26);
  paintGround(painter, rect);
  const double left = rect.left() + kPadding, right = left + pixels, y = rect.center().y() + 3;
  const QColor colour = Theme::current()[Token::Text2];
  paintHorizontalLine(painter, left, right, y, colour);
  for (const double x : {left, (left + right) / 2, right}) {
    paintVerticalLine(painter, x, y - (x > left && x < right ? 3 : 6), y, colour);
  }
  paintText(painter, QRectF(right + kPadding, rect.top(), rect.right() - right, rect.height()),
            Qt::AlignLeft | Qt::AlignVCenter, text, font, Theme::current()[Token::Text]);
}

/// Range and text of a legend, as people read the field: temperatures as people prefer them, shares in %, else with the
/// prefix of its unit that keeps numbers short.
LegendText legendText(const ParticleField& field, std::pair<double, double>& range) {
  LegendText text{QString::fromStdString(field.label), QString::fromStdString(field.unit)};
  const double largest = std::max(std::abs(range.first), std::abs(range.second));
  if (field.unit == "K") {
    text.unit = temperatureSymbol();
    if (largest > 0) range = {shownTemperature(range.first), shownTemperature(range.second)};
  } else if (field.unit == "1") {
    const bool share = field.hasScale() && field.minimum >= -1 && field.maximum <= 1;
    text.unit = share ? QStringLiteral("%") : QString();
    if (share) text.scale = 0.01;
  } else if (largest >= 1000 || largest < 0.01) {
    const UnitPrefix prefix = prefixFor(largest, text.unit);
    text.scale = prefix.factor;
    text.unit.prepend(prefix.symbol);
  }
  return text;
}

void paintLegendOver(QPainter& painter, const OverlayState& state, OverlayHits& hits) {
  if (!state.shown.legend || !state.field || state.empty) return;
  ColourMap map = colourMap(QString::fromStdString(colourMapOf(state.field->name)));
  if (!state.classes.empty()) {
    map.classes = state.classes;
    map.classes.resize(std::min(map.classes.size(), map.stops.size()));
    map.stops.resize(map.classes.size());
  }
  std::pair<double, double> range = state.range;
  LegendText text = legendText(*state.field, range);
  if (!(range.second > range.first)) text.without = state.without;
  std::vector<LegendMark> marks;
  double pivot = 0;
  if (state.field->name == "temperature") {
    pivot = shownTemperature(state.meltingPoint);
    if (state.meltingPoint > 0) marks.push_back({pivot, QStringLiteral("melts")});
    if (std::isfinite(state.boilingPoint))
      marks.push_back({shownTemperature(state.boilingPoint), QStringLiteral("boils")});
  }
  QSizeF size = legendSize(map, text, marks);
  // In a low view its bar is shorter.
  const double room = state.size.height() - kMargin - kAboveLegend;
  if (map.classes.empty()) size.setHeight(std::max(size.height() - kShorter, std::min(size.height(), room)));
  const QRectF rect(state.size.width() - kMargin - size.width(), state.size.height() - kMargin - size.height(),
                    size.width(), size.height());
  if (rect.top() < kAboveLegend) return;  // too little room
  hits.legend = rect;
  hits.legendTitle = text.title;
  hits.legendClasses = static_cast<int>(map.classes.size());
  hits.legendUnit = text.unit;
  hits.legendWithout = map.classes.empty() ? text.without : QString();
  if (map.classes.empty()) hits.legendBar = legendBar(rect, map);
  paintLegend(painter, rect, map, range, text, marks, pivot);
}

QRectF paintHint(QPainter& painter, const OverlayState& state) {
  const QFont font = Theme::font(TextRole::Small);
  const Theme& theme = Theme::current();
  const QString close = QStringLiteral("Got it");
  constexpr double kScale = 180, kLegend = 130;  // room for scale bar and legend first
  const double room = state.size.width() - 2 * std::max(kScale, kLegend);
  double width = textWidth(close, font) + 2 * kPadding;
  std::vector<OverlayHint> hints;  // those that there is room for
  for (const OverlayHint& hint : state.hints) {
    const double more = textWidth(hint.keys, font) + textWidth(hint.does, font) + 12 + 2 * kPadding;
    if (width + more > room) break;
    width += more;
    hints.push_back(hint);
  }
  if (hints.empty()) return {};
  const QRectF rect((state.size.width() - width) / 2, state.size.height() - kMargin - 30, width, 30);
  paintGround(painter, rect, 6);
  double x = rect.left() + kPadding;
  for (const OverlayHint& hint : hints) {
    const QRectF key(x, rect.top() + 6, textWidth(hint.keys, font) + 10, 18);
    paintBox(painter, key, theme[Token::Raised], theme[Token::Line2], 3);
    paintText(painter, key, Qt::AlignCenter, hint.keys, font, theme[Token::Text]);
    x = key.right() + 5;
    const double w = textWidth(hint.does, font);
    paintText(painter, QRectF(x, rect.top(), w + 2, rect.height()), Qt::AlignLeft | Qt::AlignVCenter, hint.does, font,
              theme[Token::Text2]);
    x += w + 2 * kPadding - 3;
  }
  const QRectF button(x - kPadding / 2, rect.top() + 4, textWidth(close, font) + kPadding, rect.height() - 8);
  paintText(painter, button, Qt::AlignCenter, close, font, theme[Token::Text2]);
  return button;
}

void paintBall(QPainter& painter, const OverlayState& state, OverlayHits& hits) {
  constexpr double kRadius = 33, kArm = 23, kDot = 7.5;
  const QPointF centre(state.size.width() - kMargin - kRadius, state.top + kMargin + kRadius);
  const Theme& theme = Theme::current();
  painter.setPen(QPen(theme[Token::Line], 1));
  painter.setBrush(theme[Token::Overlay]);
  painter.drawEllipse(centre, kRadius, kRadius);
  const CameraFrame frame = frameOf(state.camera);
  struct End {
    const char* letter;
    Token colour;
    Vector3 axis;
    double azimuth, elevation;
  };
  const End ends[] = {{"X", Token::AxisX, {1, 0, 0}, 90, 0}, {"", Token::AxisX, {-1, 0, 0}, -90, 0},
                      {"Y", Token::AxisY, {0, 1, 0}, 0, 90}, {"", Token::AxisY, {0, -1, 0}, 0, -90},
                      {"Z", Token::AxisZ, {0, 0, 1}, 0, 0},  {"", Token::AxisZ, {0, 0, -1}, 180, 0}};
  std::vector<const End*> order;
  for (const End& end : ends) order.push_back(&end);
  std::stable_sort(order.begin(), order.end(),
                   [&](const End* a, const End* b) { return a->axis.dot(frame.forward) > b->axis.dot(frame.forward); });
  for (const End* end : order) {
    const QPointF at = centre + QPointF(end->axis.dot(frame.right), -end->axis.dot(frame.up)) * kArm;
    const bool named = end->letter[0] != 0;
    QColor colour = theme[end->colour];
    if (!named) colour.setAlphaF(0.45F);
    if (named) {
      painter.setPen(QPen(colour, 1.5));
      painter.drawLine(centre, at);
    }
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    const double r = named ? kDot : kDot - 2;
    painter.drawEllipse(at, r, r);
    const QRectF rect(at.x() - kDot - 2, at.y() - kDot - 2, 2 * kDot + 4, 2 * kDot + 4);
    if (named)
      paintText(painter, rect, Qt::AlignCenter, QLatin1String(end->letter), Theme::font(TextRole::Small),
                theme[Token::Window]);
    hits.axes.push_back({rect, end->azimuth, end->elevation});
  }
  std::reverse(hits.axes.begin(), hits.axes.end());  // nearest first
}

void paintTag(QPainter& painter, const OverlayState& state, const SceneTag& tag) {
  const auto at =
      project(state.camera, static_cast<int>(state.size.width()), static_cast<int>(state.size.height()), tag.place);
  if (!at) return;
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Normal);
  const double name = textWidth(tag.name, font), value = textWidth(tag.value, font);
  const QPointF point((*at)[0], (*at)[1]);
  painter.setPen(QPen(theme[Token::Window], 3));
  painter.setBrush(Qt::NoBrush);
  painter.drawEllipse(point, 5, 5);
  painter.setPen(QPen(theme[Token::Accent], 1.5));
  painter.drawEllipse(point, 5, 5);
  QRectF rect(point.x() + 12, point.y() - kLine / 2, name + value + 3 * kPadding, kLine);
  if (rect.right() > state.size.width() - kMargin) rect.moveRight(point.x() - 12);
  paintGround(painter, rect);
  paintText(painter, rect.adjusted(kPadding, 0, 0, 0), Qt::AlignLeft | Qt::AlignVCenter, tag.name, font,
            theme[Token::Text2]);
  paintText(painter, rect.adjusted(0, 0, -kPadding, 0), Qt::AlignRight | Qt::AlignVCenter, tag.value, font,
            theme[Token::Text]);
}

void paintInvitation(QPainter& painter, const OverlayState& state) {
  const QFont font = Theme::font(TextRole::Normal);
  QRectF rect(0, 0, textWidth(state.invitation, font) + 4 * kPadding, kLine + 2 * kPadding);
  rect.moveCenter(QPointF(state.size.width() / 2, state.size.height() / 2));
  paintGround(painter, rect);
  paintText(painter, rect, Qt::AlignCenter, state.invitation, font, Theme::current()[Token::Text2]);
}

class CursorPainter {
 public:
  CursorPainter(QPainter& painter, const OverlayState& state) : m_painter(painter), m_state(state) {}

  void paint(const BrushCursor& cursor) {
    const Theme& theme = Theme::current();
    const QColor colour = theme[cursor.erase ? Token::Error : Token::Accent];
    const auto centre = at(cursor.centre);
    if (!centre) return;
    ring(cursor, colour);
    QPainterPath shape, body;
    if (cursor.form) {
      form(cursor, shape, body);
    } else if (cursor.box) {
      box(cursor, shape);
    } else {
      sphere(cursor, *centre, shape);
    }
    QColor fill = colour;
    fill.setAlphaF(0.16F);
    if (cursor.form || !cursor.box) m_painter.fillPath(cursor.form ? body : shape, fill);
    stroke(shape, colour);
    for (const QPointF& arm : {QPointF(6, 0), QPointF(0, 6)}) {
      m_painter.setPen(QPen(theme[Token::Text], 1));
      m_painter.drawLine(*centre - arm, *centre + arm);
    }
    tag(cursor, shape.boundingRect());
  }

 private:
  std::optional<QPointF> at(const Vector3& p) const {
    const auto pixel =
        project(m_state.camera, static_cast<int>(m_state.size.width()), static_cast<int>(m_state.size.height()), p);
    return pixel ? std::optional(QPointF((*pixel)[0], (*pixel)[1])) : std::nullopt;
  }
  void stroke(const QPainterPath& path, const QColor& colour) {
    m_painter.setBrush(Qt::NoBrush);
    m_painter.setPen(QPen(Theme::current()[Token::Shadow], 3.5));
    m_painter.drawPath(path);
    m_painter.setPen(QPen(colour, 1.5));
    m_painter.drawPath(path);
  }
  void sphere(const BrushCursor& cursor, const QPointF& centre, QPainterPath& path) const {
    const CameraFrame frame = frameOf(m_state.camera);
    const double depth = (cursor.centre - frame.eye).dot(frame.forward);
    const double r =
        cursor.extent.maxCoeff() / pixelSize(m_state.camera, static_cast<int>(m_state.size.height()), depth);
    path.addEllipse(centre, r, r);
  }
  /// Its outline, and what is seen of its surface: all of that is turned the same way, so that it fills as one.
  void form(const BrushCursor& cursor, QPainterPath& outline, QPainterPath& body) const {
    const Vector3 eye = frameOf(m_state.camera).eye - cursor.centre;
    for (const auto& [from, to] : cursor.form->outline(eye)) {
      const auto a = at(cursor.centre + from), b = at(cursor.centre + to);
      if (!a || !b) continue;
      outline.moveTo(*a);
      outline.lineTo(*b);
    }
    body.setFillRule(Qt::WindingFill);
    for (const StampForm::Face& face : cursor.form->faces) {
      if (!cursor.form->isSeen(face, eye)) continue;
      QPolygonF around;
      for (const Vector3& corner : cursor.form->corners(face))
        if (const auto pixel = at(cursor.centre + corner)) around << *pixel;
      if (around.size() < 4) continue;
      body.addPolygon(around);
      body.closeSubpath();
    }
  }
  void box(const BrushCursor& cursor, QPainterPath& path) const {
    const auto corner = [&](int k) {
      Vector3 p = cursor.centre;
      for (size_t i = 0; i < 3; ++i) p[i] += (k >> i & 1 ? 1 : -1) * cursor.extent[i];
      return at(p);
    };
    for (int k = 0; k < 8; ++k) {
      for (int bit = 1; bit < 8; bit *= 2) {
        const auto a = corner(k), b = corner(k | bit);
        if ((k & bit) || !a || !b) continue;
        path.moveTo(*a);
        path.lineTo(*b);
      }
    }
  }
  /// Plumb line and the outline on what lies below.
  void ring(const BrushCursor& cursor, const QColor& colour) {
    Vector3 foot = cursor.centre;
    foot[1] = cursor.floor;
    if (cursor.centre[1] - cursor.extent[1] < cursor.floor + 1e-4) return;
    QPolygonF outline;
    constexpr int kPoints = 48;
    for (int k = 0; k <= kPoints; ++k) {
      const double angle = 2 * 3.14159265358979 * k / kPoints;
      const auto p =
          at({foot[0] + cursor.extent[0] * std::cos(angle), foot[1], foot[2] + cursor.extent[2] * std::sin(angle)});
      if (p) outline << *p;
    }
    m_painter.setBrush(Qt::NoBrush);
    m_painter.setPen(QPen(colour, 1, Qt::DotLine));
    const auto a = at(cursor.centre), b = at(foot);
    if (a && b) m_painter.drawLine(*a, *b);
    m_painter.setPen(QPen(colour, 1));
    m_painter.drawPolyline(outline);
  }
  void tag(const BrushCursor& cursor, const QRectF& bounds) {
    QString text = QStringLiteral("r %1   height %2")
                       .arg(lengthText(cursor.extent[0]), lengthText(std::max(0.0, cursor.centre[1] - cursor.floor)));
    // A mouse always presses fully: that is no news.
    if (cursor.pressure < 1) text += QStringLiteral("   pressure %1 %").arg(formatFixed(100 * cursor.pressure, 0));
    const QFont font = Theme::font(TextRole::Small);
    QRectF rect(bounds.right() + 8, bounds.top(), textWidth(text, font) + 2 * kPadding, 20);
    // Whole, also beside what reaches out of the view.
    rect.moveRight(std::min(rect.right(), m_state.size.width() - kMargin));
    rect.moveTop(
        std::max(m_state.top + kMargin, std::min(rect.top(), m_state.size.height() - kMargin - rect.height())));
    paintGround(m_painter, rect);
    paintText(m_painter, rect, Qt::AlignCenter, text, font, Theme::current()[Token::Text]);
  }

  QPainter& m_painter;
  const OverlayState& m_state;
};

}  // namespace

void paintMessage(QPainter& painter, const QSizeF& size, const QString& title, const QString& text) {
  const Theme& theme = Theme::current();
  const double width = std::min(520.0, size.width() - 40);
  QRectF box(0, 0, width, 96);
  box.moveCenter(QPointF(size.width() / 2, size.height() / 2));
  paintText(painter, QRectF(box.left(), box.top(), box.width(), 24), Qt::AlignCenter, title,
            Theme::font(TextRole::Heading), theme[Token::Text]);
  painter.setFont(Theme::font(TextRole::Normal));
  painter.setPen(theme[Token::Text2]);
  painter.drawText(QRectF(box.left(), box.top() + 30, box.width(), 66),
                   Qt::AlignHCenter | Qt::AlignTop | Qt::TextWordWrap, text);
}

OverlayHits paintOverlays(QPainter& painter, const OverlayState& state) {
  painter.setRenderHint(QPainter::Antialiasing);
  OverlayHits hits;
  if (state.cursor) CursorPainter(painter, state).paint(*state.cursor);
  if (state.tag) paintTag(painter, state, *state.tag);
  if (state.shown.name) paintViewLabel(painter, state);
  if (state.section)
    hits.section = paintSection(painter, *state.section, {kMargin, state.top + kMargin + kLine + kPadding / 2});
  if (state.shown.scale) paintScaleBar(painter, state);
  paintLegendOver(painter, state, hits);
  if (!state.hints.empty()) hits.hintClose = paintHint(painter, state);
  if (state.shown.axes) paintBall(painter, state, hits);
  if (!state.invitation.isEmpty()) paintInvitation(painter, state);
  return hits;
}

}  // namespace ps
