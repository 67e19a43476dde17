// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QRectF>
#include <QtCore/QString>
#include <QtGui/QColor>
#include <QtGui/QFont>

class QPainter;

// What every painter of the interface shares. Lengths are logical pixels; edges are laid on device pixels, so that a
// hairline is one sharp line at 100, 125, 200 and 300 %.
namespace ps {

/// The nearest coordinate on a device pixel's edge.
double snapped(const QPainter& painter, double coordinate);
QRectF snapped(const QPainter& painter, const QRectF& rect);
/// Width of a hairline: one logical pixel, rounded down to whole device pixels, at least one.
double hairline(const QPainter& painter);
void paintHorizontalLine(QPainter& painter, double left, double right, double y, const QColor& colour);
void paintVerticalLine(QPainter& painter, double x, double top, double bottom, const QColor& colour);
/// Rounded box with an edge drawn inside it. An invalid colour draws nothing.
void paintBox(QPainter& painter, const QRectF& rect, const QColor& fill, const QColor& edge, double radius,
              double edgeWidth = 1);
/// The ring of keyboard focus: 2 px in accent.
void paintFocusRing(QPainter& painter, const QRectF& rect, double radius);
/// One line of text, elided where it does not fit; alignment is of Qt::Alignment.
void paintText(QPainter& painter, const QRectF& rect, int alignment, const QString& text, const QFont& font,
               const QColor& colour);
double textWidth(const QString& text, const QFont& font);
/// A formula symbol like "k_s": italic, what follows "_" lowered and smaller.
void paintSymbol(QPainter& painter, const QRectF& rect, const QString& symbol, const QColor& colour);
double symbolWidth(const QString& symbol);  ///< logical pixels of it
/// The switch of a toggle.
void paintSwitch(QPainter& painter, const QRectF& rect, bool on, bool enabled);
/// A key over time; `half` its width, logical pixels.
void paintDiamond(QPainter& painter, const QPointF& centre, double half, const QColor& colour, bool filled);
/// A ball lit from above left, as a material looks.
void paintBall(QPainter& painter, const QRectF& rect, const QColor& colour);

}  // namespace ps
