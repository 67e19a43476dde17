// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/swapchain.h"

namespace ps::vr {
namespace {

std::vector<uint32_t> texturesOf(XrSwapchain swapchain) {
  constexpr const char* kCall = "xrEnumerateSwapchainImages";
  uint32_t count = 0;
  check(xrEnumerateSwapchainImages(swapchain, 0, &count, nullptr), kCall);
  std::vector<XrSwapchainImageOpenGLKHR> images(
      count, structure<XrSwapchainImageOpenGLKHR>(XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR));
  check(xrEnumerateSwapchainImages(swapchain, count, &count,
                                   reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data())),
        kCall);
  std::vector<uint32_t> textures;
  textures.reserve(count);
  for (const XrSwapchainImageOpenGLKHR& image : images) textures.push_back(image.image);
  return textures;
}

}  // namespace

std::vector<int64_t> offeredFormats(XrSession session) {
  constexpr const char* kCall = "xrEnumerateSwapchainFormats";
  uint32_t count = 0;
  check(xrEnumerateSwapchainFormats(session, 0, &count, nullptr), kCall);
  std::vector<int64_t> formats(count);
  check(xrEnumerateSwapchainFormats(session, count, &count, formats.data()), kCall);
  return formats;
}

Swapchain::Swapchain(XrSession session, const PictureSize& size, const Kind& kind) : m_attachment(kind.attachment) {
  auto info = structure<XrSwapchainCreateInfo>(XR_TYPE_SWAPCHAIN_CREATE_INFO);
  info.usageFlags = kind.usage;
  info.format = kind.format;
  info.sampleCount = info.faceCount = info.arraySize = info.mipCount = 1;
  info.width = static_cast<uint32_t>(size.width);
  info.height = static_cast<uint32_t>(size.height);
  check(xrCreateSwapchain(session, &info, &m_handle), "xrCreateSwapchain");
  try {
    m_textures = texturesOf(m_handle);
  } catch (...) {
    xrDestroySwapchain(m_handle);
    throw;
  }
  glGenFramebuffers(1, &m_framebuffer);
}

Swapchain::~Swapchain() {
  glDeleteFramebuffers(1, &m_framebuffer);
  xrDestroySwapchain(m_handle);
}

void Swapchain::acquire() {
  check(xrAcquireSwapchainImage(m_handle, nullptr, &m_index), "xrAcquireSwapchainImage");
  auto wait = structure<XrSwapchainImageWaitInfo>(XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO);
  wait.timeout = XR_INFINITE_DURATION;
  check(xrWaitSwapchainImage(m_handle, &wait), "xrWaitSwapchainImage");
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, m_framebuffer);
  glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, m_attachment, GL_TEXTURE_2D, m_textures.at(m_index), 0);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(bound));
}

void Swapchain::release() { check(xrReleaseSwapchainImage(m_handle, nullptr), "xrReleaseSwapchainImage"); }

}  // namespace ps::vr
