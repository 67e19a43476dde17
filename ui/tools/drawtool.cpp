// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/drawtool.h"

#include "core/plugin_host/registry.h"
#include "ui/document/document.h"
#include "ui/tools/surface.h"
#include "ui/tools/toolbox.h"

#include <algorithm>
#include <tuple>

namespace ps {
namespace {
constexpr double kFarthest = 100;  // m from the pointer at which a stroke goes on
}

DrawTool::DrawTool(Toolbox& box, bool erases) : Tool(box), m_erases(erases), m_stroke(box) {}

void DrawTool::hover(const Pointer& pointer) {
  if (m_stroke.active()) return;
  m_cursor.reset();
  const Environment& environment = box().document().project().environment;
  const auto surface = surfaceUnder(pointer, environment);
  if (!surface) return;
  BrushCursor cursor;
  std::tie(cursor.extent, cursor.box) = box().stamp();
  cursor.erase = m_erases != pointer.control;
  cursor.floor = floorHeight(environment);
  m_plane = drawingPlaneFor(surface->point, pointer.forward);
  cursor.centre = surface->point;
  if (!cursor.erase) {
    // A brush stands on the surface instead of half inside it.
    cursor.centre += m_plane.normal.cwiseProduct(cursor.extent);
    m_plane.point = cursor.centre;
  }
  m_cursor = cursor;
}

bool DrawTool::press(const Pointer& pointer) {
  hover(pointer);
  if (!m_cursor) return true;  // nothing to draw on, and nothing to turn
  m_began = pointer.seconds;
  static const Snapshot kNothing;
  const QString problem =
      m_stroke.begin(m_cursor->erase, pointer.scene ? *pointer.scene : kNothing, m_cursor->centre, pointer.pressure);
  if (problem.isEmpty()) return true;
  m_stroke.cancel();
  refuse(problem);
  return true;
}

/// Along a ray that misses the stroke's plane, or meets it far outside of the scene, nothing is drawn.
std::optional<Vector3> DrawTool::placeOf(const Pointer& pointer) const {
  const auto point = meet(pointer.ray, m_plane, kFarthest);
  if (!point) return point;
  const Environment& e = box().document().project().environment;
  const double radius = box().brush().radius;
  const bool outside =
      ((*point - e.boundsMinimum).array() < -radius).any() || ((*point - e.boundsMaximum).array() > radius).any();
  return outside ? std::nullopt : point;
}

void DrawTool::drag(const Pointer& pointer) {
  if (!m_stroke.active()) return;
  const auto point = placeOf(pointer);
  if (!point) return;
  if (m_cursor) m_cursor->centre = *point;
  const QString problem = m_stroke.move(*point, pointer.seconds - m_began, pointer.pressure);
  if (problem.isEmpty()) return;
  m_stroke.finish();  // as far as it came
  refuse(problem);
}

void DrawTool::release(const Pointer&) {
  if (const QString problem = m_stroke.finish(); !problem.isEmpty()) refuse(problem);
}

bool DrawTool::cancel() {
  const bool busy = m_stroke.active();
  m_stroke.cancel();
  return busy;
}

void DrawTool::refuse(const QString& why) { box().refuse(QStringLiteral("Nothing was drawn."), why); }

ToolPicture DrawTool::picture() const {
  ToolPicture picture;
  picture.pointer = PointerShape::Hidden;  // the brush itself is the pointer
  picture.cursor = m_cursor;
  if (picture.cursor) std::tie(picture.cursor->extent, picture.cursor->box) = box().stamp();
  return picture;
}

QString DrawTool::words() const {
  const BrushSettings& brush = box().brush();
  const Document& document = box().document();
  const api::BrushPlugin* plugin = document.plugins() ? document.plugins()->brush(brush.shape) : nullptr;
  QStringList parts{m_erases ? QStringLiteral("Eraser") : QStringLiteral("Brush"),
                    plugin ? QString::fromUtf8(plugin->label()).toLower() : QString::fromStdString(brush.shape),
                    QStringLiteral("radius ") + lengthText(brush.radius)};
  for (const SceneMaterial& material : document.project().materials) {
    if (!m_erases && material.id == brush.material) parts << QString::fromStdString(material.label);
  }
  if (m_cursor) parts << QStringLiteral("height ") + lengthText(std::max(0.0, m_cursor->centre[1] - m_cursor->floor));
  return parts.join(QStringLiteral(", "));
}

std::vector<Gesture> DrawTool::gestures() const {
  const Gesture draw{{}, QStringLiteral("Draw"), QStringLiteral("draws")};
  const Gesture erase{{}, QStringLiteral("Erase"), QStringLiteral("erases")};
  std::vector<Gesture> list{m_erases ? erase : draw, m_erases ? draw : erase};
  list[0].keys = QStringLiteral("Drag");
  list[1].keys = QStringLiteral("Ctrl+Drag");
  return list;
}

QString DrawTool::invitation() const {
  return m_erases || m_stroke.active() ? QString() : QStringLiteral("Draw with the left button");
}

}  // namespace ps
