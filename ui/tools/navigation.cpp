// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/navigation.h"

namespace ps {

void Navigation::press(Motion motion, const QPointF& at) {
  m_motion = motion;
  m_last = at;
  m_before = m_navigator.camera();
}

void Navigation::drag(const QPointF& to) {
  if (!m_motion) return;
  const QPointF step = to - m_last;
  m_last = to;
  switch (*m_motion) {
    case Motion::Orbit:
      m_navigator.orbitBy(step);
      break;
    case Motion::Pan:
      m_navigator.panBy(step);
      break;
    case Motion::Dolly:
      m_navigator.dollyBy(step.y());
      break;
  }
}

bool Navigation::cancel() {
  if (!m_motion) return false;
  m_motion.reset();
  m_navigator.restore(m_before);
  return true;
}

std::vector<Gesture> viewGestures(const Tool& tool) {
  std::vector<Gesture> list;
  const auto add = [&](const char* keys, const char* does) {
    list.push_back({QString::fromUtf8(keys), QString::fromUtf8(does), {}});
  };
  if (!tool.turnsView()) {
    add("Alt+Drag", "Turn the view; the middle button does too");
    add("Shift+Middle button", "Move the view sideways");
    add("Wheel", "Nearer to what is under the pointer, or farther");
  }
  add("Right-drag", "Nearer or farther");
  add("Drag an end of the legend", "Set the range of colours; a double click fits it again");
  add("Esc",
      tool.turnsView() ? "Take back what is being dragged" : "Give up the drag or stroke, then back to selecting");
  add("Tab", "To sketching and back; Shift+Tab leaves the view");
  return list;
}

}  // namespace ps
