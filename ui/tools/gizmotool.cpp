// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/gizmotool.h"

#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/session/selection.h"
#include "ui/theme/numbers.h"
#include "ui/tools/aim.h"
#include "ui/tools/surface.h"
#include "ui/tools/toolbox.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace ps {
namespace {

using Kind = Gizmo::Kind;

const QString kTypeKeys = QStringLiteral("Type a number");  // a stroke that is moved takes none
constexpr double kDegree = std::numbers::pi / 180;

/// One of the three tools in words, and what its number is.
struct KindRow {
  const char *words, *title, *keys, *does;
  api::ParameterDeclaration amount;  ///< as it is typed; stored in m, degrees, or a factor
};
constexpr api::ParameterDeclaration amountIn(const char* label, const char* unit) {
  return {"amount", label, "", unit, api::ParameterKind::Number, api::Scale::Linear, 0, -1, 1, -1e4, 1e4, "", 1, 0, "",
          "",       "",    "", ""};
}
constexpr std::array<KindRow, 3> kKinds{
    {{"Move what is selected", "moving %1", "Drag an arm, a face or the middle",
      "Move what is selected along it, its matter too", amountIn("Distance", "m")},
     {"Rotate what is selected", "turning %1", "Drag a ring", "Turn what is selected about it, its matter too",
      amountIn("Angle", "°")},
     {"Scale what is selected", "scaling %1", "Drag an arm or the middle",
      "Stretch what is selected; bodies once back at the start", amountIn("Factor", "")}}};
const KindRow& rowOf(Kind kind) { return kKinds[static_cast<size_t>(kind)]; }

/// Radians inside, degrees as people see them.
double shownAmount(Kind kind, double amount) { return kind == Kind::Rotate ? amount / kDegree : amount; }
double ownAmount(Kind kind, double shown) { return kind == Kind::Rotate ? shown * kDegree : shown; }

QString valueText(Kind kind, const GizmoDrag& dragged, bool hasAmount) {
  if (!hasAmount) return formatPrefixed(dragged.way.norm(), QStringLiteral("m"));
  if (kind == Kind::Move) return formatPrefixed(dragged.amount, QStringLiteral("m"));
  if (kind == Kind::Rotate) return formatFixed(dragged.amount / kDegree, 1) + QStringLiteral(" °");
  return QStringLiteral("× ") + formatFixed(dragged.amount, 3);
}

QString pinsName(const Document& document, const BodyPins& pins) {
  const QString body = nameOf(*document.body(pins.id));
  return pins.chosen.size() == 1 ? QStringLiteral("a pin of %1").arg(body) : QStringLiteral("pins of %1").arg(body);
}

/// m, radians or a share, to whole multiples of which a drag goes.
double stepOf(const Snapping& snap, Kind kind, double spacing) {
  if (kind == Kind::Move) return snap.move > 0 ? snap.move : spacing;
  return kind == Kind::Rotate ? snap.turn * kDegree : snap.scale;
}
QString stepWords(const Snapping& snap, Kind kind) {
  if (kind == Kind::Rotate) return formatShort(snap.turn) + QStringLiteral("°");
  if (kind == Kind::Scale) return formatShort(snap.scale);
  if (!(snap.move > 0)) return QStringLiteral("the particles' spacing");
  const UnitPrefix prefix = prefixFor(snap.move);
  return formatQuantity(snap.move / prefix.factor, prefix.symbol + QStringLiteral("m"));
}

/// What they go about, of things that are turned or stretched.
QString pivotWords(Pivot pivot) {
  constexpr const char* kWords[] = {"about their common middle", "each about its own middle",
                                    "about the one selected last", "about the origin of the scene"};
  return QString::fromLatin1(kWords[static_cast<size_t>(pivot)]);
}

QString labelOf(const GizmoPart& part, Kind kind) {
  constexpr const char *kAxes[] = {"X", "Y", "Z"}, *kPlanes[] = {"YZ", "XZ", "XY"};
  if (part.kind == GizmoPart::Kind::Middle) return kind == Kind::Scale ? QStringLiteral("All") : QString();
  return QLatin1String(part.kind == GizmoPart::Kind::Plane ? kPlanes[part.axis] : kAxes[part.axis]);
}

}  // namespace

