// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/placing.h"

#include "core/scene/pose.h"
#include "core/scene/scenewall.h"
#include "core/scene/solidform.h"
#include "core/scene/turnedbox.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/pinaddress.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

using Kind = Gizmo::Kind;

QString quoted(const QString& name, const QString& why) { return QStringLiteral("“%1”: %2").arg(name, why); }

template <class Box>
Vector3 middleOf(const Box& box) {
  return TurnedBox(box).middle();
}

/// Where a body's matter is, as far as that is known.
Vector3 placeOf(const Body& body, const MatterPlaces& matter) {
  const auto known = matter.find(body.id);
  return known == matter.end() ? centroidOf(body) : known->second;
}

/// Adds a thing, or notes why it is none of those that can be dragged.
struct Collector {
  Placeable& out;
  QStringList notes;

  void add(const SelectedItem& item, const Vector3& place, const QString& name, const QString& why) {
    if (why.isEmpty())
      out.items.emplace_back(item, place);
    else
      notes << quoted(name, why);
  }
};

void collect(Collector& to, const Document& document, const SelectedItem& item, Kind kind, const MatterPlaces& matter) {
  const auto thing = thingOf(item);
  const auto marks = thing ? document.marks(*thing) : std::nullopt;
  const bool locked = marks && marks->locked;
  const auto unless = [&](bool cannot = false, const char* why = "") {
    return locked ? QStringLiteral("locked") : cannot ? QString::fromUtf8(why) : QString();
  };
  if (const Body* body = item.kind == OutlineKind::Body ? document.body(item.id) : nullptr) {
    to.add(item, placeOf(*body, matter), nameOf(*body), unless());
  } else if (const Emitter* emitter = item.kind == OutlineKind::Emitter ? document.emitter(item.id) : nullptr) {
    to.add(item, emitter->point, nameOf(*emitter), unless());
  } else if (const Sink* sink = item.kind == OutlineKind::Sink ? document.sink(item.id) : nullptr) {
    to.add(item, middleOf(*sink), nameOf(*sink), unless());
  } else if (const SceneWall* wall = item.kind == OutlineKind::Wall ? document.wall(item.id) : nullptr) {
    to.add(item, wall->point, nameOf(*wall),
           unless(kind == Kind::Scale && !faceOf(*wall).isCurved(), "a plane has no end and cannot be scaled"));
  } else if (const Probe* probe = item.kind == OutlineKind::Probe ? document.probe(item.id) : nullptr) {
    to.add(item, probe->region ? middleOf(*probe->region) : Vector3(Vector3::Zero()), nameOf(*probe),
           !probe->region
               ? unless(true, "it measures wherever its matter is, and has no place of its own")
               : unless(kind == Kind::Rotate, "the box of a probe stands along the axes and cannot be turned"));
  } else if (const Region* pin = item.kind == OutlineKind::Pin ? findPin(document.project(), item.id) : nullptr) {
    const Body& held = *document.body(PinAddress::parse(item.id)->body);
    to.add(item, middleOf(*pin), QStringLiteral("Pin of %1").arg(nameOf(held)),
           unless(kind == Kind::Rotate, "a pin stands along the axes and cannot be turned"));
  }
}

/// Of what is turned and can be stretched along axes of its own.
std::optional<Matrix3> ownAxes(const Document& document, const SelectedItem& item) {
  const auto turned = [](const auto& form) { return form.isTurned() ? std::optional(form.axes()) : std::nullopt; };
  if (const Body* body = item.kind == OutlineKind::Body ? document.body(item.id) : nullptr) {
    const auto* solid = std::get_if<SolidShape>(&body->shape);
    return solid ? turned(SolidForm(*solid)) : std::nullopt;
  }
  const Sink* sink = item.kind == OutlineKind::Sink ? document.sink(item.id) : nullptr;
  return sink ? turned(TurnedBox(*sink)) : std::nullopt;
}

/// What stretching goes along: a single thing's own axes. Of several, those of the scene, while none is turned.
void chooseAxes(Placeable& out, const Document& document) {
  for (const auto& [item, place] : out.items) {
    const std::optional<Matrix3> own = ownAxes(document, item);
    if (!own) continue;
    out.along = out.items.size() == 1;
    if (out.along) out.axes = *own;
  }
}

