// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/placement.h"
#include "ui/tools/selecttool.h"

#include <optional>

namespace ps {

/// Takes a body that is held in place, a spoon, a rod, and leads it with the pointer through matter, which it meets as
/// any body that moves. It goes across the view, with Shift along the level; keys turn it about where it was taken hold
/// of. It stays within the room of the scene. While no time passes it is put there at once. One drag is one undo step.
class TakeInHand final : public Tool {
 public:
  explicit TakeInHand(Toolbox& box) : Tool(box), m_select(box) {}
  void hover(const Pointer& pointer) override;
  bool press(const Pointer& pointer) override;
  void drag(const Pointer& pointer) override;
  void release(const Pointer& pointer) override;
  void click(const Pointer& pointer) override { m_select.click(pointer); }
  bool cancel() override;
  void leave() override;
  bool type(const QString& text) override;
  bool takesText(const QString& text) const override;
  ToolPicture picture() const override;
  QString words() const override;
  std::vector<Gesture> gestures() const override;
  QString invitation() const override { return m_select.invitation(); }
  bool turnsView() const override { return true; }

 private:
  struct Grip {
    Body before;    ///< as it stood when it was taken
    Vector3 taken;  ///< m, where
    Vector3 at;     ///< m, where that is wanted now
    Quaternion turn = Quaternion::Identity();
    Pointer anchor;      ///< from where the pointer leads on,
    Vector3 anchored;    ///< and where it was then, m
    uint64_t begun = 0;  ///< Document::changeCount() before the drag
  };
  const Body* bodyUnder(const Pointer& pointer) const;
  void place();
  void end(bool keep);

  SelectTool m_select;
  bool m_hovers = false;  ///< over what could be taken
  std::optional<Grip> m_grip;
};

}  // namespace ps
