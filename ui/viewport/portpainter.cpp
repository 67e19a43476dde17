// SPDX-License-Identifier: Apache-2.0
#include "ui/viewport/portpainter.h"

#include "ui/theme/theme.h"

#include <QtGui/QPainter>
#include <QtGui/QPainterPath>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kKnob = 4;  // pixels, radius of the mark on a tip or corner
constexpr double kHead = 9;  // pixels, of an arrow

bool works(const Emitter& emitter) { return numberOf(emitter.parameters, emitterParameters(), "speed") > 0; }
bool works(const Sink& sink) { return toggleOf(sink.parameters, sinkParameters(), "open"); }

class Projector {
 public:
  explicit Projector(const PortView& view) : m_view(view) {}

  std::optional<QPointF> at(const Vector3& p) const {
    const auto pixel =
        project(m_view.camera, static_cast<int>(m_view.size.width()), static_cast<int>(m_view.size.height()), p);
    return pixel ? std::optional(QPointF((*pixel)[0], (*pixel)[1])) : std::nullopt;
  }
  QPainterPath wires(const PortShape& shape) const {
    QPainterPath path;
    const auto line = [&](const std::optional<QPointF>& a, const std::optional<QPointF>& b) {
      if (!a || !b) return;
      path.moveTo(*a);
      path.lineTo(*b);
    };
    for (const auto& [from, to] : shape.lines) line(at(from), at(to));
    if (!shape.jet) return path;
    const auto a = at(shape.jet->first), b = at(shape.jet->second);
    const QPointF way = a && b ? *b - *a : QPointF();
    const double length = std::hypot(way.x(), way.y());
    if (length < kHead - 1) return path;  // seen along the jet
    const QPointF back = way * (kHead / length), across(back.y() * 0.5, -back.x() * 0.5);
    line(b, *b - back + across);
    line(b, *b - back - across);
    return path;
  }
  QPolygonF face(const PortShape& shape) const {
    QPolygonF polygon;
    for (const Vector3& p : shape.face) {
      if (const auto pixel = at(p)) polygon << *pixel;
    }
    return polygon;
  }

 private:
  const PortView& m_view;
};

}  // namespace

double leastJet(const Camera& camera, double height, const Vector3& place) {
  const CameraFrame frame = frameOf(camera);
  const double depth = std::max(nearPlane(camera), (place - frame.eye).dot(frame.forward));
  return kLeastJet * pixelSize(camera, static_cast<int>(height), depth);
}

void paintPorts(QPainter& painter, const PortView& view) {
  const Theme& theme = Theme::current();
  forPorts(view.ports, false, [&](const Port& port, const auto& item) {
    const bool marked = view.ports.selected == port, warm = view.hovered == port;
    const QColor colour = theme[marked        ? Token::Accent
                                : warm        ? Token::Text
                                : works(item) ? Token::Text2
                                              : Token::Muted];
    const double least = leastJet(view.camera, view.size.height(), anchorOf(item));
    const PortShape shape = shapeOf(item, least);
    const Projector projector(view);
    const QPainterPath path = projector.wires(shape);
    QColor fill = colour;
    fill.setAlphaF(0.18F);
    painter.setPen(Qt::NoPen);
    painter.setBrush(fill);
    painter.drawPolygon(projector.face(shape));
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(theme[Token::Shadow], 3.5));
    painter.drawPath(path);
    painter.setPen(QPen(colour, marked || warm ? 2 : 1.5, works(item) ? Qt::SolidLine : Qt::DashLine));
    painter.drawPath(path);
    if (!marked || item.locked) return;
    painter.setPen(QPen(theme[Token::Shadow], 1.5));
    painter.setBrush(colour);
    for (const PortHandle& knob : knobsOf(port, item, least)) {
      if (const auto p = projector.at(knob.place)) painter.drawEllipse(*p, kKnob, kKnob);
    }
  });
}

}  // namespace ps
