// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/porthandles.h"

#include "ui/theme/theme.h"

#include <QtGui/QPainter>
#include <QtGui/QPainterPath>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

constexpr double kReach = 7;      // pixels around a line that take hold of it
constexpr double kKnob = 4;       // pixels, radius of the mark on a tip or corner
constexpr double kArrow = 44;     // pixels, shortest arrow
constexpr double kAlongAxis = 5;  // degrees from an axis at which a jet snaps to it
constexpr int kPoints = 40;       // of a circle

double diameterOf(const Emitter& emitter) { return numberOf(emitter.parameters, emitterParameters(), "diameter"); }

double segmentDistance(const QPointF& p, const QPointF& a, const QPointF& b) {
  const QPointF way = b - a;
  const double square = QPointF::dotProduct(way, way);
  const double t = square > 0 ? std::clamp(QPointF::dotProduct(p - a, way) / square, 0.0, 1.0) : 0;
  const QPointF off = p - (a + t * way);
  return std::hypot(off.x(), off.y());
}

/// The lines of a port, projected.
class Outline {
 public:
  explicit Outline(const PortView& view) : m_view(view) {}

  std::optional<QPointF> at(const Vector3& p) const {
    const auto pixel =
        project(m_view.camera, static_cast<int>(m_view.size.width()), static_cast<int>(m_view.size.height()), p);
    return pixel ? std::optional(QPointF((*pixel)[0], (*pixel)[1])) : std::nullopt;
  }

  void add(const Emitter& emitter) {
    const Vector3 d = emitter.direction.normalized();
    const Vector3 helper = std::abs(d.y()) < 0.9 ? Vector3{0, 1, 0} : Vector3{1, 0, 0};
    const Vector3 side = d.cross(helper).normalized(), up = d.cross(side);
    const double radius = diameterOf(emitter) / 2;
    const auto onRim = [&](int k) -> Vector3 {
      const double angle = 2 * std::numbers::pi * k / kPoints;
      return emitter.point + radius * (std::cos(angle) * side + std::sin(angle) * up);
    };
    for (int k = 0; k < kPoints; ++k) {
      line(onRim(k), onRim(k + 1));
      if (const auto p = at(onRim(k))) face << *p;
    }
    const Vector3 tip = arrowTip(emitter, m_view.camera, m_view.size.height());
    line(emitter.point, tip);
    const auto a = at(emitter.point), b = at(tip);
    if (!a || !b) return;
    const QPointF way = *b - *a;
    const double length = std::hypot(way.x(), way.y());
    if (length < 8) return;  // seen along the jet
    const QPointF back = way * (9 / length), across(back.y() * 0.5, -back.x() * 0.5);
    lines.push_back({*b, *b - back + across});
    lines.push_back({*b, *b - back - across});
  }

  void add(const Sink& sink) {
    for (int k = 0; k < 8; ++k) {
      for (int bit = 1; bit < 8; bit *= 2) {
        if (!(k & bit)) line(cornerOf(sink, k), cornerOf(sink, k | bit));
      }
    }
  }

  bool hit(const QPointF& p) const {
    if (face.containsPoint(p, Qt::OddEvenFill)) return true;
    return std::any_of(lines.begin(), lines.end(),
                       [&](const auto& l) { return segmentDistance(p, l.first, l.second) < kReach; });
  }

  std::vector<std::pair<QPointF, QPointF>> lines;
  QPolygonF face;

 private:
  void line(const Vector3& from, const Vector3& to) {
    const auto a = at(from), b = at(to);
    if (a && b) lines.push_back({*a, *b});
  }
  const PortView& m_view;
};

/// visit(port, item) for each port, the selected one first or last.
template <class Visit>
void forPorts(const PortView& view, bool selectedFirst, Visit&& visit) {
  const auto pass = [&](bool marked) {
    const auto all = [&](const auto& items, bool isSink) {
      for (const auto& item : items) {
        const Port port{isSink, item.id};
        if ((view.selected == port) == marked) visit(port, item);
      }
    };
    if (view.emitters) all(*view.emitters, false);
    if (view.sinks) all(*view.sinks, true);
  };
  pass(selectedFirst);
  pass(!selectedFirst);
}

bool works(const Emitter& emitter) { return numberOf(emitter.parameters, emitterParameters(), "speed") > 0; }
bool works(const Sink& sink) { return toggleOf(sink.parameters, sinkParameters(), "open"); }

Vector3 anchorOf(const Emitter& emitter) { return emitter.point; }
Vector3 anchorOf(const Sink& sink) { return 0.5 * (sink.minimum + sink.maximum); }

