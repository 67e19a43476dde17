// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/surface.h"

namespace ps {

/// Puts a sink that stands on the surface; a drag makes it wider.
class PlaceDrain final : public Tool {
 public:
  using Tool::Tool;
  void hover(const Pointer& pointer) override;
  bool press(const Pointer& pointer) override;
  void drag(const Pointer& pointer) override;
  void release(const Pointer& pointer) override;
  bool cancel() override;
  void leave() override { cancel(); }
  ToolPicture picture() const override;
  QString words() const override { return QStringLiteral("Place a drain"); }
  std::vector<Gesture> gestures() const override;

 private:
  void update(const Pointer& pointer);
  std::optional<Pointer> m_pressed;
  std::optional<Surface> m_surface;  ///< under the pointer, or where the drag began
  std::optional<Sink> m_drain;       ///< as it would be now
};

}  // namespace ps
