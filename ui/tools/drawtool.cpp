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
  BrushCursor cursor;
  cursor.erase = m_erases != pointer.control;
  cursor.floor = floorHeight(environment);
  if (const auto plane = planeFor(box().brush(), pointer); plane && !cursor.erase) {
    m_plane = *plane;
    const auto point = placeOf(pointer);
    if (!point) return;
    cursor.centre = *point;
  } else {
    const auto surface = surfaceUnder(pointer, environment);
    if (!surface) return;
    m_plane = drawingPlaneFor(surface->point, pointer.forward);
    cursor.centre = surface->point;
  }
  std::tie(cursor.extent, cursor.box) = box().stamp(m_plane.normal);
  if (!cursor.erase && box().brush().drawOn == DrawOn::Surface) {
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
  m_before = m_cursor->erase ? pointer.scene : nullptr;
  m_straight.stop();
  m_trail.start(m_cursor->centre);
  static const Snapshot kNothing;
  const QString problem = m_stroke.begin(m_cursor->erase, pointer.scene ? *pointer.scene : kNothing, m_cursor->centre,
                                         m_plane.normal, pointer.pressure);
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

/// The nearer one of what is there and of what was there when the stroke began: what has come since is taken too, and a
/// hole that the stroke has made counts as closed.
std::optional<Vector3> DrawTool::matterUnder(const Pointer& pointer) const {
  std::optional<Vector3> nearest;
  for (const SnapshotPtr& scene : {m_before, pointer.scene}) {
    Pointer looking = pointer;
    looking.scene = scene;
    const auto point = matterOn(looking);
    const auto away = [&](const Vector3& p) { return (p - pointer.ray.origin).squaredNorm(); };
    if (point && (!nearest || away(*point) < away(*nearest))) nearest = point;
  }
  return nearest;
}

/// Whether the way from the last place leads along what is seen: not where one thing hides another one.
bool DrawTool::isJoined(const Vector3& point, const Pointer& pointer) const {
  const Vector3 way = point - m_cursor->centre, look = pointer.ray.direction;
  const double depth = std::abs(way.dot(look)), aside = (way - way.dot(look) * look).norm();
  return depth <= 2 * box().brush().radius + 2 * aside;
}

void DrawTool::drag(const Pointer& pointer) {
  if (!m_stroke.active() || !m_cursor) return;
  if (m_cursor->erase) {
    if (const auto matter = matterUnder(pointer)) {
      if (!isJoined(*matter, pointer)) {
        if (const QString problem = m_stroke.lift(); !problem.isEmpty()) return endAsItIs(problem);
      }
      m_plane = drawingPlaneFor(*matter, pointer.forward);
      m_straight.stop();  // the guides go on from where it leaves the matter
      m_trail.start(*matter);
      draw(*matter, pointer);
      return;
    }
  }
  const auto point = placeOf(pointer);
  if (!point) return;
  if (pointer.shift != m_straight.active()) {
    pointer.shift ? m_straight.start(m_cursor->centre) : m_straight.stop();
    m_trail.start(m_cursor->centre);
  }
  const Vector3 straight = m_straight.place(*point, m_plane, box().spacing());
  draw(m_trail.follow(straight, box().brush().steady), pointer);
}

void DrawTool::draw(const Vector3& point, const Pointer& pointer) {
  m_cursor->centre = point;
  const QString problem = m_stroke.move(point, pointer.seconds - m_began, pointer.pressure);
  if (!problem.isEmpty()) endAsItIs(problem);
}

/// What went wrong ends the stroke where it came to.
void DrawTool::endAsItIs(const QString& problem) {
  m_stroke.finish();
  refuse(problem);
}

void DrawTool::release(const Pointer&) {
  m_before.reset();
  if (const QString problem = m_stroke.finish(); !problem.isEmpty()) refuse(problem);
}

bool DrawTool::cancel() {
  const bool busy = m_stroke.active();
  m_before.reset();
  m_stroke.cancel();
  return busy;
}

void DrawTool::refuse(const QString& why) { box().refuse(QStringLiteral("Nothing was drawn."), why); }

ToolPicture DrawTool::picture() const {
  ToolPicture picture;
  picture.pointer = PointerShape::Hidden;  // the brush itself is the pointer
  picture.cursor = m_cursor;
  if (picture.cursor) std::tie(picture.cursor->extent, picture.cursor->box) = box().stamp(m_plane.normal);
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
  if (!m_erases)
    list.push_back({QStringLiteral("Shift"), QStringLiteral("Draws straight on"), QStringLiteral("straight")});
  return list;
}

QString DrawTool::invitation() const {
  return m_erases || m_stroke.active() ? QString() : QStringLiteral("Draw with the left button");
}

}  // namespace ps
