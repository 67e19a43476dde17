// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/renderer.h"
#include "ui/vr/swapchain.h"

#include <array>

namespace ps::vr {

/// The pictures of one eye that are shown in turn, in sRGB; made and used with the session's OpenGL context current.
class EyePicture {
 public:
  /// Throws Failure, and Error where the runtime has no sRGB.
  EyePicture(const Session& session, const PictureSize& size);

  void acquire() { m_pictures.acquire(); }  ///< takes the next one
  /// What is drawn into the target is shown after release(). Values are written as they are: a shader encodes them,
  /// GL_FRAMEBUFFER_SRGB stays off. `scale`: pixels along a side that are used, of those there are.
  RenderTarget target(double scale);
  uint32_t texture() const { return m_pictures.texture(); }  ///< that was acquired
  void release() { m_pictures.release(); }
  XrSwapchainSubImage shown() const;  ///< for a layer

 private:
  PictureSize m_size, m_used;
  Swapchain m_pictures;
};

/// What the runtime recommends for each eye.
std::array<PictureSize, 2> recommendedSizes(const Runtime& runtime);

}  // namespace ps::vr
