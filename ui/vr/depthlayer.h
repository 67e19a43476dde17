// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/swapchain.h"

#include <array>
#include <optional>

namespace ps::vr {

/// How far what each eye sees is (XR_KHR_composition_layer_depth): with it a headset that shows a picture a little late
/// moves what is near by more than what is far. It needs fewer pixels than colours do. A headset that does not take
/// it, has no format for it, or refuses its pictures, gets none.
class DepthLayer {
 public:
  static constexpr const char* kExtension = XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME;

  /// `sizes`: of the eyes' pictures; planes of their windows in m.
  DepthLayer(const Runtime& runtime, const Session& session, const std::array<PictureSize, 2>& sizes, double near,
             double far);
  bool isTaken() const { return m_eyes[0].has_value(); }
  void acquire(size_t eye) { m_eyes.at(eye)->acquire(); }  ///< takes the next picture
  /// Depths 0..1 from the near plane to the far one are drawn into it.
  RenderTarget target(size_t eye);
  void release(size_t eye) { m_eyes.at(eye)->release(); }
  /// For an eye's view of a layer, until the next one.
  const XrCompositionLayerDepthInfoKHR* shown(size_t eye) const { return &m_shown.at(eye); }

 private:
  void makeEye(size_t eye, const Session& session, int64_t format);

  std::array<std::optional<Swapchain>, 2> m_eyes;
  std::array<PictureSize, 2> m_sizes;
  std::array<XrCompositionLayerDepthInfoKHR, 2> m_shown{};
};

}  // namespace ps::vr