/// Adds a pin to those of its body that are meant.
void choose(std::vector<BodyPins>& all, const Document& document, const PinAddress& pin) {
  const auto same = [&](const BodyPins& pins) { return pins.id == pin.body; };
  auto found = std::find_if(all.begin(), all.end(), same);
  if (found == all.end()) found = all.insert(all.end(), {pin.body, document.body(pin.body)->pins});
  found->chosen.push_back(pin.index);
}

/// About its middle, which goes by `way`.
template <class Box>
void stretch(Box& box, const Vector3& factors, const Vector3& way) {
  TurnedBox there(box);
  there.resize(there.size().cwiseProduct(factors), there.middle() + way);
  there.putInto(box);
}

/// Of what stays round: the greatest change across its axis.
double changeAcross(const Vector3& axis, const Vector3& factors) {
  constexpr double kAlong = 0.9;
  double factor = 1;
  for (int a = 0; a < 3; ++a) {
    const bool across = std::abs(axis[a]) < kAlong;
    if (across && std::abs(factors[a] - 1) > std::abs(factor - 1)) factor = factors[a];
  }
  return factor;
}

void setWithin(ParameterSet& set, api::ParameterList list, const char* key, double value) {
  const api::ParameterDeclaration& declared = *findDeclaration(list, key);
  set.values[key] = std::clamp(value, declared.hardMinimum, declared.hardMaximum);
}

void stretch(SceneWall& wall, const Vector3& factors) {
  const WallFace face = faceOf(wall);
  if (!face.isCurved()) return;
  setWithin(wall.parameters, wallParameters(), "radius", changeAcross(face.axis(), factors) * face.radius());
}

/// Its mouth.
void stretch(Emitter& emitter, const Vector3& factors) {
  const double factor = changeAcross(emitter.direction.normalized(), factors);
  if (factor == 1) return;
  const double diameter = numberOf(emitter.parameters, emitterParameters(), "diameter");
  setWithin(emitter.parameters, emitterParameters(), "diameter", factor * diameter);
}

/// visit(box) for drains, regions of probes and those pins that are meant.
template <class Visit>
void eachBox(Placement& things, Visit&& visit) {
  for (Sink& sink : things.sinks) visit(sink);
  for (Probe& probe : things.probes) {
    if (probe.region) visit(*probe.region);
  }
  for (BodyPins& pins : things.pins) {
    for (const size_t k : pins.chosen) visit(pins.boxes[k]);
  }
}

}  // namespace

MatterPlaces matterOf(const Snapshot* scene, const std::vector<std::string>& bodies) {
  MatterPlaces places;
  if (!scene || !scene->bodyIds || bodies.empty()) return places;
  std::vector<Vector3> sums(scene->bodyIds->size());
  std::vector<double> counts(sums.size());
  std::vector<uint8_t> wanted(sums.size());
  for (size_t k = 0; k < sums.size(); ++k)
    wanted[k] = std::find(bodies.begin(), bodies.end(), (*scene->bodyIds)[k]) != bodies.end() ? 1 : 0;
  for (size_t i = 0; i < scene->position.size(); ++i) {
    const uint32_t body = scene->body[i];
    if (body >= wanted.size() || wanted[body] == 0) continue;
    sums[body] += vectorOf(scene->position[i]);
    ++counts[body];
  }
  for (size_t k = 0; k < sums.size(); ++k) {
    if (counts[k] > 0) places[(*scene->bodyIds)[k]] = sums[k] / counts[k];
  }
  return places;
}

Vector3 Placeable::middle() const {
  Vector3 sum;
  for (const auto& [item, place] : items) sum += place;
  return items.empty() ? sum : Vector3(sum / static_cast<double>(items.size()));
}

Vector3 Placeable::centre(Kind kind, Pivot pivot) const {
  if (pivot == Pivot::Last && !items.empty()) return items.back().second;
  return pivot == Pivot::Origin && kind != Kind::Move ? Vector3(Vector3::Zero()) : middle();
}

