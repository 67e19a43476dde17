// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <openxr/openxr.h>

#include <cstddef>
#include <cstdint>

namespace ps::scripted {

inline constexpr size_t kEyes = 2;
inline constexpr uint32_t kMaximumPixels = 4096;  ///< along a side of a swapchain
inline constexpr uint32_t kMaximumLayers = 16;    ///< the least that the specification allows
inline constexpr uint32_t kImages = 3;            ///< of a swapchain

/// Throws Refusal XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED.
void requireStereo(XrViewConfigurationType type);

}  // namespace ps::scripted
