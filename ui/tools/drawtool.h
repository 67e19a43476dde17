// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/sketch/drawingplane.h"
#include "ui/tools/livestroke.h"
#include "ui/tools/tool.h"

namespace ps {

/// Draws matter with the brush; Control erases instead. A stroke stays on the plane on which it began.
class DrawTool : public Tool {
 public:
  explicit DrawTool(Toolbox& box) : DrawTool(box, false) {}
  void hover(const Pointer& pointer) override;
  bool press(const Pointer& pointer) override;
  void drag(const Pointer& pointer) override;
  void release(const Pointer& pointer) override;
  bool cancel() override;
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
  void refuse(const QString& why);

  const bool m_erases;
  LiveStroke m_stroke;
  DrawingPlane m_plane;
  double m_began = 0;  ///< s, on the pointer's clock
  std::optional<BrushCursor> m_cursor;
};

/// Takes matter away with the brush; Control draws instead.
class EraseTool final : public DrawTool {
 public:
  explicit EraseTool(Toolbox& box) : DrawTool(box, true) {}
};

}  // namespace ps
