// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/tool.h"

#include <cstdint>
#include <optional>

namespace ps {

/// A ruler: from the surface where it is pressed to the one where it is let go, along an axis with Shift. It tells how
/// far that is, along the scene's axes too, and between matter how much warmer one end is than the other. It changes
/// nothing, and stays until something else is measured.
class MeasureTool final : public Tool {
 public:
  using Tool::Tool;
  bool press(const Pointer& pointer) override;
  void drag(const Pointer& pointer) override;
  void release(const Pointer&) override { m_dragged = false; }
  bool cancel() override;
  ToolPicture picture() const override;
  QString words() const override;
  std::vector<Gesture> gestures() const override;

 private:
  struct End {
    Vector3 place{0, 0, 0};             ///< m
    std::optional<double> temperature;  ///< K, of matter
  };
  std::optional<End> endAt(const Pointer& pointer) const;
  bool measures() const;  ///< something, of the project that is open
  QString text() const;   ///< "" or what it says

  std::optional<End> m_from, m_to;
  uint64_t m_begun = 0;  ///< Document::changeCount() then
  bool m_dragged = false;
};

}  // namespace ps
