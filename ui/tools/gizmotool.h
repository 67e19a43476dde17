// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/arrange.h"
#include "ui/tools/gizmo.h"
#include "ui/tools/placing.h"
#include "ui/tools/selecttool.h"
#include "ui/tools/strokehandles.h"

namespace ps {

/// Opens the choice of what the handles go about.
inline constexpr const char* kPivotKey = "Ctrl+.";
/// Turns steps on and off.
inline constexpr const char* kSnapKey = "Shift+S";

/// Moves, turns or stretches all that is selected by handles, or by a number that is typed while one is dragged. One
/// drag is one undo step; it goes by steps as Toolbox::handles() say. Clicks select; whatever else is dragged turns the
/// view.
class GizmoTool : public Tool {
 public:
  GizmoTool(Toolbox& box, Gizmo::Kind kind) : Tool(box), m_kind(kind), m_select(box) {}
  void hover(const Pointer& pointer) override;
  bool press(const Pointer& pointer) override;
  void drag(const Pointer& pointer) override;
  void release(const Pointer& pointer) override;
  void click(const Pointer& pointer) override { m_select.click(pointer); }
  bool cancel() override;
  void leave() override;
  void see(const Snapshot* scene) override;
  bool type(const QString& text) override;
  bool takesText(const QString& text) const override;
  ToolPicture picture() const override;
  QString words() const override;
  std::vector<Gesture> gestures() const override;
  QString invitation() const override { return m_select.invitation(); }
  bool turnsView() const override { return true; }
  bool usesHandles() const override { return true; }

 private:
  Placeable selected() const;
  std::optional<Gizmo> gizmo(const Placeable& things) const;
  Vector3 withinBounds(const Vector3& way) const;
  /// Down or up onto what is below.
  Vector3 landing(Vector3 way) const;
  void apply(GizmoDrag dragged);
  void enter();
  void end(bool keep);

  const Gizmo::Kind m_kind;
  SelectTool m_select;
  MatterPlaces m_matter;
  std::optional<GizmoPart> m_hovered;
  std::optional<GizmoGrip> m_grip;
  std::optional<Pointer> m_pressed;  ///< until it is dragged
  std::optional<Vector3> m_pivot;    ///< m, what all go about; none: each about itself
  uint64_t m_begun = 0;              ///< Document::changeCount() before the drag
  Placement m_before;
  MatterPlaces m_matterBefore;
  std::optional<BodyBounds> m_bounds;  ///< around what is moved, as it was
  std::vector<BodyBounds> m_beside;    ///< around the other bodies
  GizmoDrag m_dragged;
  QString m_typed;       ///< "": the pointer leads
  double m_entered = 0;  ///< what that says: m, radians, a factor
  bool m_wrong = false;
};

/// A stroke that is chosen in its list goes by itself, instead of its body.
class MoveTool final : public GizmoTool {
 public:
  explicit MoveTool(Toolbox& box) : GizmoTool(box, Gizmo::Kind::Move), m_stroke(box) {}
  void hover(const Pointer& pointer) override;
  bool press(const Pointer& pointer) override;
  void drag(const Pointer& pointer) override;
  void release(const Pointer& pointer) override;
  bool cancel() override;
  void leave() override;
  ToolPicture picture() const override;
  QString words() const override;
  std::vector<Gesture> gestures() const override;

 private:
  StrokeHandles m_stroke;
};
struct RotateTool final : GizmoTool {
  explicit RotateTool(Toolbox& box) : GizmoTool(box, Gizmo::Kind::Rotate) {}
};
struct ScaleTool final : GizmoTool {
  explicit ScaleTool(Toolbox& box) : GizmoTool(box, Gizmo::Kind::Scale) {}
};

}  // namespace ps