Placeable GizmoTool::selected() const {
  return placeable(box().document(), box().selection().items(), m_kind, m_matter);
}

std::optional<Gizmo> GizmoTool::gizmo(const Placeable& things) const {
  if (things.items.empty()) return std::nullopt;
  return Gizmo{m_kind, things.centre(m_kind, box().handles().pivot), things.axes, things.along};
}

void GizmoTool::see(const Snapshot* scene) { m_matter = matterOf(scene, box().selection().bodies()); }

void GizmoTool::hover(const Pointer& pointer) {
  m_matter = matterOf(pointer.scene.get(), box().selection().bodies());
  const auto shown = gizmo(selected());
  m_hovered = shown ? partAt(*shown, pointer) : std::nullopt;
  if (m_hovered)
    m_select.leave();
  else
    m_select.hover(pointer);
}

bool GizmoTool::press(const Pointer& pointer) {
  hover(pointer);
  const Placeable things = selected();
  const auto shown = gizmo(things);
  if (!shown || !m_hovered) return m_select.press(pointer);
  m_grip.emplace(*shown, *m_hovered, pointer);
  m_pivot = box().handles().pivot == Pivot::Each ? std::nullopt : std::optional(shown->centre);
  m_pressed = pointer;
  m_pressed->scene = nullptr;  // its memory is not held meanwhile
  m_before = placementOf(box().document(), things);
  m_matterBefore = m_matter;
  m_bounds.reset();
  // Pins and probes belong where they are; only bodies come to rest on something.
  if (m_kind == Kind::Move && box().handles().snap.surfaces && !m_before.bodies.empty()) {
    const MatterBoxes boxes = matterBoxesOf(pointer.scene.get());
    m_bounds = boundsOf(m_before, boxes);
    m_beside = bodiesBeside(box().document().project(), m_before, boxes);
  }
  m_dragged = m_grip->exactly(m_kind == Kind::Scale ? 1 : 0);
  m_typed.clear();
  m_wrong = false;
  m_begun = box().document().changeCount();
  box().document().beginGesture();
  return true;
}

void GizmoTool::drag(const Pointer& pointer) {
  if (!m_grip) {
    m_select.drag(pointer);
    return;
  }
  if (m_pressed && !wandered(*m_pressed, pointer)) return;
  m_pressed.reset();
  const Snapping& snap = box().handles().snap;
  const bool snaps = snap.on != (pointer.control || pointer.alt);
  GizmoDrag dragged = m_grip->drag(pointer, snaps ? stepOf(snap, m_kind, box().spacing()) : 0);
  const bool upright = m_grip->part() == GizmoPart{GizmoPart::Kind::Arm, 1};
  if (snaps && snap.surfaces && m_kind == Kind::Move && !upright) dragged.way = landing(dragged.way);
  if (m_typed.isEmpty()) apply(dragged);
}

Vector3 GizmoTool::landing(Vector3 way) const {
  if (!m_bounds) return way;
  const BodyBounds there{m_bounds->minimum + way, m_bounds->maximum + way};
  const double floor = floorHeight(box().document().project().environment);
  way.y() = heightUnder(there, m_beside, floor) - m_bounds->minimum.y();
  return way;
}

/// Not out of the scene, where nothing lives.
Vector3 GizmoTool::withinBounds(const Vector3& way) const {
  const Environment& scene = box().document().project().environment;
  const Vector3& centre = m_grip->gizmo().centre;
  Vector3 kept = way;
  for (int a = 0; a < 3; ++a) {
    if (scene.periodic[static_cast<size_t>(a)]) continue;
    const double least = std::min(scene.boundsMinimum[a], centre[a]),
                 most = std::max(scene.boundsMaximum[a], centre[a]);
    kept[a] = std::clamp(centre[a] + way[a], least, most) - centre[a];
  }
  return kept;
}

