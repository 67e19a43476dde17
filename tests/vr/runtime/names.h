// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <openxr/openxr.h>

#include <optional>
#include <string>
#include <string_view>

namespace ps::scripted {

/// "XR_ERROR_SESSION_LOST"; for one that this version of OpenXR does not know, XR_UNKNOWN_FAILURE_ or
/// XR_UNKNOWN_SUCCESS_ with its number, as xrResultToString() has to say.
std::string nameOf(XrResult result);
std::string nameOf(XrStructureType type);
std::string nameOf(XrSessionState state);  ///< "FOCUSED"

std::optional<XrResult> resultNamed(std::string_view name);
std::optional<XrSessionState> stateNamed(std::string_view name);

}  // namespace ps::scripted
