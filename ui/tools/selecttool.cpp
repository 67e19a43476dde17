// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/selecttool.h"

#include "core/scene/turnedbox.h"
#include "ui/document/document.h"
#include "ui/document/pinaddress.h"
#include "ui/render/camera.h"
#include "ui/session/selection.h"
#include "ui/tools/aim.h"
#include "ui/tools/picking.h"
#include "ui/tools/toolbox.h"

#include <algorithm>
#include <functional>
#include <set>
#include <string>

namespace ps {
namespace {

using Within = std::function<bool(const Vector3&)>;

/// Those that lie in it with all that is seen of them: a floor is not meant by a frame around what stands on it.
std::vector<SelectedItem> wallsWithin(const Environment& environment, const std::optional<Section>& section,
                                      const Within& within) {
  std::vector<SelectedItem> items;
  for (size_t k = 0; k < environment.walls.size(); ++k) {
    const SceneWall& wall = environment.walls[k];
    const Lines lines = canPick(wall) ? seenLines(environment, k, section) : Lines();
    const bool all = std::all_of(lines.begin(), lines.end(),
                                 [&](const auto& line) { return within(line.first) && within(line.second); });
    if (!lines.empty() && all) items.push_back({OutlineKind::Wall, wall.id});
  }
  return items;
}

/// Ids of bodies and taps of whose matter some lies in it.
std::set<std::string> matterWithin(const Snapshot& scene, const Within& within) {
  std::set<std::string> found;
  std::vector<uint8_t> seen(scene.bodyIds ? scene.bodyIds->size() : 0);
  for (size_t i = 0; i < scene.position.size(); ++i) {
    const uint32_t body = scene.body[i];
    if (body < seen.size() && seen[body] == 0 && within(vectorOf(scene.position[i]))) seen[body] = 1;
  }
  for (size_t k = 0; k < seen.size(); ++k) {
    if (seen[k] != 0) found.insert((*scene.bodyIds)[k]);
  }
  return found;
}

}  // namespace

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
  // As it is drawn: along the edges of the picture, which a corner's own ray does not go straight into.
  const auto a = inPicture(to, m_corner->ray.origin + m_corner->ray.direction);
  const auto b = inPicture(to, to.ray.origin + to.ray.direction);
  if (!a || !b) return {};
  const Aim low{std::min(a->x, b->x), std::min(a->y, b->y)}, high{std::max(a->x, b->x), std::max(a->y, b->y)};
  const Within within = [&](const Vector3& place) {
    const auto at = inPicture(to, place);
    return at && at->x >= low.x && at->x <= high.x && at->y >= low.y && at->y <= high.y &&
           (!to.section || to.section->shows(place));
  };
  const Project& project = box().document().project();
  // Matter comes last: of what is selected the last is what panels show.
  std::vector<SelectedItem> items = wallsWithin(project.environment, to.section, within);
  for (const SelectedItem& pin : shownPins(project, box().selection().items())) {
    const Body& body = *box().document().body(thingOf(pin)->id);
    if (canPick(body) && within(TurnedBox(*findPin(project, pin.id)).middle())) items.push_back(pin);
  }
  for (const Probe& probe : project.probes) {
    if (canPick(probe) && probe.region && within(TurnedBox(*probe.region).middle()))
      items.push_back({OutlineKind::Probe, probe.id});
  }
  for (const Sink& sink : project.sinks) {
    if (canPick(sink) && within(anchorOf(sink))) items.push_back({OutlineKind::Sink, sink.id});
  }
  const std::set<std::string> matter = to.scene ? matterWithin(*to.scene, within) : std::set<std::string>();
  for (const Emitter& emitter : project.emitters) {
    if (canPick(emitter) && (within(emitter.point) || matter.contains(emitter.id)))
      items.push_back({OutlineKind::Emitter, emitter.id});
  }
  for (const Body& body : project.bodies) {
    if (canPick(body) && matter.contains(body.id)) items.push_back({OutlineKind::Body, body.id});
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
      {QStringLiteral("Ctrl+Drag"),
       QStringLiteral("Select what lies in the frame; walls that lie in it as a whole"),
       {}}};
  for (Gesture& gesture : m_handles.gestures()) list.push_back(std::move(gesture));
  return list;
}

QString SelectTool::invitation() const { return QStringLiteral("Press B and draw, or choose a material at the left"); }

}  // namespace ps