std::vector<PortHandle> knobsOf(const Port& port, const Emitter& emitter, const PortView& view) {
  return {{port, PortHandle::Part::Tip, 0, arrowTip(emitter, view.camera, view.size.height())}};
}
std::vector<PortHandle> knobsOf(const Port& port, const Sink& sink, const PortView&) {
  std::vector<PortHandle> knobs;
  knobs.reserve(8);
  for (int k = 0; k < 8; ++k) knobs.push_back({port, PortHandle::Part::Corner, k, cornerOf(sink, k)});
  return knobs;
}

}  // namespace

Vector3 arrowTip(const Emitter& emitter, const Camera& camera, double height) {
  const CameraFrame frame = frameOf(camera);
  const double depth = std::max(nearPlane(camera), (emitter.point - frame.eye).dot(frame.forward));
  const double length = std::max(2 * diameterOf(emitter), kArrow * pixelSize(camera, static_cast<int>(height), depth));
  return emitter.point + length * emitter.direction.normalized();
}

Vector3 cornerOf(const Sink& sink, int corner) {
  Vector3 p;
  for (size_t a = 0; a < 3; ++a) p[a] = corner >> a & 1 ? sink.maximum[a] : sink.minimum[a];
  return p;
}

std::optional<PortHandle> handleAt(const PortView& view, const QPointF& position) {
  std::optional<PortHandle> found;
  forPorts(view, true, [&](const Port& port, const auto& item) {
    if (found) return;
    Outline outline(view);
    if (view.selected == port) {
      for (const PortHandle& knob : knobsOf(port, item, view)) {
        const auto p = outline.at(knob.place);
        if (p && segmentDistance(position, *p, *p) < kReach + 2) found = knob;
      }
    }
    outline.add(item);
    if (!found && outline.hit(position)) found = PortHandle{port, PortHandle::Part::Whole, 0, anchorOf(item)};
  });
  return found;
}

void paintPorts(QPainter& painter, const PortView& view) {
  const Theme& theme = Theme::current();
  forPorts(view, false, [&](const Port& port, const auto& item) {
    const bool marked = view.selected == port, warm = view.hovered == port;
    const QColor colour = theme[marked        ? Token::Accent
                                : warm        ? Token::Text
                                : works(item) ? Token::Text2
                                              : Token::Muted];
    Outline outline(view);
    outline.add(item);
    QPainterPath path;
    for (const auto& [a, b] : outline.lines) {
      path.moveTo(a);
      path.lineTo(b);
    }
    QColor fill = colour;
    fill.setAlphaF(0.18F);
    painter.setPen(Qt::NoPen);
    painter.setBrush(fill);
    painter.drawPolygon(outline.face);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(theme[Token::Shadow], 3.5));
    painter.drawPath(path);
    painter.setPen(QPen(colour, marked || warm ? 2 : 1.5, works(item) ? Qt::SolidLine : Qt::DashLine));
    painter.drawPath(path);
    if (!marked) return;
    painter.setPen(QPen(theme[Token::Shadow], 1.5));
    painter.setBrush(colour);
    for (const PortHandle& knob : knobsOf(port, item, view)) {
      if (const auto p = outline.at(knob.place)) painter.drawEllipse(*p, kKnob, kKnob);
    }
  });
}

Emitter dragged(Emitter emitter, const PortHandle& handle, const Vector3& to) {
  const Vector3 way = to - (handle.part == PortHandle::Part::Tip ? emitter.point : handle.place);
  if (handle.part != PortHandle::Part::Tip) {
    emitter.point += way;
    return emitter;
  }
  if (!(way.squaredNorm() > 0)) return emitter;
  emitter.direction = way.normalized();
  for (size_t a = 0; a < 3; ++a) {
    if (std::abs(emitter.direction[a]) < std::cos(kAlongAxis * std::numbers::pi / 180)) continue;
    const double sign = emitter.direction[a] > 0 ? 1 : -1;
    emitter.direction = {0, 0, 0};
    emitter.direction[a] = sign;
    break;
  }
  return emitter;
}

Sink dragged(Sink sink, const PortHandle& handle, const Vector3& to, double least) {
  for (size_t a = 0; a < 3; ++a) {
    if (handle.part == PortHandle::Part::Whole) {
      sink.minimum[a] += to[a] - handle.place[a];
      sink.maximum[a] += to[a] - handle.place[a];
    } else if (handle.corner >> a & 1) {
      sink.maximum[a] = std::max(to[a], sink.minimum[a] + least);
    } else {
      sink.minimum[a] = std::min(to[a], sink.maximum[a] - least);
    }
  }
  return sink;
}

}  // namespace ps