void GizmoTool::apply(GizmoDrag dragged) {
  if (m_kind == Kind::Move) {
    dragged.way = withinBounds(dragged.way);
    if (m_grip->hasAmount()) dragged.amount = dragged.way.dot(m_grip->gizmo().axes.col(m_grip->part().axis));
  }
  m_dragged = dragged;
  const size_t count = m_before.bodies.size() + m_before.emitters.size() + m_before.sinks.size() +
                       m_before.walls.size() + m_before.probes.size() + m_before.pins.size();
  const QString name = count > 1                    ? QStringLiteral("%1 things").arg(count)
                       : !m_before.bodies.empty()   ? nameOf(m_before.bodies[0])
                       : !m_before.emitters.empty() ? nameOf(m_before.emitters[0])
                       : !m_before.sinks.empty()    ? nameOf(m_before.sinks[0])
                       : !m_before.walls.empty()    ? nameOf(m_before.walls[0])
                       : !m_before.probes.empty()   ? nameOf(m_before.probes[0])
                                                    : pinsName(box().document(), m_before.pins[0]);
  const Gizmo& handles = m_grip->gizmo();
  Placement after;
  if (m_kind == Kind::Move) {
    after = shifted(m_before, dragged.way);
  } else if (m_kind == Kind::Rotate) {
    const Vector3 axis = handles.axes.col(m_grip->part().axis);
    after = turned(m_before, m_matterBefore, m_pivot, Quaternion(Eigen::AngleAxisd(dragged.amount, axis)));
  } else {
    after = stretched(m_before, dragged.factors, m_matterBefore, {m_pivot, handles.axes});
  }
  box().document().place(std::move(after), QString::fromLatin1(rowOf(m_kind).title).arg(name));
}

void GizmoTool::release(const Pointer& pointer) {
  if (m_grip) {
    enter();
    end(true);
  } else {
    m_select.release(pointer);
  }
}

bool GizmoTool::cancel() {
  const bool busy = m_grip.has_value();
  end(false);
  return m_select.cancel() || busy;
}

void GizmoTool::leave() {
  m_hovered.reset();
  m_select.leave();
}

void GizmoTool::end(bool keep) {
  if (!m_grip) return;
  // Another project may have taken the place of the one that it began in, with things of the same ids.
  if (!keep && box().document().had(m_begun)) box().document().place(m_before, {});
  m_grip.reset();
  m_pressed.reset();
  m_typed.clear();
  m_before = {};
  box().document().endGesture();
}

/// A number begins with a digit or a sign; other keys stay what they are until then.
bool GizmoTool::takesText(const QString& text) const {
  if (!m_grip || !m_grip->hasAmount() || text.isEmpty()) return false;
  const bool begins = text[0].isDigit() || QStringLiteral(".,-+*/(−").contains(text[0]);
  return !m_typed.isEmpty() || begins || text == QLatin1String(kEnter);
}

bool GizmoTool::type(const QString& text) {
  if (!takesText(text)) return false;
  if (text == QLatin1String(kEnter)) {
    if (m_wrong) return true;
    enter();
    end(true);
    return true;
  }
  if (text == QLatin1String(kErase))
    m_typed.chop(1);
  else
    m_typed += text;
  m_wrong = false;
  if (m_typed.isEmpty()) return true;
  m_pressed.reset();
  const Typed typed = parseTyped(m_typed, rowOf(m_kind).amount, shownAmount(m_kind, m_dragged.amount));
  m_wrong = !typed.problem.isEmpty();
  m_entered = ownAmount(m_kind, typed.value);
  return true;
}

/// What has been typed acts when it is whole: half a number would throw matter about.
void GizmoTool::enter() {
  if (m_grip && !m_typed.isEmpty() && !m_wrong) apply(m_grip->exactly(m_entered));
}

