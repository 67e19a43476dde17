// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/renderer.h"
#include "ui/vr/runtime.h"

#include <array>
#include <memory>

namespace ps::vr {

/// Which parts of the eyes' pictures no lens shows (XR_KHR_visibility_mask): they need not be drawn. A headset that
/// says nothing of it, or refuses to, is drawn for as a whole.
class VisibilityMask {
 public:
  static constexpr const char* kExtension = XR_KHR_VISIBILITY_MASK_EXTENSION_NAME;

  VisibilityMask(const Runtime& runtime, XrSession session);
  /// Of an event that may tell of another mask.
  void notice(const XrEventDataBuffer& event);
  /// nullptr: all is seen.
  const std::shared_ptr<const HiddenTriangles>& hidden(size_t eye) const { return m_hidden.at(eye); }

 private:
  void fetch(uint32_t eye);

  XrSession m_session;
  PFN_xrGetVisibilityMaskKHR m_maskOf = nullptr;
  std::array<std::shared_ptr<const HiddenTriangles>, 2> m_hidden;
};

}  // namespace ps::vr
