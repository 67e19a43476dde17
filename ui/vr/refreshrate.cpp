// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/refreshrate.h"

#include <algorithm>
#include <cmath>

namespace ps::vr {
namespace {

constexpr float kWanted = 90;  // Hz

bool isNearer(float a, float b) { return std::abs(a - kWanted) < std::abs(b - kWanted); }

}  // namespace

RefreshRate::RefreshRate(const Runtime& runtime, XrSession session) {
  if (!runtime.has(kExtension)) return;
  const auto rateOf = runtime.function<PFN_xrGetDisplayRefreshRateFB>("xrGetDisplayRefreshRateFB");
  float now = 0;
  // A rate is a wish: where more is amiss, the next call says so.
  if (XR_FAILED(rateOf(session, &now))) return;
  m_hertz = double(now);
  const auto ratesOf = runtime.function<PFN_xrEnumerateDisplayRefreshRatesFB>("xrEnumerateDisplayRefreshRatesFB");
  uint32_t count = 0;
  if (XR_FAILED(ratesOf(session, 0, &count, nullptr))) return;
  std::vector<float> offered(count);
  if (XR_FAILED(ratesOf(session, count, &count, offered.data()))) return;
  offered.resize(count);
  const auto best = std::min_element(offered.begin(), offered.end(), isNearer);
  if (best == offered.end() || !isNearer(*best, now)) return;
  const auto request = runtime.function<PFN_xrRequestDisplayRefreshRateFB>("xrRequestDisplayRefreshRateFB");
  // A headset that is told otherwise by its wearer says no, and one that is lost says so at the next call; that the
  // rate has changed comes as an event.
  request(session, *best);
}

void RefreshRate::notice(const XrEventDataBuffer& event) {
  if (event.type != XR_TYPE_EVENT_DATA_DISPLAY_REFRESH_RATE_CHANGED_FB) return;
  m_hertz = double(reinterpret_cast<const XrEventDataDisplayRefreshRateChangedFB&>(event).toDisplayRefreshRate);
}

}  // namespace ps::vr
