// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/takeinhand.h"

#include "core/sketch/drawingplane.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/render/camera.h"
#include "ui/session/selection.h"
#include "ui/tools/leading.h"
#include "ui/tools/surface.h"
#include "ui/tools/toolbox.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numbers>
#include <utility>

namespace ps {
namespace {

constexpr double kTurnStep = std::numbers::pi / 12;

/// About which axis a key turns what is in hand, by a step: of the viewer, but for A and D.
struct TurnKey {
  char key;
  Vector3 (*axis)(const Vector3& forward);
};
Vector3 rightOf(const Vector3& forward) {
  const Vector3 right = forward.cross(Vector3(0, 1, 0));
  return right.norm() > 1e-6 ? Vector3(right.normalized()) : Vector3(1, 0, 0);
}
const TurnKey kTurns[] = {
    {'q', [](const Vector3& forward) { return Vector3(-forward); }},
    {'e', [](const Vector3& forward) { return forward; }},
    {'a', [](const Vector3&) { return Vector3(0, -1, 0); }},
    {'d', [](const Vector3&) { return Vector3(0, 1, 0); }},
    {'w', [](const Vector3& forward) { return Vector3(-rightOf(forward)); }},
    {'s', [](const Vector3& forward) { return rightOf(forward); }},
};

const TurnKey* turnOf(const QString& text) {
  const QChar key = text.size() == 1 ? text[0].toLower() : QChar();
  const auto* found = std::find_if(std::begin(kTurns), std::end(kTurns),
                                   [&](const TurnKey& one) { return key == QLatin1Char(one.key); });
  return found == std::end(kTurns) ? nullptr : found;
}

}  // namespace

/// The body that could be taken there; nullptr where there is none.
const Body* TakeInHand::bodyUnder(const Pointer& pointer) const {
  const auto hit = pointer.scene ? pickParticle(*pointer.scene, pointer.ray, pointer.section) : std::nullopt;
  return hit ? leadable(box().document(), *pointer.scene, *hit) : nullptr;
}

void TakeInHand::hover(const Pointer& pointer) {
  m_hovers = bodyUnder(pointer) != nullptr;
  if (m_hovers)
    m_select.leave();
  else
    m_select.hover(pointer);
}

bool TakeInHand::press(const Pointer& pointer) {
  const Body* body = pointer.control ? nullptr : bodyUnder(pointer);
  const auto place = body ? matterOn(pointer) : std::nullopt;
  if (!place) return m_select.press(pointer);
  Document& document = box().document();
  m_grip = Grip{*body, *place, *place, Quaternion::Identity(), pointer, *place, document.changeCount()};
  m_grip->anchor.scene = nullptr;  // its memory is not held meanwhile
  document.beginGesture();
  box().selection().selectBody(body->id);
  return true;
}

void TakeInHand::drag(const Pointer& pointer) {
  if (!m_grip) return m_select.drag(pointer);
  Grip& grip = *m_grip;
  if (pointer.shift != grip.anchor.shift) {  // on another plane from here
    grip.anchor.ray = pointer.ray;
    grip.anchor.shift = pointer.shift;
    grip.anchored = grip.at;
  }
  const DrawingPlane plane{grip.anchored, pointer.shift ? Vector3(0, 1, 0) : Vector3(-grip.anchor.forward)};
  const auto from = meet(grip.anchor.ray, plane), to = meet(pointer.ray, plane);
  if (!from || !to) return;
  grip.at = grip.anchored + (*to - *from);
  this->place();
}

/// The document's body as the hand holds it.
void TakeInHand::place() {
  Grip& grip = *m_grip;
  RigidMove move = RigidMove::about(grip.taken, grip.turn);
  move.shift += grip.at - grip.taken;
  grip.at += lead(box().document(), grip.before, move);
}

void TakeInHand::release(const Pointer& pointer) {
  if (m_grip)
    end(true);
  else
    m_select.release(pointer);
}

bool TakeInHand::cancel() {
  const bool busy = m_grip.has_value();
  end(false);
  return m_select.cancel() || busy;
}

void TakeInHand::leave() {
  m_hovers = false;
  m_select.leave();
}

void TakeInHand::end(bool keep) {
  if (!m_grip) return;
  const Grip grip = *std::exchange(m_grip, {});
  Document& document = box().document();
  // Another project may have taken the place of the one that it began in, with things of the same ids.
  if (!keep && document.had(grip.begun)) {
    Placement back;
    back.bodies.push_back(grip.before);
    back.led = true;
    document.place(std::move(back), {});
  }
  document.endGesture();
}

bool TakeInHand::takesText(const QString& text) const { return m_grip && turnOf(text); }

bool TakeInHand::type(const QString& text) {
  if (!takesText(text)) return false;
  const Vector3 axis = turnOf(text)->axis(m_grip->anchor.forward);
  m_grip->turn = (Quaternion(Eigen::AngleAxisd(kTurnStep, axis)) * m_grip->turn).normalized();
  place();
  return true;
}

ToolPicture TakeInHand::picture() const {
  ToolPicture picture = m_select.picture();
  if (m_hovers || m_grip) picture.pointer = PointerShape::Take;
  return picture;
}

QString TakeInHand::words() const {
  return m_grip ? QStringLiteral("%1 in hand").arg(nameOf(m_grip->before)) : QStringLiteral("Take a tool in hand");
}

std::vector<Gesture> TakeInHand::gestures() const {
  return {{QStringLiteral("Drag what is held in place"),
           QStringLiteral("Lead it through matter, across the view: stir, scoop, press; Add > Tool has some"),
           QStringLiteral("lead it")},
          {QStringLiteral("Shift"), QStringLiteral("Leads it along the level instead"), QStringLiteral("level")},
          {QStringLiteral("W A S D Q E"), QStringLiteral("While dragging: turn it by 15°"), QStringLiteral("turn it")},
          {QStringLiteral("Click"), QStringLiteral("Selects; with Shift one more"), QStringLiteral("select")},
          {QStringLiteral("Ctrl+Drag"), QStringLiteral("Selects what lies in the frame"), {}}};
}

}  // namespace ps
