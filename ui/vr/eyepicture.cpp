// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/eyepicture.h"

#include <algorithm>
#include <cmath>

namespace ps::vr {
namespace {

Swapchain::Kind kindFor(XrSession session) {
  const std::vector<int64_t> formats = offeredFormats(session);
  if (std::find(formats.begin(), formats.end(), GL_SRGB8_ALPHA8) == formats.end())
    throw Error("The headset's software shows no sRGB pictures; choose another OpenXR runtime.");
  return {GL_SRGB8_ALPHA8, XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT,
          GL_COLOR_ATTACHMENT0};
}

}  // namespace

EyePicture::EyePicture(const Session& session, const PictureSize& size)
    : m_size(size), m_used(size), m_pictures(session.handle(), size, kindFor(session.handle())) {}

RenderTarget EyePicture::target(double scale) {
  m_pictures.attach();
  const auto part = [scale](int side) { return std::max(1, static_cast<int>(std::lround(scale * side))); };
  m_used = {part(m_size.width), part(m_size.height), false};
  return {m_pictures.framebuffer(), 0, 0, m_used, m_pictures.texture()};
}

XrSwapchainSubImage EyePicture::shown() const {
  return {m_pictures.handle(), {{0, 0}, {m_used.width, m_used.height}}, 0};
}

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
