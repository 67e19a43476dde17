// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/placetap.h"

#include "core/sketch/drawingplane.h"
#include "ui/session/selection.h"
#include "ui/tools/tooltable.h"

#include <algorithm>

namespace ps {
namespace {
constexpr double kMouth = 4;  // spacings, diameter of a new mouth
}

Emitter PlaceTap::at(const Surface& surface, const Pointer* pressed, const Pointer& pointer) const {
  Emitter tap;
  const double spacing = shownSpacing(pointer, box().spacing());
  tap.parameters.values["diameter"] = std::clamp(kMouth * spacing, 1e-4, 10.0);
  tap.parameters.values["temperature"] = box().brush().temperature;
  // Half a spacing off the surface, where the first particle has room.
  tap.point = surface.point + 0.5 * spacing * surface.normal;
  if (surface.normal.squaredNorm() > 0) tap.direction = surface.normal;
  if (!pressed || !wandered(*pressed, pointer)) return tap;
  const DrawingPlane plane = uprightThrough(surface.point, pressed->forward);
  const auto from = meet(pressed->ray, plane), to = meet(pointer.ray, plane);
  if (!from || !to || !(to->y() > from->y())) return tap;
  tap.point = surface.point + Vector3(0, to->y() - from->y(), 0);
  tap.direction = Vector3(0, -1, 0);
  return tap;
}

void PlaceTap::put(Emitter tap) {
  Document& document = box().document();
  const std::vector<SceneMaterial>& materials = document.project().materials;
  if (materials.empty()) {
    box().refuse(QStringLiteral("Nothing was placed."),
                 QStringLiteral("The scene has no material that a tap could pour. Add one under Materials."));
    return;
  }
  const std::string& wanted = box().brush().material;
  const bool known =
      std::any_of(materials.begin(), materials.end(), [&](const SceneMaterial& m) { return m.id == wanted; });
  tap.material = known ? wanted : materials.front().id;
  const Port port = document.addEmitter(std::move(tap));
  box().activate(kSelectTool);
  box().selection().select(port);
}

ToolPicture PlaceTap::picture() const {
  ToolPicture picture;
  picture.pointer = PointerShape::Cross;
  if (preview()) picture.emitters.push_back(*preview());
  return picture;
}

std::vector<Gesture> PlaceTap::gestures() const {
  return {{QStringLiteral("Click"), QStringLiteral("A tap that pours away from the surface, or down from the air"),
           QStringLiteral("tap on the surface")},
          {QStringLiteral("Drag up"), QStringLiteral("A tap above the surface that pours down"),
           QStringLiteral("above it")}};
}

}  // namespace ps
