// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/selecttool.h"

#include "ui/document/document.h"
#include "ui/document/pinaddress.h"
#include "ui/render/camera.h"
#include "ui/session/selection.h"
#include "ui/tools/aim.h"
#include "ui/tools/picking.h"
#include "ui/tools/toolbox.h"

#include <algorithm>

namespace ps {
namespace {}  // namespace

void SelectTool::hover(const Pointer& pointer) {
  m_handles.hover(pointer);
  const auto pick = pickAt(box().document().project(), box().selection().items(), pointer);
  m_hovered = pick && pick->byLine ? std::optional(pick->item) : std::nullopt;
}

void SelectTool::leave() {
  m_handles.leave();
  m_hovered.reset();
}

bool SelectTool::press(const Pointer& pointer) {
  if (!pointer.control) return m_handles.press(pointer);
  m_corner = pointer;
  m_corner->scene = nullptr;  // its memory is not held meanwhile
  return true;
}

void SelectTool::drag(const Pointer& pointer) {
  if (!m_corner) {
    m_handles.drag(pointer);
  } else if (m_opposite || wandered(*m_corner, pointer)) {
    m_opposite = pointer;
    m_opposite->scene = nullptr;
  }
}

void SelectTool::release(const Pointer& pointer) {
  if (!m_corner) {
    m_handles.release(pointer);
    return;
  }
  drag(pointer);
  if (m_opposite)
    box().selection().selectAll(framed(pointer));
  else
    click(pointer);
  m_corner.reset();
  m_opposite.reset();
}

bool SelectTool::cancel() {
  const bool framing = m_corner.has_value();
  m_corner.reset();
  m_opposite.reset();
  return m_handles.cancel() || framing;
}

std::vector<SelectedItem> SelectTool::framed(const Pointer& to) const {
  const auto across = aimTo(*m_corner, to.ray.origin + to.ray.direction);
  if (!across) return {};
  const auto within = [&](const Vector3& place) {
    const auto at = aimTo(*m_corner, place);
    return at && at->x >= std::min(0.0, across->x) && at->x <= std::max(0.0, across->x) &&
           at->y >= std::min(0.0, across->y) && at->y <= std::max(0.0, across->y);
  };
  const Project& project = box().document().project();
  std::vector<SelectedItem> items;
  if (const Snapshot* scene = to.scene.get(); scene && scene->bodyIds) {
    std::vector<uint8_t> seen(scene->bodyIds->size());
    for (size_t i = 0; i < scene->position.size(); ++i) {
      const uint32_t body = scene->body[i];
      if (body >= seen.size() || seen[body] != 0) continue;
      const Vector3 place = vectorOf(scene->position[i]);
      if (within(place) && (!to.section || to.section->shows(place))) seen[body] = 1;
    }
    for (size_t k = 0; k < seen.size(); ++k) {
      const std::string& id = (*scene->bodyIds)[k];
      const Body* body = seen[k] != 0 ? box().document().body(id) : nullptr;
      if (body && !body->locked) items.push_back({OutlineKind::Body, id});
    }
  }
  for (const Emitter& emitter : project.emitters) {
    if (canPick(emitter) && within(emitter.point)) items.push_back({OutlineKind::Emitter, emitter.id});
  }
  for (const Sink& sink : project.sinks) {
    if (canPick(sink) && within(anchorOf(sink))) items.push_back({OutlineKind::Sink, sink.id});
  }
  for (const Probe& probe : project.probes) {
    if (canPick(probe) && probe.region && within(0.5 * (probe.region->minimum + probe.region->maximum)))
      items.push_back({OutlineKind::Probe, probe.id});
  }
  return items;
}

void SelectTool::click(const Pointer& pointer) {
  Selection& selection = box().selection();
  const bool adds = pointer.shift || pointer.control;
  const auto pick = pickAt(box().document().project(), selection.items(), pointer);
  if (pick) {
    if (adds) return selection.toggle(pick->item.kind, pick->item.id);
    return selection.select(pick->item.kind, pick->item.id);
  }
  const auto hit = pointer.scene ? pickParticle(*pointer.scene, pointer.ray, pointer.section) : std::nullopt;
  if (!hit) {
    if (!adds) selection.clear();
    return;
  }
  const Snapshot& scene = *pointer.scene;
  const uint32_t body = scene.body[*hit];
  const std::string id = scene.bodyIds && body < scene.bodyIds->size() ? (*scene.bodyIds)[body] : std::string();
  const bool poured = box().document().emitter(id) != nullptr;  // matter of a tap belongs to it
  const Body* own = box().document().body(id);
  if (!poured && (!own || own->locked)) {
    if (!adds) selection.clear();
  } else {
    const OutlineKind kind = poured ? OutlineKind::Emitter : OutlineKind::Body;
    if (adds)
      selection.toggle(kind, id);
    else
      selection.select(kind, id);
  }
  selection.mark(scene.revision, scene.id[*hit]);
}

/// Of walls that are selected or pointed at, of boxes in which probes measure, and of pins.
std::vector<Wire> SelectTool::wires() const {
  const Project& project = box().document().project();
  const Selection& selection = box().selection();
  std::vector<Wire> list;
  const auto add = [&](const SelectedItem& item, Lines lines, bool dashed) {
    list.push_back({std::move(lines), selection.has(item.kind, item.id), m_hovered == item, dashed});
  };
  const Environment& scene = project.environment;
  for (size_t k = 0; k < scene.walls.size(); ++k) {
    const SelectedItem item{OutlineKind::Wall, scene.walls[k].id};
    const bool selected = selection.has(item.kind, item.id);
    if (scene.walls[k].visible && (selected || m_hovered == item)) add(item, wallLines(scene, k, selected), false);
  }
  for (const Probe& probe : project.probes) {
    if (probe.visible && probe.region) add({OutlineKind::Probe, probe.id}, boxLines(*probe.region), true);
  }
  for (const SelectedItem& pin : shownPins(project, selection.items()))
    add(pin, boxLines(*findPin(project, pin.id)), true);
  return list;
}

ToolPicture SelectTool::picture() const {
  ToolPicture picture = m_handles.picture();
  picture.wires = wires();
  if (m_opposite) {
    const Ray &from = m_corner->ray, &to = m_opposite->ray;
    picture.frame.emplace(from.origin + from.direction, to.origin + to.direction);
  }
  return picture;
}

std::vector<Gesture> SelectTool::gestures() const {
  std::vector<Gesture> list{
      {QStringLiteral("Click"),
       QStringLiteral("Select the body, tap, drain, wall, pin or box of a probe, and tell the temperature"),
       {}},
      {QStringLiteral("Shift+Click"), QStringLiteral("Select it too, or no longer"), {}},
      {QStringLiteral("Ctrl+Drag"), QStringLiteral("Select what lies in the frame"), {}}};
  for (Gesture& gesture : m_handles.gestures()) list.push_back(std::move(gesture));
  return list;
}

QString SelectTool::invitation() const { return QStringLiteral("Press B and draw, or choose a material at the left"); }

}  // namespace ps