ToolPicture GizmoTool::picture() const {
  ToolPicture picture = m_select.picture();
  const Placeable things = selected();
  GizmoPicture shown;
  shown.note = things.note;
  const auto any = [&](OutlineKind kind) {
    return std::any_of(things.items.begin(), things.items.end(),
                       [&](const auto& item) { return item.first.kind == kind; });
  };
  const auto wait = [&](const QString& what) {
    if (!shown.note.isEmpty()) shown.note.prepend(QStringLiteral(". "));
    shown.note.prepend(what);
  };
  if (any(OutlineKind::Pin)) wait(QStringLiteral("Pins act once back at the start"));
  if (m_kind == Kind::Scale && any(OutlineKind::Body))
    wait(QStringLiteral("Sizes of bodies act once back at the start"));
  shown.gizmo = gizmo(things);
  shown.hovered = m_hovered;
  if (m_grip) {
    Gizmo held = m_grip->gizmo();
    if (m_kind == Kind::Move) held.centre += m_dragged.way;
    shown.gizmo = held;
    shown.active = m_grip->part();
    shown.label = labelOf(m_grip->part(), m_kind);
    shown.typing = !m_typed.isEmpty();
    shown.wrong = m_wrong;
    shown.value = shown.typing ? m_typed : valueText(m_kind, m_dragged, m_grip->hasAmount());
  }
  if (m_hovered || m_grip) picture.pointer = PointerShape::Take;
  picture.gizmo = std::move(shown);
  return picture;
}

QString GizmoTool::words() const {
  QString words = QString::fromLatin1(rowOf(m_kind).words);
  const Pivot pivot = box().handles().pivot;
  if (m_kind != Kind::Move && pivot != Pivot::Middle) words += QStringLiteral(", ") + pivotWords(pivot);
  if (!m_grip) return words;
  const GizmoPicture shown = *picture().gizmo;
  return QStringLiteral("%1, %2 %3").arg(words, shown.label, shown.value);
}

std::vector<Gesture> GizmoTool::gestures() const {
  const KindRow& row = rowOf(m_kind);
  const Snapping& snap = box().handles().snap;
  const QString pivot =
      m_kind == Kind::Move
          ? QStringLiteral("Chooses where the handles stand: in the middle, or on the last selected")
          : QStringLiteral("Chooses what that goes about; now %1").arg(pivotWords(box().handles().pivot));
  return {{QString::fromLatin1(row.keys), QString::fromUtf8(row.does), {}},
          {kTypeKeys, QStringLiteral("While dragging: just so far; with a unit, “25 mm”"),
           QStringLiteral("while dragging")},
          {QStringLiteral("Ctrl or Alt"),
           (snap.on ? QStringLiteral("Goes freely, not by steps of %1; Shift is ten times finer")
                    : QStringLiteral("Goes by steps of %1; Shift is ten times finer"))
               .arg(stepWords(snap, m_kind)),
           snap.on ? QStringLiteral("freely") : QStringLiteral("by steps")},
          {QStringLiteral("Click"), QStringLiteral("Selects; with Shift one more"), QStringLiteral("select")},
          {QString::fromLatin1(kSnapKey), QStringLiteral("Goes by steps all the time, or no longer"), {}},
          {QString::fromLatin1(kPivotKey), pivot, {}}};
}

void MoveTool::hover(const Pointer& pointer) {
  if (!m_stroke.isOn()) return GizmoTool::hover(pointer);
  m_stroke.hover(pointer);
}

bool MoveTool::press(const Pointer& pointer) {
  return m_stroke.isOn() ? m_stroke.press(pointer) : GizmoTool::press(pointer);
}

void MoveTool::drag(const Pointer& pointer) {
  if (!m_stroke.isHeld()) return GizmoTool::drag(pointer);
  m_stroke.drag(pointer);
}

void MoveTool::release(const Pointer& pointer) {
  if (!m_stroke.isHeld()) return GizmoTool::release(pointer);
  m_stroke.release();
}

bool MoveTool::cancel() {
  const bool held = m_stroke.cancel();
  return GizmoTool::cancel() || held;
}

void MoveTool::leave() {
  m_stroke.leave();
  GizmoTool::leave();
}

ToolPicture MoveTool::picture() const {
  if (!m_stroke.isOn()) return GizmoTool::picture();
  ToolPicture picture;
  m_stroke.show(picture);
  return picture;
}

QString MoveTool::words() const {
  return m_stroke.isOn() ? QStringLiteral("Move the stroke that is chosen") : GizmoTool::words();
}

std::vector<Gesture> MoveTool::gestures() const {
  std::vector<Gesture> list = GizmoTool::gestures();
  if (m_stroke.isOn()) std::erase_if(list, [](const Gesture& gesture) { return gesture.keys == kTypeKeys; });
  return list;
}

}  // namespace ps
