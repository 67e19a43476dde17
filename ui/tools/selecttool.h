// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/handletool.h"

namespace ps {

/// Selects what is clicked and tells how warm it is there; takes hold of taps and drains. Whatever else is dragged
/// turns the view.
class SelectTool final : public Tool {
 public:
  explicit SelectTool(Toolbox& box) : Tool(box), m_handles(box) {}
  void hover(const Pointer& pointer) override { m_handles.hover(pointer); }
  bool press(const Pointer& pointer) override { return m_handles.press(pointer); }
  void drag(const Pointer& pointer) override { m_handles.drag(pointer); }
  void release(const Pointer& pointer) override { m_handles.release(pointer); }
  void click(const Pointer& pointer) override;
  bool cancel() override { return m_handles.cancel(); }
  void leave() override { m_handles.leave(); }
  ToolPicture picture() const override { return m_handles.picture(); }
  QString words() const override { return QStringLiteral("Select and orbit"); }
  std::vector<Gesture> gestures() const override;
  QString invitation() const override;
  bool turnsView() const override { return true; }

 private:
  HandleTool m_handles;
};

}  // namespace ps
