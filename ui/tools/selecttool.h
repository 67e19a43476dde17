// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/selection.h"
#include "ui/tools/handletool.h"

#include <optional>

namespace ps {

/// Selects what is clicked and tells how warm it is there, walls, pins and boxes of probes too; takes hold of taps and
/// drains. With Shift one more, with Ctrl whatever lies in a frame that is drawn. Whatever else is dragged turns the
/// view.
class SelectTool final : public Tool {
 public:
  explicit SelectTool(Toolbox& box) : Tool(box), m_handles(box) {}
  void hover(const Pointer& pointer) override;
  bool press(const Pointer& pointer) override;
  void drag(const Pointer& pointer) override;
  void release(const Pointer& pointer) override;
  void click(const Pointer& pointer) override;
  bool cancel() override;
  void leave() override;
  ToolPicture picture() const override;
  QString words() const override { return QStringLiteral("Select and orbit"); }
  std::vector<Gesture> gestures() const override;
  QString invitation() const override;
  bool turnsView() const override { return true; }

 private:
  /// What of the scene is seen within the frame.
  std::vector<SelectedItem> framed(const Pointer& to) const;
  std::vector<Wire> wires() const;
  HandleTool m_handles;
  std::optional<SelectedItem> m_hovered;        ///< that has no matter, at one of its edges
  std::optional<Pointer> m_corner, m_opposite;  ///< of the frame that is drawn
};

}  // namespace ps
