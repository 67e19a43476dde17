// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/navigation.h"

#include "ui/tools/toolbox.h"

#include <set>

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
  struct Words {
    const char *does, *hint;
  };
  static constexpr Words kWords[] = {
      {"Turn the view", "orbit"}, {"Move the view sideways", "pan"}, {"Nearer or farther", ""}};
  std::vector<Gesture> list;
  const auto add = [&](const QString& keys, const char* does, const char* hint = "") {
    list.push_back({keys, QString::fromUtf8(does), QString::fromUtf8(hint)});
  };
  const MousePreset preset = tool.box().mouse();
  const bool draws = !tool.turnsView();
  std::set<ViewMotion> said;
  for (const MouseBinding& binding : bindings(preset, draws)) {
    const Words& words = kWords[static_cast<size_t>(binding.motion)];
    add(binding.text(), words.does, said.insert(binding.motion).second ? words.hint : "");
  }
  add(QStringLiteral("Wheel"), "Nearer to what is under the pointer, or farther", "zoom");
  const bool free = !draws && !bindingFor(preset, draws, Qt::LeftButton, {});
  if (free) add(QStringLiteral("Drag"), "Select what lies in the frame");
  add(QStringLiteral("Right button"), "The view's menu");
  add(QStringLiteral("Drag an end of the legend"), "Set the range of colours; a double click fits it again");
  add(QStringLiteral("Esc"), tool.turnsView() ? "Take back the drag, then back to selecting, then select nothing"
                                              : "Give up the drag or stroke, then back to selecting");
  add(QStringLiteral("Tab"), "To sketching and back; Shift+Tab leaves the view");
  return list;
}

}  // namespace ps
