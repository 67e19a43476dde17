// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/document.h"
#include "ui/tools/aim.h"
#include "ui/tools/surface.h"
#include "ui/tools/toolbox.h"

#include <utility>

namespace ps {

/// Puts something of the scene where a surface is pressed; until then the view shows what it would be.
template <class Placed>
class PlaceTool : public Tool {
 public:
  using Tool::Tool;
  void hover(const Pointer& pointer) override {
    m_surface = surfaceUnder(pointer, box().document().project().environment);
    update(pointer);
  }
  bool press(const Pointer& pointer) override {
    hover(pointer);
    m_pressed = pointer;
    m_pressed->scene = nullptr;  // its memory is not held meanwhile
    return true;
  }
  void drag(const Pointer& pointer) override { update(pointer); }
  void release(const Pointer& pointer) override {
    update(pointer);
    m_pressed.reset();
    if (auto placed = std::exchange(m_preview, {})) {
      placed->id.clear();
      put(std::move(*placed));
    }
  }
  bool cancel() override {
    m_preview.reset();
    return std::exchange(m_pressed, {}).has_value();
  }
  void leave() override { cancel(); }

 protected:
  /// What would be put on a surface; `pressed` is where a drag to `pointer` began, nullptr while nothing is pressed.
  virtual Placed at(const Surface& surface, const Pointer* pressed, const Pointer& pointer) const = 0;
  virtual void put(Placed placed) = 0;
  const std::optional<Placed>& preview() const { return m_preview; }

 private:
  void update(const Pointer& pointer) {
    m_preview.reset();
    if (!m_surface) return;
    m_preview = at(*m_surface, m_pressed ? &*m_pressed : nullptr, pointer);
    m_preview->id = kPreviewId;
  }

  std::optional<Pointer> m_pressed;
  std::optional<Surface> m_surface;  // under the pointer, or where the drag began
  std::optional<Placed> m_preview;
};

}  // namespace ps
