// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/sketch/drawingplane.h"
#include "ui/tools/guides.h"
#include "ui/tools/livestroke.h"
#include "ui/tools/livetouch.h"
#include "ui/tools/tool.h"

namespace ps {

/// Draws matter with the brush; Control erases instead. A stroke stays on the plane on which it began; an eraser takes
/// what is under the pointer, as the scene was when it was pressed, so that it does not dig into its own hole. With a
/// brush that touches matter the hand is at what is under the pointer, for as long as it is pressed; what it has taken
/// hold of it carries across the view, and Control asks for the opposite.
class DrawTool : public Tool {
 public:
  explicit DrawTool(Toolbox& box) : DrawTool(box, false) {}
  void hover(const Pointer& pointer) override;
  bool press(const Pointer& pointer) override;
  void drag(const Pointer& pointer) override;
  void release(const Pointer& pointer) override;
  void click(const Pointer& pointer) override;
  bool cancel() override;
  bool goesOn() const override { return m_stroke.ending(); }
  void see(const Snapshot* now) override;
  void leave() override { m_cursor.reset(); }
  ToolPicture picture() const override;
  QString words() const override;
  std::vector<Gesture> gestures() const override;
  QString invitation() const override;
  bool usesBrush() const override { return true; }

 protected:
  DrawTool(Toolbox& box, bool erases);

 private:
  std::optional<Vector3> placeOf(const Pointer& pointer) const;
  std::optional<Vector3> matterUnder(const Pointer& pointer) const;
  std::optional<Vector3> snapped(const Pointer& pointer, const Vector3& place);
  bool isJoined(const Vector3& point, const Pointer& pointer) const;
  void draw(const Vector3& point, const Pointer& pointer);
  void beginTouch(const Pointer& pointer);
  void faceViewer(const Pointer& pointer);
  void dragTouch(const Pointer& pointer);
  void touchAt(const Vector3& point);
  bool touches() const;
  void feel(const Snapshot* now);
  Held heldBy(const Pointer& pointer) const;
  bool erases(const Pointer& pointer) const { return pointer.eraser || m_erases != pointer.control; }
  bool meetsMatter() const;  ///< instead of standing on it
  QString brushLabel() const;
  void refuse(const QString& why, bool kept = false);
  void endStroke();

  const bool m_erases;
  LiveStroke m_stroke;
  LiveTouch m_touch;
  DrawingPlane m_plane;
  Vector3 m_lift{0, 0, 0};  ///< m, by which the plane stands off what is pointed at
  SnapshotPtr m_before;     ///< the scene when an eraser was pressed
  Straightener m_straight;
  Trailing m_trail;
  double m_began = 0;  ///< s, on the pointer's clock
  std::optional<BrushCursor> m_cursor;
  Pointer m_hand;        ///< as it was last while it touches matter
  QString m_felt;        ///< "" or how warm it is at the hand, of a brush for heat
  QString m_snapped;     ///< "" or what the place under the pointer has snapped to
  bool m_faces = false;  ///< the plane lies across the view, for what the hand holds
  bool m_said = false;   ///< why something was not drawn, or flows
};

/// Takes matter away with the brush; Control draws instead.
class EraseTool final : public DrawTool {
 public:
  explicit EraseTool(Toolbox& box) : DrawTool(box, true) {}
};

}  // namespace ps
