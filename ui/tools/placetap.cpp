// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/placetap.h"

#include "core/sketch/drawingplane.h"
#include "ui/document/document.h"
#include "ui/session/selection.h"
#include "ui/tools/aim.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"

#include <algorithm>

namespace ps {
namespace {
constexpr double kMouth = 4;  // spacings, diameter of a new mouth
}

void PlaceTap::hover(const Pointer& pointer) {
  m_surface = surfaceUnder(pointer, box().document().project().environment);
  update(pointer);
}

bool PlaceTap::press(const Pointer& pointer) {
  hover(pointer);
  m_pressed = pointer;
  m_pressed->scene = nullptr;  // lives no longer than this call
  return true;
}

void PlaceTap::drag(const Pointer& pointer) { update(pointer); }

void PlaceTap::update(const Pointer& pointer) {
  m_tap.reset();
  if (!m_surface) return;
  Emitter tap;
  tap.id = kPreviewId;
  const double spacing = shownSpacing(pointer, box().spacing());
  tap.parameters.values["diameter"] = std::clamp(kMouth * spacing, 1e-4, 10.0);
  tap.parameters.values["temperature"] = box().brush().temperature;
  // Half a spacing off the surface, where the first particle has room.
  tap.point = m_surface->point + 0.5 * spacing * m_surface->normal;
  if (m_surface->normal.squaredNorm() > 0) tap.direction = m_surface->normal;
  m_tap = tap;
  if (!m_pressed || !wandered(*m_pressed, pointer)) return;
  const DrawingPlane plane = uprightThrough(m_surface->point, m_pressed->forward);
  const auto from = meet(m_pressed->ray, plane), to = meet(pointer.ray, plane);
  if (!from || !to || !(to->y() > from->y())) return;
  m_tap->point = m_surface->point + Vector3(0, to->y() - from->y(), 0);
  m_tap->direction = Vector3(0, -1, 0);
}

void PlaceTap::release(const Pointer& pointer) {
  update(pointer);
  m_pressed.reset();
  if (!m_tap) return;
  Document& document = box().document();
  const std::vector<SceneMaterial>& materials = document.project().materials;
  if (materials.empty()) {
    m_tap.reset();
    box().refuse(QStringLiteral("Nothing was placed."),
                 QStringLiteral("The scene has no material that a tap could pour. Add one under Materials."));
    return;
  }
  const std::string& wanted = box().brush().material;
  const bool known =
      std::any_of(materials.begin(), materials.end(), [&](const SceneMaterial& m) { return m.id == wanted; });
  Emitter tap = *std::exchange(m_tap, {});
  tap.id.clear();
  tap.material = known ? wanted : materials.front().id;
  const Port port = document.addEmitter(std::move(tap));
  box().activate(kSelectTool);
  box().selection().select(port);
}

bool PlaceTap::cancel() {
  m_tap.reset();
  return std::exchange(m_pressed, {}).has_value();
}

ToolPicture PlaceTap::picture() const {
  ToolPicture picture;
  picture.pointer = PointerShape::Cross;
  if (m_tap) picture.emitters.push_back(*m_tap);
  return picture;
}

std::vector<Gesture> PlaceTap::gestures() const {
  return {{QStringLiteral("Click"), QStringLiteral("A tap that pours away from the surface, or down from the air"),
           QStringLiteral("tap on the surface")},
          {QStringLiteral("Drag up"), QStringLiteral("A tap above the surface that pours down"),
           QStringLiteral("above it")}};
}

}  // namespace ps
