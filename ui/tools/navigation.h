// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/mousepreset.h"
#include "ui/tools/tool.h"
#include "ui/tools/viewnavigator.h"

#include <optional>
#include <vector>

namespace ps {

/// Turns, shifts and nears a view by dragging in its picture. Not one of the toolbox: a picture has it beside the tool
/// in hand, and a headset, which moves the world by hands, has none.
class Navigation {
 public:
  using Motion = ViewMotion;
  explicit Navigation(ViewNavigator& navigator) : m_navigator(navigator) {}
  /// Places in logical pixels of the picture.
  void press(Motion motion, const QPointF& at);
  void drag(const QPointF& to);
  void release() { m_motion.reset(); }
  bool cancel();  ///< back to how it was; false: there was nothing
  std::optional<Motion> motion() const { return m_motion; }

 private:
  ViewNavigator& m_navigator;
  std::optional<Motion> m_motion;
  QPointF m_last;
  Camera m_before;
};

/// What buttons and keys do in the picture of a view while this tool is in hand, by the preset of its toolbox. What
/// moves the view has a hint, once for each motion.
std::vector<Gesture> viewGestures(const Tool& tool);

}  // namespace ps
