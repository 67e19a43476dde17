// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/camera.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace ps::vr {

/// Draws how far things are, and nothing of what they look like: matter as balls, what stands around it, what hands
/// hold, panels. All of it with one OpenGL context current; it leaves that as it was.
///
/// It cannot do: vapour and glass, through which one sees; matter between two pictures of it is where it comes to.
class DepthPass {
 public:
  DepthPass();  ///< throws Error where the driver takes no such shader
  ~DepthPass();
  DepthPass(const DepthPass&) = delete;
  DepthPass& operator=(const DepthPass&) = delete;

  void prepare(const Snapshot& matter, const RenderScene& scene, const Look& look);
  /// `panels`: how many of them lie in the scene; those behind are for the eye alone.
  void show(const Props& props, size_t panels);
  /// Into the depth of a framebuffer: 0 at the eye's near plane, 1 at the far one and where nothing is.
  void draw(const Eye& eye, const RenderTarget& target) const;

 private:
  enum Part : size_t { kMatter, kFurniture, kProps, kPanels, kParts };
  struct Objects;
  std::unique_ptr<Objects> m_objects;
  std::array<uint32_t, kParts> m_arrays{};
  std::array<int, kParts> m_counts{};  ///< balls, or corners
  std::optional<Environment> m_furnished;
  std::optional<Section> m_section;
  void upload(Part part, const void* data, size_t bytes, int count);
};

}  // namespace ps::vr
