// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/handbrush.h"

#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"

namespace ps {
namespace {

constexpr double kPressed = 0.12, kReleased = 0.06;  // of the trigger's way, apart so that a tremor is no second stroke
constexpr double kAlong = 1e-6;                      // sine of the angle between unit vectors that are one
constexpr double kWay = 0.125;                       // spacings that a hand goes before a stroke hears of it

}  // namespace

void HandBrush::follow(const HandInScene& hand, const SnapshotPtr& scene) {
  if (m_stroke.troubled()) endStroke();
  if (!hand.place || hand.pressure < (m_pressed ? kReleased : kPressed)) {
    m_pressed = false;
    end();
  } else if (m_pressed) {
    move(hand);
  } else {
    m_pressed = true;
    begin(hand, scene);
  }
}

void HandBrush::begin(const HandInScene& hand, const SnapshotPtr& scene) {
  static const Snapshot kNothing;
  const bool opposite = hand.opposite != (m_box.active() == kEraseTool);
  m_began = hand.seconds;
  m_last = hand;
  m_up = hand.up;
  if (m_stroke.ending()) return say(QStringLiteral("It is still being filled."));
  const QString problem = !m_always.empty() || m_box.touchesMatter()
                              ? m_touch.begin(brush(), opposite, *hand.place, hand.up, hand.forward, heldBy(hand))
                              : m_stroke.begin(opposite, scene ? *scene : kNothing, *hand.place, hand.up, heldBy(hand));
  if (active()) ++m_begun;
  if (!problem.isEmpty()) {
    m_stroke.cancel();
    say(problem);
  } else if (const QString flows = m_stroke.whatFlows(); !flows.isEmpty()) {
    m_box.refuse(QStringLiteral("What is drawn flows."), flows);
  }
}

BrushSettings HandBrush::brush() const {
  BrushSettings brush = m_box.brush();
  if (m_always.empty()) return brush;
  brush.shape = m_always;
  brush.symmetry = {};
  return brush;
}

/// A level hand that points away along z is turned by nothing.
Held HandBrush::heldBy(const HandInScene& hand) const {
  const Vector3 across = hand.up.cross(-hand.forward);
  if (!(across.norm() > kAlong)) return hand.pressure;
  Matrix3 pose;
  pose.col(0) = across.normalized();
  pose.col(1) = hand.up.normalized();
  pose.col(2) = Vector3(pose.col(0)).cross(Vector3(pose.col(1)));
  return {hand.pressure, turnBetween(strokeAxes(m_up), pose)};
}

/// A hand that touches matter is where it is, and as fast; a stroke keeps its way, which grows by what it is told.
void HandBrush::move(const HandInScene& hand) {
  const double seconds = hand.seconds - m_began;
  if (m_stroke.ending()) return;
  if (m_touch.active()) {
    say(m_touch.move(*hand.place, seconds, heldBy(hand)));
  } else if (m_stroke.active() && (*hand.place - *m_last.place).norm() >= kWay * m_box.spacing()) {
    m_last = hand;
    m_stroke.move(*hand.place, seconds, heldBy(hand));
  }
}

void HandBrush::end() {
  say(m_touch.finish());
  if (!m_stroke.ending() && m_stroke.end()) endStroke();
}

void HandBrush::finish() {
  say(m_touch.finish());
  endStroke();
}

void HandBrush::endStroke() {
  m_finishes = true;
  const QString problem = m_stroke.finish();
  m_finishes = false;
  say(problem, m_stroke.kept());
}

void HandBrush::cancel() {
  m_stroke.cancel();
  m_touch.cancel();
}

void HandBrush::say(const QString& problem, bool kept) {
  if (problem.isEmpty()) return;
  if (kept) return m_box.refuse(QStringLiteral("The stroke ends here."), problem);
  const bool draws = m_always.empty() && !m_box.touchesMatter() && !m_box.reworks() && !m_stroke.erasedNothing();
  m_box.refuse(draws ? QStringLiteral("Nothing was drawn.") : QStringLiteral("The matter stays as it is."), problem);
}

}  // namespace ps