Placeable placeable(const Document& document, const std::vector<SelectedItem>& selected, Kind kind,
                    const MatterPlaces& matter) {
  Placeable out;
  Collector collector{out, {}};
  const auto goesWithItsBody = [&](const SelectedItem& item) {  // what moves goes along as it is
    const auto pin = item.kind == OutlineKind::Pin ? PinAddress::parse(item.id) : std::nullopt;
    return pin &&
           std::find(selected.begin(), selected.end(), SelectedItem{OutlineKind::Body, pin->body}) != selected.end();
  };
  for (const SelectedItem& item : selected) {
    if (!goesWithItsBody(item)) collect(collector, document, item, kind, matter);
  }
  if (kind == Kind::Scale) chooseAxes(out, document);
  constexpr int kMost = 2;
  if (collector.notes.size() > kMost) {
    const qsizetype more = collector.notes.size() - 1;
    collector.notes = collector.notes.mid(0, 1);
    collector.notes << QStringLiteral("and %1 more").arg(more);
  }
  out.note = collector.notes.join(QStringLiteral("; "));
  return out;
}

Placement placementOf(const Document& document, const Placeable& placeable) {
  Placement things;
  for (const auto& [item, place] : placeable.items) {
    if (item.kind == OutlineKind::Body) things.bodies.push_back(*document.body(item.id));
    if (item.kind == OutlineKind::Emitter) things.emitters.push_back(*document.emitter(item.id));
    if (item.kind == OutlineKind::Sink) things.sinks.push_back(*document.sink(item.id));
    if (item.kind == OutlineKind::Wall) things.walls.push_back(*document.wall(item.id));
    if (item.kind == OutlineKind::Probe) things.probes.push_back(*document.probe(item.id));
    if (item.kind == OutlineKind::Pin) choose(things.pins, document, *PinAddress::parse(item.id));
  }
  return things;
}

Placement shifted(Placement things, const Vector3& way) {
  for (Body& body : things.bodies) {
    const RigidMove move = possibleMove(body, {Quaternion::Identity(), way});
    body = moved(std::move(body), move);
  }
  for (Emitter& emitter : things.emitters) emitter.point += way;
  for (SceneWall& wall : things.walls) wall.point += way;
  eachBox(things, [&](auto& box) { box = carried(std::move(box), {Quaternion::Identity(), way}); });
  return things;
}

Placement turned(Placement things, const MatterPlaces& matter, const std::optional<Vector3>& pivot,
                 const Quaternion& turn) {
  const auto gone = [&](const Vector3& place) {
    return pivot ? RigidMove::about(*pivot, turn).of(place) : Vector3(place);
  };
  for (Body& body : things.bodies) {
    const Vector3 stands = placeOf(body, matter);
    RigidMove move = RigidMove::about(centroidOf(body), turn);
    move.shift += gone(stands) - stands;
    body = moved(std::move(body), move);
  }
  for (Emitter& emitter : things.emitters) {
    emitter.point = gone(emitter.point);
    emitter.direction = turn * emitter.direction;
  }
  for (SceneWall& wall : things.walls) {
    wall.point = gone(wall.point);
    wall.normal = turn * wall.normal;
  }
  for (Sink& sink : things.sinks) {
    const Vector3 stands = middleOf(sink);
    RigidMove move = RigidMove::about(stands, turn);
    move.shift += gone(stands) - stands;
    sink = carried(std::move(sink), move);
  }
  return things;
}

Placement stretched(Placement things, const Vector3& factors, const MatterPlaces& matter, const PlaceStretch& places) {
  const auto way = [&](const Vector3& place) -> Vector3 {
    if (!places.pivot) return Vector3::Zero();
    const Vector3 from = places.axes.transpose() * (place - *places.pivot);
    return places.axes * (factors - Vector3::Ones()).cwiseProduct(from);
  };
  for (SceneWall& wall : things.walls) {
    stretch(wall, factors);
    wall.point += way(wall.point);
  }
  for (Body& body : things.bodies) {
    const Vector3 shift = way(placeOf(body, matter));
    body = scaled(std::move(body), factors, shift);
  }
  for (Emitter& emitter : things.emitters) {
    stretch(emitter, factors);
    emitter.point += way(emitter.point);
  }
  eachBox(things, [&](auto& box) { stretch(box, factors, way(middleOf(box))); });
  return things;
}

}  // namespace ps
