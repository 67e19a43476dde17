// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/runtime.h"

namespace ps::vr {

/// How many pictures a second the headset shows (XR_FB_display_refresh_rate). A headset that lets one choose is asked
/// for 90, or what it offers next to that; the others, and those that refuse it, go on as they do.
class RefreshRate {
 public:
  static constexpr const char* kExtension = XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME;

  /// Throws Failure where the headset is lost.
  RefreshRate(const Runtime& runtime, XrSession session);
  /// Of an event that may tell of another rate.
  void notice(const XrEventDataBuffer& event);
  double hertz() const { return m_hertz; }  ///< 0: the headset does not say

 private:
  double m_hertz = 0;
};

}  // namespace ps::vr
