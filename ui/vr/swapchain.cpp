// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/swapchain.h"

namespace ps::vr {
namespace {

constexpr XrDuration kPatience = 3'000'000'000;  // ns, for a picture that the headset still has
const char* const kKept = "The headset's software gave no picture back; enter VR again.";

std::vector<uint32_t> texturesOf(XrSwapchain swapchain) {
  const auto images = listed(
      "xrEnumerateSwapchainImages",
      [&](uint32_t room, uint32_t* count, XrSwapchainImageOpenGLKHR* all) {
        return xrEnumerateSwapchainImages(swapchain, room, count, reinterpret_cast<XrSwapchainImageBaseHeader*>(all));
      },
      structure<XrSwapchainImageOpenGLKHR>(XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR));
  std::vector<uint32_t> textures;
  textures.reserve(images.size());
  for (const XrSwapchainImageOpenGLKHR& image : images) textures.push_back(image.image);
  return textures;
}

}  // namespace

std::vector<int64_t> offeredFormats(XrSession session) {
  return listed<int64_t>("xrEnumerateSwapchainFormats",
                         [&](auto... room) { return xrEnumerateSwapchainFormats(session, room...); });
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
}

Swapchain::~Swapchain() {
  glDeleteFramebuffers(1, &m_framebuffer);
  xrDestroySwapchain(m_handle);
}

void Swapchain::acquire() {
  check(xrAcquireSwapchainImage(m_handle, nullptr, &m_index), "xrAcquireSwapchainImage");
  auto wait = structure<XrSwapchainImageWaitInfo>(XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO);
  wait.timeout = kPatience;
  if (check(xrWaitSwapchainImage(m_handle, &wait), "xrWaitSwapchainImage") == XR_TIMEOUT_EXPIRED) throw Error(kKept);
}

void Swapchain::attach() {
  if (m_framebuffer == 0) glGenFramebuffers(1, &m_framebuffer);
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, m_framebuffer);
  glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, m_attachment, GL_TEXTURE_2D, m_textures.at(m_index), 0);
  if (m_attachment == GL_DEPTH_ATTACHMENT) glDrawBuffer(GL_NONE);  // there is no colour to draw
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(bound));
}

void Swapchain::release() { check(xrReleaseSwapchainImage(m_handle, nullptr), "xrReleaseSwapchainImage"); }

}  // namespace ps::vr
