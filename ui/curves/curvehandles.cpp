// SPDX-License-Identifier: Apache-2.0
// Handles of the selected point: where they are, and what a drag of one states.
#include "core/math/responseedit.h"
#include "ui/curves/curveview.h"
#include "ui/theme/numbers.h"
#include "ui/theme/reach.h"
#include "ui/theme/theme.h"

#include <QtGui/QMouseEvent>
#include <QtGui/QPainter>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kHandle = 46, kGrip = 8, kSquare = 3.5;  // px from the point, around a handle, half of its side

double squareOf(const QPointF& way) { return QPointF::dotProduct(way, way); }

}  // namespace

/// Of the axis' level over the value; 0 where a logarithmic axis shows nothing.
double CurveView::levelSlope(double value) const {
  const api::ParameterDeclaration& declaration = m_target.declaration();
  if (!logarithmic()) return displayFactor(declaration);
  const double shown = toDisplay(declaration, value);
  return shown > 0 ? displayFactor(declaration) / (shown * std::log(10.0)) : 0;
}

std::optional<QPointF> CurveView::handleAt(bool after) const {
  const auto index = static_cast<size_t>(m_target.point());
  if (m_target.point() < 0 || !hasSlope(m_shown, index, after)) return std::nullopt;
  const CurvePoint& p = m_shown.points[index];
  const double slope = after ? slopeAfter(m_shown.points, index) : slopeBefore(m_shown.points, index);
  const double perPixel = (m_last - m_first) / plot().width(), levels = (m_high - m_low) / plot().height();
  const double rise = slope * levelSlope(p.y) * perPixel / levels;  // px up for one to the right
  const QPointF way = QPointF(1, -rise) * (kHandle / std::hypot(1, rise));
  return at(p.x, p.y) + (after ? way : -way);
}

CurveView::Grip CurveView::gripAt(const QMouseEvent& event) const {
  const double reach = reachOf(event, kGrip);
  for (const bool after : {false, true}) {
    const auto handle = handleAt(after);
    if (handle && squareOf(*handle - event.position()) <= reach * reach) return after ? Grip::After : Grip::Before;
  }
  return pointAt(event) >= 0 ? Grip::Point : Grip::None;
}

/// A handle points from its point to the pointer, and never back over it.
void CurveView::turnTo(const QPointF& position, bool oneSide) {
  const auto index = static_cast<size_t>(m_target.point());
  const bool after = m_grip == Grip::After;
  const CurvePoint& p = m_before.points[index];
  const double scale = levelSlope(p.y);
  if (scale == 0) return;
  const QPointF way = (position - at(p.x, p.y)) * (after ? 1 : -1);
  const double rise = -way.y() / std::max(1.0, way.x());
  const double perPixel = (m_last - m_first) / plot().width(), levels = (m_high - m_low) / plot().height();
  Response next = m_before;
  stateSlope(next, index, rise * levels / perPixel / scale,
             !oneSide ? Sides::Both
             : after  ? Sides::After
                      : Sides::Before);
  m_target.set(next);
}

void CurveView::paintHandles(QPainter& painter) const {
  const Theme& theme = Theme::current();
  for (const bool after : {false, true}) {
    const auto handle = handleAt(after);
    if (!handle) continue;
    const CurvePoint& p = m_shown.points[static_cast<size_t>(m_target.point())];
    painter.setPen(QPen(theme[Token::Text2], 1.2));
    painter.drawLine(at(p.x, p.y), *handle);
    painter.setBrush(theme[Token::Field]);
    painter.drawRect(QRectF(handle->x() - kSquare, handle->y() - kSquare, 2 * kSquare, 2 * kSquare));
  }
}

}  // namespace ps
