// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/depthlayer.h"

#include <algorithm>

namespace ps::vr {
namespace {

constexpr int kShare = 2;  // pixels along a side of a picture for one of its depths
constexpr std::array<int64_t, 2> kFormats = {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT24};

/// 0: there is none.
int64_t formatOf(XrSession session) {
  const std::vector<int64_t> offered = offeredFormats(session);
  for (const int64_t format : kFormats)
    if (std::find(offered.begin(), offered.end(), format) != offered.end()) return format;
  return 0;
}

}  // namespace

DepthLayer::DepthLayer(const Runtime& runtime, const Session& session, const std::array<PictureSize, 2>& sizes,
                       double near, double far)
    : m_sizes(sizes) {
  const int64_t format = runtime.has(kExtension) ? formatOf(session.handle()) : 0;
  if (format == 0) return;
  for (PictureSize& size : m_sizes) size = {std::max(1, size.width / kShare), std::max(1, size.height / kShare), false};
  try {
    for (size_t eye = 0; eye < m_eyes.size(); ++eye) makeEye(eye, session, format);
  } catch (const Failure&) {  // the stay does without; where more is amiss, the next call says so
    for (auto& eye : m_eyes) eye.reset();
    return;
  }
  for (XrCompositionLayerDepthInfoKHR& shown : m_shown) {
    shown.maxDepth = 1;
    shown.nearZ = static_cast<float>(near);
    shown.farZ = static_cast<float>(far);
  }
}

void DepthLayer::makeEye(size_t eye, const Session& session, int64_t format) {
  const PictureSize& size = m_sizes[eye];
  m_eyes[eye].emplace(
      session.handle(), size,
      Swapchain::Kind{format, XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT,
                      GL_DEPTH_ATTACHMENT});
  m_shown[eye] = structure<XrCompositionLayerDepthInfoKHR>(XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR);
  m_shown[eye].subImage = {m_eyes[eye]->handle(), {{0, 0}, {size.width, size.height}}, 0};
}

RenderTarget DepthLayer::target(size_t eye) {
  m_eyes.at(eye)->attach();
  return {m_eyes[eye]->framebuffer(), 0, 0, m_sizes[eye]};
}

}  // namespace ps::vr
