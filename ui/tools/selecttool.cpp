// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/selecttool.h"

#include "ui/document/document.h"
#include "ui/render/camera.h"
#include "ui/session/selection.h"
#include "ui/tools/toolbox.h"

namespace ps {

void SelectTool::click(const Pointer& pointer) {
  Selection& selection = box().selection();
  const auto hit = pointer.scene ? pickParticle(*pointer.scene, pointer.ray) : std::nullopt;
  if (!hit) {
    selection.clear();
    return;
  }
  const Snapshot& scene = *pointer.scene;
  const uint32_t body = scene.body[*hit];
  const std::string id = scene.bodyIds && body < scene.bodyIds->size() ? (*scene.bodyIds)[body] : std::string();
  if (box().document().emitter(id)) {
    selection.select(Port{false, id});  // poured matter belongs to its tap
  } else {
    selection.selectBody(box().document().body(id) ? id : std::string());
  }
  selection.mark(scene.revision, scene.id[*hit]);
}

std::vector<Gesture> SelectTool::gestures() const {
  std::vector<Gesture> list{
      {QStringLiteral("Drag"), QStringLiteral("Turn the view"), QStringLiteral("orbit")},
      {QStringLiteral("Shift+Drag"), QStringLiteral("Move the view sideways; the middle button does too"),
       QStringLiteral("pan")},
      {QStringLiteral("Wheel"), QStringLiteral("Nearer to what is under the pointer, or farther"),
       QStringLiteral("zoom")},
      {QStringLiteral("Click"), QStringLiteral("Select the body, tap or drain, and tell the temperature"), {}}};
  for (Gesture& gesture : m_handles.gestures()) list.push_back(std::move(gesture));
  list.push_back({QStringLiteral("Right button"), QStringLiteral("The view's menu"), {}});
  return list;
}

QString SelectTool::invitation() const { return QStringLiteral("Press B and draw, or choose a material at the left"); }

}  // namespace ps
