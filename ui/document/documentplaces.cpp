// SPDX-License-Identifier: Apache-2.0
// Places of a document's things: moved, turned and stretched together, each drag as one command.
#include "core/scene/pose.h"
#include "core/scene/scenewall.h"
#include "ui/document/commands.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/portbounds.h"

#include <algorithm>
#include <utility>

namespace ps {
namespace {

template <class Items>
auto at(Items& items, const std::string& id) {
  return std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.id == id; });
}

/// Those of the same ids, as they are now.
template <class Item>
std::vector<Item> standing(const std::vector<Item>& all, const std::vector<Item>& wanted) {
  std::vector<Item> found;
  for (const Item& item : wanted) {
    if (const auto now = at(all, item.id); now != all.end()) found.push_back(*now);
  }
  return found;
}

std::vector<BodyPins> standing(const std::vector<Body>& all, const std::vector<BodyPins>& wanted) {
  std::vector<BodyPins> found;
  for (const BodyPins& pins : wanted) found.push_back({pins.id, at(all, pins.id)->pins});
  return found;
}

template <class Known, class Item>
void keepKnown(const std::vector<Known>& all, std::vector<Item>& wanted) {
  std::erase_if(wanted, [&](const Item& item) { return at(all, item.id) == all.end(); });
}

/// Parameters of a solid's shape that differ, but for those of its pose.
std::vector<std::string> resized(const Body& from, const Body& to) {
  const auto *before = std::get_if<SolidShape>(&from.shape), *after = std::get_if<SolidShape>(&to.shape);
  std::vector<std::string> keys;
  const api::ParameterList list = solidParameters();
  for (size_t k = 0; before && after && k < list.count; ++k) {
    if (list[k].actsAt == api::ActsAt::NextReset &&
        !(valueOf(before->parameters, list[k]) == valueOf(after->parameters, list[k])))
      keys.emplace_back(list[k].key);
  }
  return keys;
}

std::optional<BodyChanged::Resized> resizedCells(const Body& from, const Body& to) {
  const auto *before = std::get_if<VoxelShape>(&from.shape), *after = std::get_if<VoxelShape>(&to.shape);
  if (!before || !after || before->spacing == after->spacing) return std::nullopt;
  return BodyChanged::Resized{after->spacing / before->spacing, pivotOf(from)};
}

}  // namespace

void Document::place(Placement after, const QString& title) {
  keepKnown(m_project.bodies, after.bodies);
  keepKnown(m_project.emitters, after.emitters);
  keepKnown(m_project.sinks, after.sinks);
  keepKnown(m_project.environment.walls, after.walls);
  keepKnown(m_project.probes, after.probes);
  keepKnown(m_project.bodies, after.pins);
  if (after.empty()) return;
  for (Emitter& emitter : after.emitters) keepWithin(m_project.environment, emitter);
  for (Sink& sink : after.sinks) keepWithin(m_project.environment, sink);
  if (m_gestureDepth == 0) ++m_gesture;
  Placement before{standing(m_project.bodies, after.bodies),
                   standing(m_project.emitters, after.emitters),
                   standing(m_project.sinks, after.sinks),
                   standing(m_project.environment.walls, after.walls),
                   standing(m_project.probes, after.probes),
                   standing(m_project.bodies, after.pins),
                   after.led};
  m_undo.push(new PlacementCommand(*this, std::move(before), std::move(after), m_gesture, title));
}

void Document::applyPlacement(const Placement& to) {
  ++m_changes;
  for (const Body& body : to.bodies) {
    Body& here = *at(m_project.bodies, body.id);
    if (here.shape == body.shape) continue;  // a step of a drag that is none
    const std::optional<RigidMove> move = moveBetween(sizedAs(here, body), body);
    const std::vector<std::string> keys = resized(here, body);
    const Body before = here;
    here.shape = body.shape;
    here.pins = body.pins;
    here.temperatureGradient = body.temperatureGradient;
    for (const std::string& key : keys) {
      const Address address{Owner::Shape, body.id, key};
      const api::ParameterDeclaration& declared = *findDeclaration(solidParameters(), key);
      notify(ParameterChanged{address, valueOf(std::get<SolidShape>(here.shape).parameters, declared),
                              valueOf(std::get<SolidShape>(before.shape).parameters, declared)});
    }
    if (move || keys.empty()) notify(BodyChanged{body.id, {}, move, {}, false, to.led, resizedCells(before, here)});
    if (move && before.shape.index() != here.shape.index()) notify(BodyChanged{body.id});  // it has other rows
  }
  for (const BodyPins& pins : to.pins) {
    at(m_project.bodies, pins.id)->pins = pins.boxes;
    notify(BodyChanged{pins.id, {}, {}, {}, true});
  }
  const auto put = [this](Owner owner, auto& all, const auto& item, api::ParameterList list) {
    const auto before = std::exchange(*at(all, item.id), item);
    for (size_t k = 0; k < list.count; ++k) {
      const Value was = valueOf(before.parameters, list[k]), is = valueOf(item.parameters, list[k]);
      if (!(was == is)) notify(ParameterChanged{{owner, item.id, list[k].key}, is, was});
    }
  };
  for (const Emitter& emitter : to.emitters) {
    put(Owner::Emitter, m_project.emitters, emitter, emitterParameters());
    notify(PortChanged{true, emitter.id, {}});
  }
  for (const Sink& sink : to.sinks) {
    put(Owner::Sink, m_project.sinks, sink, sinkParameters());
    notify(PortChanged{true, sink.id, {}});
  }
  for (const SceneWall& wall : to.walls) put(Owner::Wall, m_project.environment.walls, wall, wallParameters());
  if (!to.walls.empty()) notify(WallsChanged{true});
  for (const Probe& probe : to.probes) {
    *at(m_project.probes, probe.id) = probe;
    notify(ProbesChanged{probe.id});
  }
}

}  // namespace ps
