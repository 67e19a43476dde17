// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/ui/samplewindow.h"
#include "ui/render/camera.h"
#include "ui/tools/gizmo.h"
#include "ui/tools/tool.h"

// Where the handles of what is selected stand in the view.
namespace ps::hands {

inline Gizmo handles(MainWindow& window) {
  Tool& tool = window.tools().tool();
  tool.see(window.viewport()->snapshot().get());
  return tool.picture().gizmo->gizmo.value();
}

/// (-1, -1) where the view does not show it.
inline QPoint pixelOf(Viewport& view, const Vector3& p) {
  const auto pixel = project(view.navigator().camera(), view.width(), view.height(), p);
  return pixel ? QPoint(qRound((*pixel)[0]), qRound((*pixel)[1])) : QPoint(-1, -1);
}

/// In the middle of a handle, as the view shows it.
inline QPoint middleOf(MainWindow& window, const GizmoPart& part) {
  Viewport& view = *window.viewport();
  const Gizmo gizmo = handles(window);
  const Camera& camera = view.navigator().camera();
  const CameraFrame frame = frameOf(camera);
  const double arm = kGizmoArm * pixelSize(camera, view.height(), (gizmo.centre - frame.eye).dot(frame.forward));
  const GizmoShape shape = shapeOf(gizmo, part, arm, frame.forward);
  if (!shape.face.empty()) return pixelOf(view, 0.5 * (shape.face[0] + shape.face[2]));
  const auto& line = shape.lines[shape.lines.size() / 2];
  return pixelOf(view, 0.3 * line.first + 0.7 * line.second);
}

}  // namespace ps::hands
