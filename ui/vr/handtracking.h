// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/barehand.h"
#include "ui/vr/session.h"

#include <array>
#include <optional>

namespace ps::vr {

/// Where the joints of bare hands are (XR_EXT_hand_tracking). A headset that cannot see hands, or refuses to, shows
/// none.
class HandTracking {
 public:
  static constexpr const char* kExtension = XR_EXT_HAND_TRACKING_EXTENSION_NAME;

  HandTracking(const Runtime& runtime, const Session& session);
  ~HandTracking();
  HandTracking(const HandTracking&) = delete;
  HandTracking& operator=(const HandTracking&) = delete;

  /// In the floor's space; nothing while the hand is not seen as a whole. Throws Failure where the headset is lost.
  std::optional<SeenHand> locate(size_t hand, XrTime time) const;

 private:
  void create(const Runtime& runtime);

  const Session& m_session;
  std::array<XrHandTrackerEXT, 2> m_trackers{};
  PFN_xrDestroyHandTrackerEXT m_destroy = nullptr;
  PFN_xrLocateHandJointsEXT m_locate = nullptr;
};

}  // namespace ps::vr
