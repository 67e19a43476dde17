// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/gizmo.h"

#include <optional>

namespace ps {

class Toolbox;

/// Moves the stroke that is chosen (Toolbox::stroke()) by the handles of a gizmo in the middle of its way. Where it is
/// let go the toolbox says so, and whoever edits strokes draws the sketch again.
class StrokeHandles {
 public:
  explicit StrokeHandles(Toolbox& box) : m_box(box) {}

  bool isOn() const;
  void hover(const Pointer& pointer);
  bool press(const Pointer& pointer);  ///< false: no handle is there
  void drag(const Pointer& pointer);
  void release();
  bool cancel();  ///< false: nothing was dragged
  bool isHeld() const { return m_grip.has_value(); }
  void leave() { m_hovered.reset(); }
  /// Adds the handles, and the stroke's way where it would go.
  void show(ToolPicture& picture) const;

 private:
  std::optional<Gizmo> gizmo() const;

  Toolbox& m_box;
  std::optional<GizmoPart> m_hovered;
  std::optional<GizmoGrip> m_grip;
  std::optional<Pointer> m_pressed;  ///< until it is dragged
  uint64_t m_begun = 0;              ///< Document::changeCount() before the drag
  GizmoDrag m_dragged;
};

}  // namespace ps
