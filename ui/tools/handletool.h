// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/porthandles.h"

#include <variant>

namespace ps {

/// Moves, turns and stretches emitters and sinks by their handles. A whole one moves on the plane that one would draw
/// on, with Shift up and down; tips and corners move across the view. One drag is one undo step.
class HandleTool final : public Tool {
 public:
  using Tool::Tool;
  void hover(const Pointer& pointer) override;
  bool press(const Pointer& pointer) override;  ///< false: no handle there
  void drag(const Pointer& pointer) override;
  void release(const Pointer& pointer) override;
  bool cancel() override;
  void leave() override { m_hovered.reset(); }
  ToolPicture picture() const override;
  QString words() const override;
  std::vector<Gesture> gestures() const override;
  /// What the pointer would take hold of.
  std::optional<PortHandle> handleUnder(const Pointer& pointer) const;

 private:
  struct Grip {
    PortHandle handle;
    std::variant<Emitter, Sink> before;
    Pointer pressed;
    bool moved = false;
    uint64_t begun = 0;  ///< Document::changeCount() before the drag
  };
  void end(bool keep);
  std::optional<PortHandle> m_hovered;
  std::optional<Grip> m_grip;
};

}  // namespace ps
