// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/failure.h"

#include <openxr/openxr_reflection.h>

#include <string>

namespace ps::vr {
namespace {

std::string nameOf(XrResult result) {
  switch (result) {
#define PS_CASE(name, value) \
  case name:                 \
    return #name;
    XR_LIST_ENUM_XrResult(PS_CASE)
#undef PS_CASE
  }
  return "result " + std::to_string(result);
}

std::string sentenceOf(XrResult result, const std::string& call) {
  switch (result) {
    case XR_ERROR_RUNTIME_UNAVAILABLE:
      return "No OpenXR runtime runs here; start the headset's software, such as SteamVR or Monado, and enter VR "
             "again.";
    case XR_ERROR_FORM_FACTOR_UNAVAILABLE:
    case XR_ERROR_FORM_FACTOR_UNSUPPORTED:
      return "No headset is connected; connect it, and enter VR again.";
    case XR_ERROR_GRAPHICS_DEVICE_INVALID:
      return "The headset's software does not take this program's OpenGL; start both on the same graphics card.";
    case XR_ERROR_SESSION_LOST:
      return "The headset was lost; see that it is connected, and enter VR again.";
    case XR_ERROR_INSTANCE_LOST:
      return "The headset's software has stopped; start it, and enter VR again.";
    case XR_ERROR_LIMIT_REACHED:
      if (call != "xrCreateInstance")
        return "The headset's software takes no more (" + call +
               "); close what else uses the headset, and enter VR again.";
      return "The headset's software still keeps the last stay; wait until it answers, or save and start the program "
             "again.";
    case XR_ERROR_OUT_OF_MEMORY:
      return "The headset's software has no memory left; close what else runs.";
    default:
      return "The headset's software failed (" + call + ": " + nameOf(result) + "); enter VR again.";
  }
}

}  // namespace

Failure::Failure(XrResult result, const char* call) : Error(sentenceOf(result, call)), m_result(result) {}

XrResult check(XrResult result, const char* call) {
  if (XR_FAILED(result)) throw Failure(result, call);
  return result;
}

}  // namespace ps::vr
