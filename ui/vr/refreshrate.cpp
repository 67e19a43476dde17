// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/refreshrate.h"

#include <algorithm>
#include <cmath>

namespace ps::vr {
namespace {

constexpr float kWanted = 90;  // Hz

bool isNearer(float a, float b) { return std::abs(a - kWanted) < std::abs(b - kWanted); }

std::vector<float> offeredRates(const Runtime& runtime, XrSession session) {
  constexpr const char* kCall = "xrEnumerateDisplayRefreshRatesFB";
  const auto ratesOf = runtime.function<PFN_xrEnumerateDisplayRefreshRatesFB>(kCall);
  uint32_t count = 0;
  check(ratesOf(session, 0, &count, nullptr), kCall);
  std::vector<float> rates(count);
  if (count > 0) check(ratesOf(session, count, &count, rates.data()), kCall);
  rates.resize(count);
  return rates;
}

}  // namespace

RefreshRate::RefreshRate(const Runtime& runtime, XrSession session) {
  if (!runtime.has(kExtension)) return;
  const auto rateOf = runtime.function<PFN_xrGetDisplayRefreshRateFB>("xrGetDisplayRefreshRateFB");
  float now = 0;
  check(rateOf(session, &now), "xrGetDisplayRefreshRateFB");
  m_hertz = double(now);
  const std::vector<float> offered = offeredRates(runtime, session);
  const auto best = std::min_element(offered.begin(), offered.end(), isNearer);
  if (best == offered.end() || !isNearer(*best, now)) return;
  const auto request = runtime.function<PFN_xrRequestDisplayRefreshRateFB>("xrRequestDisplayRefreshRateFB");
  const XrResult result = request(session, *best);
  // A headset that is told otherwise by its wearer says no; that it has changed comes as an event.
  if (result != XR_ERROR_DISPLAY_REFRESH_RATE_UNSUPPORTED_FB) check(result, "xrRequestDisplayRefreshRateFB");
}

void RefreshRate::notice(const XrEventDataBuffer& event) {
  if (event.type != XR_TYPE_EVENT_DATA_DISPLAY_REFRESH_RATE_CHANGED_FB) return;
  m_hertz = double(reinterpret_cast<const XrEventDataDisplayRefreshRateChangedFB&>(event).toDisplayRefreshRate);
}

}  // namespace ps::vr
