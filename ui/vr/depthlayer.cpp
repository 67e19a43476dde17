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
  for (size_t eye = 0; eye < m_eyes.size(); ++eye) {
    PictureSize& size = m_sizes[eye];
    size = {std::max(1, size.width / kShare), std::max(1, size.height / kShare), false};
    m_eyes[eye].emplace(
        session.handle(), size,
        Swapchain::Kind{format, XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT,
                        GL_DEPTH_ATTACHMENT});
    auto& shown = m_shown[eye] = structure<XrCompositionLayerDepthInfoKHR>(XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR);
    shown.subImage = {m_eyes[eye]->handle(), {{0, 0}, {size.width, size.height}}, 0};
    shown.maxDepth = 1;
    shown.nearZ = static_cast<float>(near);
    shown.farZ = static_cast<float>(far);
  }
}

RenderTarget DepthLayer::acquire(size_t eye) {
  m_eyes.at(eye)->acquire();
  return {m_eyes[eye]->framebuffer(), 0, 0, m_sizes[eye]};
}

}  // namespace ps::vr
