// SPDX-License-Identifier: Apache-2.0
#include "ui/viewport/wirepainter.h"

#include "ui/theme/theme.h"

#include <QtGui/QPainter>
#include <QtGui/QPainterPath>

namespace ps {
namespace {

/// What lies behind the viewer is left out.
QPainterPath pathOf(const Wire& wire, const Camera& camera, const QSizeF& size) {
  const CameraFrame frame = frameOf(camera);
  const double near = nearPlane(camera);
  const auto depth = [&](const Vector3& p) { return (p - frame.eye).dot(frame.forward); };
  const auto at = [&](const Vector3& p) {
    const auto pixel = project(camera, static_cast<int>(size.width()), static_cast<int>(size.height()), p);
    return pixel ? std::optional(QPointF((*pixel)[0], (*pixel)[1])) : std::nullopt;
  };
  QPainterPath path;
  for (const auto& [from, to] : wire.lines) {
    const double a = depth(from), b = depth(to), least = 1.01 * near;
    if (a < least && b < least) continue;
    const Vector3 cut = from + (least - a) / (b - a) * (to - from);
    const auto begin = at(a < least ? cut : from), end = at(b < least ? cut : to);
    if (!begin || !end) continue;
    path.moveTo(*begin);
    path.lineTo(*end);
  }
  return path;
}

}  // namespace

void paintWires(QPainter& painter, const std::vector<Wire>& wires, const Camera& camera, const QSizeF& size) {
  const Theme& theme = Theme::current();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  for (const Wire& wire : wires) {
    const QPainterPath path = pathOf(wire, camera, size);
    painter.setPen(QPen(theme[Token::Shadow], 3.5));
    painter.drawPath(path);
    const QColor colour = theme[wire.selected ? Token::Accent : wire.hovered ? Token::Text : Token::Text2];
    painter.setPen(QPen(colour, wire.selected || wire.hovered ? 2 : 1.5, wire.dashed ? Qt::DashLine : Qt::SolidLine));
    painter.drawPath(path);
  }
}

void paintPins(QPainter& painter, const std::vector<Vector3>& places, const Camera& camera, const QSizeF& size) {
  constexpr double kMark = 2.5;   // px, radius
  constexpr size_t kMost = 1000;  // marks; of more places every so many have one
  const size_t step = 1 + places.size() / kMost;
  const Theme& theme = Theme::current();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(theme[Token::Shadow], 1.5));
  painter.setBrush(theme[Token::Accent]);
  for (size_t i = 0; i < places.size(); i += step) {
    const auto pixel = project(camera, static_cast<int>(size.width()), static_cast<int>(size.height()), places[i]);
    if (pixel) painter.drawEllipse(QPointF((*pixel)[0], (*pixel)[1]), kMark, kMark);
  }
}

}  // namespace ps
