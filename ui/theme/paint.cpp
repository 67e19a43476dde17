// SPDX-License-Identifier: Apache-2.0
#include "ui/theme/paint.h"

#include "ui/theme/theme.h"

#include <QtGui/QFontMetricsF>
#include <QtGui/QPainter>
#include <QtGui/QRadialGradient>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

double scaleOf(const QPainter& painter) { return painter.device() ? painter.device()->devicePixelRatioF() : 1; }

}  // namespace

double snapped(const QPainter& painter, double coordinate) {
  const double scale = scaleOf(painter);
  return std::round(coordinate * scale) / scale;
}

QRectF snapped(const QPainter& painter, const QRectF& rect) {
  return QRectF(QPointF(snapped(painter, rect.left()), snapped(painter, rect.top())),
                QPointF(snapped(painter, rect.right()), snapped(painter, rect.bottom())));
}

double hairline(const QPainter& painter) {
  const double scale = scaleOf(painter);
  return std::max(1.0, std::floor(scale)) / scale;
}

void paintHorizontalLine(QPainter& painter, double left, double right, double y, const QColor& colour) {
  const double top = snapped(painter, y);
  painter.fillRect(
      QRectF(snapped(painter, left), top, snapped(painter, right) - snapped(painter, left), hairline(painter)), colour);
}

void paintVerticalLine(QPainter& painter, double x, double top, double bottom, const QColor& colour) {
  const double left = snapped(painter, x);
  painter.fillRect(
      QRectF(left, snapped(painter, top), hairline(painter), snapped(painter, bottom) - snapped(painter, top)), colour);
}

void paintBox(QPainter& painter, const QRectF& rect, const QColor& fill, const QColor& edge, double radius,
              double edgeWidth) {
  const QRectF outer = snapped(painter, rect);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  if (edge.isValid()) {
    const double width = edgeWidth * hairline(painter);
    painter.setPen(QPen(edge, width));
    painter.setBrush(fill.isValid() ? QBrush(fill) : QBrush(Qt::NoBrush));
    const double half = width / 2;
    painter.drawRoundedRect(outer.adjusted(half, half, -half, -half), radius - half, radius - half);
  } else {
    painter.setPen(Qt::NoPen);
    painter.setBrush(fill);
    painter.drawRoundedRect(outer, radius, radius);
  }
  painter.restore();
}

void paintFocusRing(QPainter& painter, const QRectF& rect, double radius) {
  paintBox(painter, rect, QColor(), Theme::current()[Token::Accent], radius, 2);
}

void paintText(QPainter& painter, const QRectF& rect, int alignment, const QString& text, const QFont& font,
               const QColor& colour) {
  if (text.isEmpty() || rect.width() <= 0) return;
  painter.setFont(font);
  painter.setPen(colour);
  const QFontMetricsF metrics(font);
  const bool fits = metrics.horizontalAdvance(text) <= rect.width() + 0.5;
  const QString shown = fits ? text : metrics.elidedText(text, Qt::ElideRight, rect.width());
  // The baseline lies on a device pixel, so that lines of text beside one another stand level.
  const double x = alignment & Qt::AlignRight     ? rect.right() - metrics.horizontalAdvance(shown)
                   : alignment & Qt::AlignHCenter ? rect.center().x() - metrics.horizontalAdvance(shown) / 2
                                                  : rect.left();
  const double y = alignment & Qt::AlignTop      ? rect.top() + metrics.ascent()
                   : alignment & Qt::AlignBottom ? rect.bottom() - metrics.descent()
                                                 : rect.center().y() + metrics.capHeight() / 2;
  painter.drawText(QPointF(snapped(painter, x), snapped(painter, y)), shown);
}

double textWidth(const QString& text, const QFont& font) { return QFontMetricsF(font).horizontalAdvance(text); }

double symbolWidth(const QString& symbol) {
  const QFont font = Theme::font(TextRole::Symbol);
  QFont small = font;
  small.setPixelSize(font.pixelSize() - 3);
  const qsizetype underscore = symbol.indexOf(QLatin1Char('_'));
  if (underscore < 0) return textWidth(symbol, font);
  return textWidth(symbol.left(underscore), font) + 0.5 + textWidth(symbol.mid(underscore + 1), small);
}

void paintSymbol(QPainter& painter, const QRectF& rect, const QString& symbol, const QColor& colour) {
  const QFont font = Theme::font(TextRole::Symbol);
  const qsizetype underscore = symbol.indexOf(QLatin1Char('_'));
  const QString base = underscore < 0 ? symbol : symbol.left(underscore);
  painter.setFont(font);
  painter.setPen(colour);
  const QFontMetricsF metrics(font);
  const double baseline = snapped(painter, rect.center().y() + metrics.capHeight() / 2);
  painter.drawText(QPointF(rect.left(), baseline), base);
  if (underscore < 0) return;
  QFont small = font;
  small.setPixelSize(font.pixelSize() - 3);
  painter.setFont(small);
  painter.drawText(QPointF(rect.left() + metrics.horizontalAdvance(base) + 0.5, baseline + 3),
                   symbol.mid(underscore + 1));
}

void paintSwitch(QPainter& painter, const QRectF& rect, bool on, bool enabled) {
  const Theme& theme = Theme::current();
  const QColor track = !enabled ? theme[Token::Line2] : on ? theme[Token::Accent] : theme[Token::ControlEdge];
  paintBox(painter, rect, track, QColor(), rect.height() / 2);
  const double radius = rect.height() / 2 - 2;
  const double x = on ? rect.right() - radius - 2 : rect.left() + radius + 2;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(!enabled ? theme[Token::Disabled] : on ? theme[Token::OnAccent] : theme[Token::Panel]);
  painter.drawEllipse(QPointF(x, rect.center().y()), radius, radius);
  painter.restore();
}

void paintDiamond(QPainter& painter, const QPointF& centre, double half, const QColor& colour, bool filled) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(colour, 1.35, Qt::SolidLine, Qt::RoundCap, Qt::MiterJoin));
  painter.setBrush(filled ? QBrush(colour) : QBrush(Qt::NoBrush));
  const QPointF corners[] = {centre + QPointF(0, -half), centre + QPointF(half, 0), centre + QPointF(0, half),
                             centre + QPointF(-half, 0)};
  painter.drawPolygon(corners, 4);
  painter.restore();
}

void paintBall(QPainter& painter, const QRectF& rect, const QColor& colour) {
  QRadialGradient light(rect.center() - QPointF(0.18 * rect.width(), 0.22 * rect.height()), 0.72 * rect.width());
  light.setColorAt(0, colour.lighter(125));
  light.setColorAt(0.45, colour);
  light.setColorAt(1, colour.darker(210));
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(light);
  painter.drawEllipse(rect);
  painter.restore();
}

}  // namespace ps
