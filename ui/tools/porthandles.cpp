// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/porthandles.h"

#include "core/scene/turnedbox.h"
#include "ui/tools/aim.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

constexpr double kReach = 7;      // units of fineness around a line that take hold of it
constexpr double kKnobReach = 9;  // around a knob
constexpr double kAlongAxis = 5;  // degrees from an axis at which a jet snaps to it
constexpr int kPoints = 40;       // of a circle

double diameterOf(const Emitter& emitter) { return numberOf(emitter.parameters, emitterParameters(), "diameter"); }

/// Whether the aim lies within a closed line: it crosses it an odd number of times on the way out.
bool aimedInto(const Pointer& pointer, const std::vector<Vector3>& face) {
  bool inside = false;
  for (size_t i = 0; i < face.size(); ++i) {
    const auto a = aimTo(pointer, face[i]), b = aimTo(pointer, face[(i + 1) % face.size()]);
    if (!a || !b) return false;
    if ((a->y > 0) != (b->y > 0) && a->x - a->y * (b->x - a->x) / (b->y - a->y) > 0) inside = !inside;
  }
  return inside;
}

bool hits(const Pointer& pointer, const PortShape& shape) {
  return aimedInto(pointer, shape.face) || std::any_of(shape.lines.begin(), shape.lines.end(), [&](const auto& line) {
           return aimDistance(pointer, line.first, line.second) < kReach;
         });
}

/// m, of the shortest jet that can be aimed at from there.
double leastJet(const Pointer& pointer, const Vector3& place) {
  return kLeastJet * pointer.fineness * std::max(0.0, (place - pointer.ray.origin).dot(pointer.forward));
}

}  // namespace

PortShape shapeOf(const Emitter& emitter, double least) {
  PortShape shape;
  const Vector3 d = emitter.direction.normalized();
  const Vector3 helper = std::abs(d.y()) < 0.9 ? Vector3(0, 1, 0) : Vector3(1, 0, 0);
  const Vector3 side = d.cross(helper).normalized(), up = d.cross(side);
  const double radius = diameterOf(emitter) / 2;
  const auto onRim = [&](int k) -> Vector3 {
    const double angle = 2 * std::numbers::pi * k / kPoints;
    return emitter.point + radius * (std::cos(angle) * side + std::sin(angle) * up);
  };
  for (int k = 0; k < kPoints; ++k) {
    shape.lines.emplace_back(onRim(k), onRim(k + 1));
    shape.face.push_back(onRim(k));
  }
  shape.jet.emplace(emitter.point, arrowTip(emitter, least));
  shape.lines.push_back(*shape.jet);
  return shape;
}

PortShape shapeOf(const Sink& sink, double /*least*/) {
  PortShape shape;
  const TurnedBox box(sink);
  for (int k = 0; k < 8; ++k) {
    for (int bit = 1; bit < 8; bit *= 2) {
      if (!(k & bit)) shape.lines.emplace_back(box.corner(k), box.corner(k | bit));
    }
  }
  return shape;
}

Vector3 anchorOf(const Emitter& emitter) { return emitter.point; }
Vector3 anchorOf(const Sink& sink) { return 0.5 * (sink.minimum + sink.maximum); }

std::vector<PortHandle> knobsOf(const Port& port, const Emitter& emitter, double least) {
  return {{port, PortHandle::Part::Tip, 0, arrowTip(emitter, least)}};
}
std::vector<PortHandle> knobsOf(const Port& port, const Sink& sink, double /*least*/) {
  std::vector<PortHandle> knobs;
  knobs.reserve(8);
  for (int k = 0; k < 8; ++k) knobs.push_back({port, PortHandle::Part::Corner, k, cornerOf(sink, k)});
  return knobs;
}

Vector3 arrowTip(const Emitter& emitter, double least) {
  return emitter.point + std::max(2 * diameterOf(emitter), least) * emitter.direction.normalized();
}

Vector3 cornerOf(const Sink& sink, int corner) { return TurnedBox(sink).corner(corner); }

std::optional<PortHandle> handleAt(const PortSet& ports, const Pointer& pointer) {
  std::optional<PortHandle> found;
  forPorts(ports, true, [&](const Port& port, const auto& item) {
    if (found || item.locked) return;
    const double least = leastJet(pointer, anchorOf(item));
    if (ports.selected == port) {
      for (const PortHandle& knob : knobsOf(port, item, least)) {
        if (aimDistance(pointer, knob.place, knob.place) < kKnobReach) found = knob;
      }
    }
    if (!found && hits(pointer, shapeOf(item, least)))
      found = PortHandle{port, PortHandle::Part::Whole, 0, anchorOf(item)};
  });
  return found;
}

Emitter dragged(Emitter emitter, const PortHandle& handle, const Vector3& to) {
  const Vector3 way = to - (handle.part == PortHandle::Part::Tip ? emitter.point : handle.place);
  if (handle.part != PortHandle::Part::Tip) {
    emitter.point += way;
    return emitter;
  }
  if (!(way.squaredNorm() > 0)) return emitter;
  emitter.direction = way.normalized();
  for (int a = 0; a < 3; ++a) {
    if (std::abs(emitter.direction[a]) < std::cos(kAlongAxis * std::numbers::pi / 180)) continue;
    const double sign = emitter.direction[a] > 0 ? 1 : -1;
    emitter.direction.setZero();
    emitter.direction[a] = sign;
    break;
  }
  return emitter;
}

/// A corner goes along the box's own axes; the one opposite stays.
Sink dragged(Sink sink, const PortHandle& handle, const Vector3& to, double least) {
  TurnedBox box(sink);
  if (handle.part == PortHandle::Part::Whole) {
    box.go({Quaternion::Identity(), to - handle.place});
  } else {
    const Vector3 opposite = box.corner(7 - handle.corner);
    Vector3 way = box.axes().transpose() * (to - opposite), size;
    for (int a = 0; a < 3; ++a) {
      const double sign = (handle.corner >> a & 1) != 0 ? 1 : -1;
      size[a] = std::max(sign * way[a], least);
      way[a] = sign * size[a];
    }
    if (!box.isTurned()) {  // the corner opposite stays to the last digit
      sink.minimum = opposite.cwiseMin(opposite + way);
      sink.maximum = opposite.cwiseMax(opposite + way);
      return sink;
    }
    box.resize(size, opposite + box.axes() * (0.5 * way));
  }
  box.putInto(sink);
  return sink;
}

}  // namespace ps
