// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/renderer.h"
#include "ui/vr/session.h"

#include <vector>

namespace ps::vr {

/// Pictures of one kind that are shown in turn; made and used with the session's OpenGL context current.
class Swapchain {
 public:
  struct Kind {
    int64_t format = 0;  ///< of OpenGL
    XrSwapchainUsageFlags usage = 0;
    GLenum attachment = 0;  ///< as which a framebuffer has it
  };
  /// Throws Failure.
  Swapchain(XrSession session, const PictureSize& size, const Kind& kind);
  ~Swapchain();
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  /// Takes the next picture. Throws Failure, and Error where the headset keeps all of them for seconds.
  void acquire();
  void attach();   ///< to the framebuffer: what is OpenGL of that, once the runtime is out of it
  void release();  ///< it may be shown
  XrSwapchain handle() const { return m_handle; }
  uint32_t framebuffer() const { return m_framebuffer; }
  uint32_t texture() const { return m_textures.at(m_index); }  ///< that was acquired

 private:
  XrSwapchain m_handle = XR_NULL_HANDLE;
  GLenum m_attachment;
  std::vector<uint32_t> m_textures;
  uint32_t m_index = 0, m_framebuffer = 0;
};

std::vector<int64_t> offeredFormats(XrSession session);

}  // namespace ps::vr
