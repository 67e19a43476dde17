// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/drawtool.h"

#include "core/plugin_host/registry.h"
#include "core/sketch/nearmatter.h"
#include "ui/document/document.h"
#include "ui/render/camera.h"
#include "ui/session/selection.h"
#include "ui/theme/theme.h"
#include "ui/theme/units.h"
#include "ui/tools/surface.h"
#include "ui/tools/toolbox.h"

#include <algorithm>
#include <tuple>

namespace ps {
namespace {
constexpr double kFarthest = 100;  // m from the pointer at which a stroke goes on

/// The mark of a place that the pointer has snapped to: two lines in the plane, beyond the brush.
Wire crossAt(const Vector3& place, const Vector3& normal, double radius) {
  const Matrix3 axes = strokeAxes(normal);
  Wire wire;
  wire.selected = true;
  for (const int a : {0, 2}) {
    const Vector3 arm = 1.5 * radius * Vector3(axes.col(a));
    wire.lines.emplace_back(place - arm, place + arm);
  }
  return wire;
}
}  // namespace

DrawTool::DrawTool(Toolbox& box, bool erases)
    : Tool(box), m_erases(erases), m_stroke(box), m_touch(box, [this](const QString& why) { refuse(why); }) {
  m_stroke.onTrouble([this] { endStroke(); });
  m_stroke.onEnd([this] { endStroke(); });
}

/// A pen that is rolled about itself turns what it draws about the normal of what it draws on, and then it leans.
Held DrawTool::heldBy(const Pointer& pointer) const {
  const Matrix3 axes = strokeAxes(m_stroke.active() ? m_stroke.up() : m_plane.normal);
  const Matrix3 twisted = turnMatrix(pointer.twist * Vector3(axes.col(1)));
  return {pointer.pressure, turnBetween(axes, turnMatrix(pointer.lean) * twisted * axes)};
}

bool DrawTool::touches() const { return box().touchesMatter(); }
bool DrawTool::meetsMatter() const { return touches() || box().reworks(); }

void DrawTool::hover(const Pointer& pointer) {
  if ((m_stroke.active() && !m_stroke.ending()) || m_touch.active()) return;
  m_cursor.reset();
  m_snapped.clear();
  m_lift = {0, 0, 0};
  const Environment& environment = box().document().project().environment;
  BrushCursor cursor;
  cursor.erase = !touches() && erases(pointer);
  const bool draws = !cursor.erase && !meetsMatter();
  if (const auto plane = planeFor(box().brush(), pointer); plane && draws) {
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
  if (draws && box().brush().drawOn == DrawOn::Surface) {
    // A brush stands on the surface instead of half inside it.
    m_lift = m_plane.normal.cwiseProduct(cursor.extent);
    cursor.centre += m_lift;
    m_plane.point = cursor.centre;
  }
  if (draws) {
    if (const auto place = snapped(pointer, cursor.centre)) m_plane.point = cursor.centre = *place;
    if (!m_snapped.isEmpty() && box().brush().snapTo != SnapTo::Grid) m_lift = {0, 0, 0};
  }
  cursor.floor = heightBelow(pointer, cursor.centre, environment);
  m_cursor = cursor;
}

/// A stroke is met where it runs, whatever the plane; the crossing of a grid stands on it.
std::optional<Vector3> DrawTool::snapped(const Pointer& pointer, const Vector3& place) {
  const BrushSettings& brush = box().brush();
  const Project& project = box().document().project();
  m_snapped.clear();
  if (brush.snapTo == SnapTo::Nothing || pointer.shift) return std::nullopt;
  if (brush.snapTo == SnapTo::Grid) {
    m_snapped = QStringLiteral("on the grid");
    return onGrid(brush, project.environment, m_plane, place);
  }
  const auto snap = strokeSnap(brush, project, pointer.ray);
  if (!snap) return std::nullopt;
  m_snapped = snap->end ? QStringLiteral("at the end of a stroke") : QStringLiteral("on a stroke");
  return snap->place;
}

bool DrawTool::press(const Pointer& pointer) {
  if (pointer.alt) return false;  // see click()
  if (m_stroke.ending()) {
    box().refuse(QStringLiteral("Nothing was drawn."), QStringLiteral("It is still being filled. Esc stops that."));
    return true;
  }
  hover(pointer);
  if (!m_cursor) return true;  // nothing to draw on, and nothing to turn
  m_began = pointer.seconds;
  if (touches()) {
    beginTouch(pointer);
    return true;
  }
  m_before = m_cursor->erase ? pointer.scene : nullptr;
  m_straight.stop();
  m_trail.start(m_cursor->centre);
  static const Snapshot kNothing;
  const QString problem = m_stroke.begin(m_cursor->erase, pointer.scene ? *pointer.scene : kNothing, m_cursor->centre,
                                         m_plane.normal, heldBy(pointer));
  if (problem.isEmpty()) {
    const QString flows = m_stroke.whatFlows();
    if (!flows.isEmpty() || m_said) box().refuse(QStringLiteral("What is drawn flows."), flows);
    m_said = !flows.isEmpty();  // what was said before is over
    return true;
  }
  m_stroke.cancel();
  refuse(problem);
  return true;
}

void DrawTool::beginTouch(const Pointer& pointer) {
  const QString problem = m_touch.begin(box().brush(), erases(pointer), m_cursor->centre, m_plane.normal,
                                        pointer.ray.direction.normalized(), heldBy(pointer));
  if (!problem.isEmpty()) return refuse(problem);
  m_lift = {0, 0, 0};
  m_faces = false;
  faceViewer(pointer);
  m_hand = pointer;
  m_hand.scene = nullptr;
}

/// Who heats or cools wants to see how far it is: by the particle that is nearest to the hand, where that reaches it.
void DrawTool::feel(const Snapshot* now) {
  m_felt.clear();
  const PluginRegistry* plugins = box().document().plugins();
  if (!now || !m_cursor || !plugins || !touches() || !hasPower(*plugins, box().brush().shape)) return;
  std::optional<size_t> nearest;
  double least = box().brush().radius;
  for (size_t i = 0; i < now->position.size(); ++i) {
    const double away =
        (imageNear(now->period, vectorOf(now->position[i]), m_cursor->centre) - m_cursor->centre).norm();
    if (away < least) least = away, nearest = i;
  }
  if (nearest) {
    m_felt = temperatureText(static_cast<double>(now->temperature[*nearest]), 1) + QStringLiteral("  ") +
             phaseName(now->phase[*nearest]);
  }
}

/// Matter melts, flows and is carried away under a pointer that stays: the hand follows what is there.
void DrawTool::see(const Snapshot* now) {
  feel(now);
  if (!m_touch.active() || m_touch.holds() || !m_cursor || !now) return;
  Pointer looking = m_hand;
  looking.scene = SnapshotPtr(SnapshotPtr(), now);  // only while this lasts
  const auto surface = surfaceUnder(looking, box().document().project().environment);
  if (!surface || (surface->point - m_cursor->centre).norm() < box().spacing() / 4) return;
  const auto follow = [this, point = surface->point] {
    if (!m_touch.active()) return;
    m_touch.lift();
    touchAt(point);
  };
  QMetaObject::invokeMethod(&box(), follow, Qt::QueuedConnection);  // the view is being painted
}

/// What is held goes across the view, from where it was taken.
void DrawTool::faceViewer(const Pointer& pointer) {
  if (m_faces || !m_touch.holds()) return;
  m_faces = true;
  m_plane = {m_cursor->centre, -pointer.forward};
}

void DrawTool::dragTouch(const Pointer& pointer) {
  faceViewer(pointer);
  std::optional<Vector3> point;
  if (m_touch.holds()) {
    point = placeOf(pointer);
  } else if (const auto surface = surfaceUnder(pointer, box().document().project().environment)) {
    point = surface->point;
    if (!isJoined(*point, pointer)) m_touch.lift();
  }
  m_hand = pointer;
  m_hand.scene = nullptr;
  if (point) touchAt(*point);
}

void DrawTool::touchAt(const Vector3& point) {
  m_cursor->centre = point;
  m_cursor->pressure = m_hand.pressure;
  const QString problem = m_touch.move(point, m_hand.seconds - m_began, heldBy(m_hand));
  if (!problem.isEmpty()) refuse(problem);
}

/// Along a ray that misses the stroke's plane, or meets it far outside of the scene, nothing is drawn.
std::optional<Vector3> DrawTool::placeOf(const Pointer& pointer) const {
  // What stands on a surface does so above the place that is pointed at, as where it began: it would leap aside else.
  auto point = meet(pointer.ray, {m_plane.point - m_lift, m_plane.normal}, kFarthest);
  if (!point) return point;
  *point += m_lift;
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
  if (m_touch.active() && m_cursor) return dragTouch(pointer);
  if (!m_stroke.active() || m_stroke.ending() || !m_cursor) return;
  if (m_cursor->erase || box().reworks()) {
    if (const auto matter = matterUnder(pointer)) {
      if (!isJoined(*matter, pointer)) m_stroke.lift();
      m_plane = drawingPlaneFor(*matter, pointer.forward);
      m_lift = {0, 0, 0};
      m_straight.stop();  // the guides go on from where it leaves the matter
      m_trail.start(*matter);
      draw(*matter, pointer);
      return;
    }
  }
  const auto point = placeOf(pointer);
  if (!point) return;
  const bool snaps = !m_cursor->erase && !meetsMatter();
  if (const auto place = snaps ? snapped(pointer, *point) : std::nullopt) {
    m_straight.stop();
    m_trail.start(*place);
    draw(*place, pointer);
    return;
  }
  if (pointer.shift != m_straight.active()) {
    pointer.shift ? m_straight.start(m_cursor->centre) : m_straight.stop();
    m_trail.start(m_cursor->centre);
  }
  const Vector3 straight = m_straight.place(*point, m_plane, box().spacing());
  draw(m_trail.follow(straight, box().brush().steady), pointer);
}

void DrawTool::draw(const Vector3& point, const Pointer& pointer) {
  m_cursor->centre = point;
  m_cursor->floor = heightBelow(pointer, point, box().document().project().environment);
  m_cursor->pressure = pointer.pressure;
  m_stroke.move(point, pointer.seconds - m_began, heldBy(pointer));
}

/// What goes wrong ends it where it came to.
void DrawTool::endStroke() {
  if (const QString problem = m_stroke.finish(); !problem.isEmpty()) refuse(problem, m_stroke.kept());
}

void DrawTool::release(const Pointer&) {
  m_before.reset();
  if (const QString problem = m_touch.finish(); !problem.isEmpty()) refuse(problem);
  if (!m_stroke.ending() && m_stroke.end()) endStroke();
}

/// With Alt the matter that is there says what is drawn from now on, and its body what is stamped.
void DrawTool::click(const Pointer& pointer) {
  if (!pointer.alt || !pointer.scene) return;
  const Snapshot& scene = *pointer.scene;
  const auto hit = pickParticle(scene, pointer.ray, pointer.section);
  if (hit && box().stampsShape() && scene.bodyIds && scene.body[*hit] < scene.bodyIds->size())
    box().selection().selectBody((*scene.bodyIds)[scene.body[*hit]]);
  if (hit && scene.material[*hit] < scene.materialIds.size())
    box().selection().pickMaterial(scene.materialIds[scene.material[*hit]]);
}

bool DrawTool::cancel() {
  const bool busy = m_stroke.active() || m_touch.active();
  m_before.reset();
  m_stroke.cancel();
  m_touch.cancel();
  return busy;
}

void DrawTool::refuse(const QString& why, bool kept) {
  m_said = !why.isEmpty();
  const bool leaves = meetsMatter() || m_stroke.erasedNothing();
  box().refuse(kept     ? QStringLiteral("The stroke ends here.")
               : leaves ? QStringLiteral("The matter stays as it is.")
                        : QStringLiteral("Nothing was drawn."),
               why);
}

QString DrawTool::brushLabel() const {
  const PluginRegistry* plugins = box().document().plugins();
  const api::BrushPlugin* plugin = plugins ? plugins->brush(box().brush().shape) : nullptr;
  return plugin ? QString::fromUtf8(plugin->label()) : QString::fromStdString(box().brush().shape);
}

ToolPicture DrawTool::picture() const {
  ToolPicture picture;
  picture.pointer = PointerShape::Hidden;  // the brush itself is the pointer
  picture.cursor = m_cursor;
  if (!picture.cursor) return picture;
  std::tie(picture.cursor->extent, picture.cursor->box) = box().stamp(m_plane.normal);
  picture.cursor->form = box().form(m_plane.normal);
  if (!m_felt.isEmpty()) picture.tag = SceneTag{m_cursor->centre, {}, m_felt};
  if (!m_snapped.isEmpty()) picture.wires.push_back(crossAt(m_cursor->centre, m_plane.normal, box().brush().radius));
  return picture;
}

QString DrawTool::words() const {
  const BrushSettings& brush = box().brush();
  const Document& document = box().document();
  QStringList parts{m_erases ? QStringLiteral("Eraser") : QStringLiteral("Brush"), brushLabel().toLower(),
                    box().brushSizeName().toLower() + QLatin1Char(' ') + box().brushSizeText()};
  for (const SceneMaterial& material : document.project().materials) {
    if (!m_erases && !touches() && !box().smooths() && !box().colours() && material.id == brush.material)
      parts << QString::fromStdString(material.label);
  }
  if (box().stampsShape() && !box().shapeName().empty())
    parts << QStringLiteral("copies of ") + QString::fromStdString(box().shapeName());
  if (m_cursor && !m_snapped.isEmpty()) parts << m_snapped;
  if (m_cursor && !m_felt.isEmpty()) parts << m_felt;
  if (m_cursor) parts << QStringLiteral("height ") + lengthText(std::max(0.0, m_cursor->centre[1] - m_cursor->floor));
  return parts.join(QStringLiteral(", "));
}

std::vector<Gesture> DrawTool::gestures() const {
  std::vector<Gesture> list;
  if (touches()) {
    list = {{QStringLiteral("Drag"), brushLabel(), brushLabel().toLower()},
            {QStringLiteral("Ctrl+Drag"), QStringLiteral("The opposite"), QStringLiteral("the opposite")}};
  } else {
    const QString reworks = box().smooths() ? QStringLiteral("smooths") : QStringLiteral("paints");
    const Gesture draw = box().reworks() ? Gesture{{}, brushLabel(), reworks}
                                         : Gesture{{}, QStringLiteral("Draw"), QStringLiteral("draws")};
    const Gesture erase{{}, QStringLiteral("Erase"), QStringLiteral("erases")};
    list = {m_erases ? erase : draw, m_erases ? draw : erase};
    list[0].keys = QStringLiteral("Drag");
    list[1].keys = QStringLiteral("Ctrl+Drag");
    if (!m_erases && !box().reworks())
      list.push_back({QStringLiteral("Shift"), QStringLiteral("Draws straight on"), QStringLiteral("straight")});
    list.push_back({QStringLiteral("Alt+Click"),
                    box().stampsShape() ? QStringLiteral("Takes the shape and the material of what is there")
                                        : QStringLiteral("Takes the material of what is there"),
                    box().stampsShape() ? QStringLiteral("takes a shape") : QString()});
  }
  list.push_back({sizeDrag(box().mouse()).text(), QStringLiteral("Smaller and larger, as do [ and ]"), {}});
  return list;
}

QString DrawTool::invitation() const {
  return m_erases || meetsMatter() || m_stroke.active() ? QString() : QStringLiteral("Draw with the left button");
}

}  // namespace ps
