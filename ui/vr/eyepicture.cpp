// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/eyepicture.h"

#include <algorithm>
#include <cmath>

namespace ps::vr {
namespace {

void requireSrgb(XrSession session) {
  constexpr const char* kCall = "xrEnumerateSwapchainFormats";
  uint32_t count = 0;
  check(xrEnumerateSwapchainFormats(session, 0, &count, nullptr), kCall);
  std::vector<int64_t> formats(count);
  check(xrEnumerateSwapchainFormats(session, count, &count, formats.data()), kCall);
  if (std::find(formats.begin(), formats.end(), GL_SRGB8_ALPHA8) == formats.end())
    throw Error("The headset's software shows no sRGB pictures; choose another OpenXR runtime.");
}

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

EyePicture::EyePicture(const Session& session, const PictureSize& size) : m_size(size), m_used(size) {
  requireSrgb(session.handle());
  auto info = structure<XrSwapchainCreateInfo>(XR_TYPE_SWAPCHAIN_CREATE_INFO);
  info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT;
  info.format = GL_SRGB8_ALPHA8;
  info.sampleCount = info.faceCount = info.arraySize = info.mipCount = 1;
  info.width = static_cast<uint32_t>(size.width);
  info.height = static_cast<uint32_t>(size.height);
  check(xrCreateSwapchain(session.handle(), &info, &m_swapchain), "xrCreateSwapchain");
  try {
    m_textures = texturesOf(m_swapchain);
  } catch (...) {
    xrDestroySwapchain(m_swapchain);
    throw;
  }
  glGenFramebuffers(1, &m_framebuffer);
}

EyePicture::~EyePicture() {
  glDeleteFramebuffers(1, &m_framebuffer);
  xrDestroySwapchain(m_swapchain);
}

RenderTarget EyePicture::acquire(double scale) {
  check(xrAcquireSwapchainImage(m_swapchain, nullptr, &m_index), "xrAcquireSwapchainImage");
  auto wait = structure<XrSwapchainImageWaitInfo>(XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO);
  wait.timeout = XR_INFINITE_DURATION;
  check(xrWaitSwapchainImage(m_swapchain, &wait), "xrWaitSwapchainImage");
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, m_framebuffer);
  glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, m_textures.at(m_index), 0);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(bound));
  const auto part = [scale](int side) { return std::max(1, static_cast<int>(std::lround(scale * side))); };
  m_used = {part(m_size.width), part(m_size.height), false};
  return {m_framebuffer, 0, 0, m_used};
}

void EyePicture::release() { check(xrReleaseSwapchainImage(m_swapchain, nullptr), "xrReleaseSwapchainImage"); }

XrSwapchainSubImage EyePicture::shown() const { return {m_swapchain, {{0, 0}, {m_used.width, m_used.height}}, 0}; }

std::array<PictureSize, 2> recommendedSizes(const Runtime& runtime) {
  std::array<XrViewConfigurationView, 2> views;
  views.fill(structure<XrViewConfigurationView>(XR_TYPE_VIEW_CONFIGURATION_VIEW));
  uint32_t count = 0;
  check(xrEnumerateViewConfigurationViews(runtime.instance(), runtime.system(),
                                          XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, 2, &count, views.data()),
        "xrEnumerateViewConfigurationViews");
  std::array<PictureSize, 2> sizes;
  for (size_t eye = 0; eye < 2; ++eye) {
    sizes[eye].width = static_cast<int>(views[eye].recommendedImageRectWidth);
    sizes[eye].height = static_cast<int>(views[eye].recommendedImageRectHeight);
  }
  return sizes;
}

}  // namespace ps::vr
