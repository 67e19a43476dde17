// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/handtool.h"

#include "ui/session/selection.h"
#include "ui/tools/toolbox.h"

#include <utility>

namespace ps {
namespace {

constexpr double kReach = 2.5;  // spacings from the hand to the middle of the nearest particle

/// Unit vectors of a hand, as columns: along which it points, its own up, and across both.
Matrix3 frameOf(const HandInScene& hand) {
  const Vector3 across = hand.forward.cross(hand.up).normalized();
  Matrix3 frame;
  frame << hand.forward, across.cross(hand.forward), across;
  return frame;
}

}  // namespace

bool HandTool::take(const HandInScene& hand, const SnapshotPtr& scene, bool leavesFree) {
  if (m_grip || !hand.place || !scene) return false;
  const Body* nearest = nullptr;
  double least = kReach * m_box.spacing();
  for (size_t i = 0; i < scene->position.size(); ++i) {
    const double away = (vectorOf(scene->position[i]) - *hand.place).norm();
    if (!(away < least)) continue;
    const Body* body = leadable(m_box.document(), *scene, i);
    if (body || (leavesFree && scene->motion[i] == api::Motion::Solid)) least = away, nearest = body;
  }
  if (!nearest) return false;
  m_grip = Grip{*nearest, *hand.place, frameOf(hand), m_box.document().changeCount(), hand.seconds};
  m_box.document().beginGesture();
  m_box.selection().selectBody(m_grip->before.id);
  return true;
}

void HandTool::follow(const HandInScene& hand) {
  if (!m_grip || !hand.place) return;
  // Another project may have taken the place of the one that it was taken in, with things of the same ids.
  if (!m_box.document().had(m_grip->begun) || !m_box.document().body(m_grip->before.id)) return letGo();
  const Quaternion turn(Matrix3(frameOf(hand) * m_grip->turned.transpose()));
  RigidMove move = RigidMove::about(m_grip->taken, turn.normalized());
  move.shift += *hand.place - m_grip->taken;
  lead(m_box.document(), m_grip->before, move);
}

void HandTool::putBack() {
  if (m_grip && m_box.document().had(m_grip->begun)) lead(m_box.document(), m_grip->before, {});
  letGo();
}

void HandTool::letGo() {
  if (std::exchange(m_grip, {})) m_box.document().endGesture();
}

}  // namespace ps
