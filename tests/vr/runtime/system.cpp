// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/functions.h"
#include "tests/vr/runtime/limits.h"
#include "tests/vr/runtime/timeline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace ps::scripted {
namespace {

constexpr XrSystemId kHeadset = 1;

void checkSystem(XrSystemId system) {
  require(system == kHeadset, XR_ERROR_SYSTEM_INVALID, "there is no system of that number");
}

void checkViews(XrSystemId system, XrViewConfigurationType type) {
  checkSystem(system);
  requireStereo(type);
}

}  // namespace

void requireStereo(XrViewConfigurationType type) {
  require(type == XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED,
          "the headset has two eyes: XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO");
}

XrResult getSystem(Instance&, XrInstance, const XrSystemGetInfo* info, XrSystemId* system) {
  require(typed(info, XR_TYPE_SYSTEM_GET_INFO).formFactor == XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY,
          XR_ERROR_FORM_FACTOR_UNSUPPORTED, "there are headsets only");
  wanted(system) = kHeadset;
  return XR_SUCCESS;
}

XrResult getSystemProperties(Instance& instance, XrInstance, XrSystemId system, XrSystemProperties* properties) {
  checkSystem(system);
  typed(properties, XR_TYPE_SYSTEM_PROPERTIES).systemId = system;
  properties->vendorId = 0;
  std::snprintf(properties->systemName, sizeof properties->systemName, "Scripted headset");
  properties->graphicsProperties = {kMaximumPixels, kMaximumPixels, kMaximumLayers};
  properties->trackingProperties = {XR_TRUE, XR_TRUE};
  auto* next = static_cast<XrBaseOutStructure*>(properties->next);
  for (; next; next = next->next)
    if (next->type == XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT)
      reinterpret_cast<XrSystemHandTrackingPropertiesEXT*>(next)->supportsHandTracking =
          instance.script.seesHands ? XR_TRUE : XR_FALSE;
  return XR_SUCCESS;
}

XrResult enumerateViewConfigurations(Instance&, XrInstance, XrSystemId system, uint32_t capacity, uint32_t* count,
                                     XrViewConfigurationType* types) {
  checkSystem(system);
  return enumerate(std::array{XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO}, capacity, count, types);
}

XrResult getViewConfigurationProperties(Instance&, XrInstance, XrSystemId system, XrViewConfigurationType type,
                                        XrViewConfigurationProperties* properties) {
  checkViews(system, type);
  typed(properties, XR_TYPE_VIEW_CONFIGURATION_PROPERTIES).viewConfigurationType = type;
  properties->fovMutable = XR_FALSE;
  return XR_SUCCESS;
}

XrResult enumerateViewConfigurationViews(Instance& instance, XrInstance, XrSystemId system,
                                         XrViewConfigurationType type, uint32_t capacity, uint32_t* count,
                                         XrViewConfigurationView* views) {
  checkViews(system, type);
  return enumerate(kEyes, capacity, count, views, [&](size_t, XrViewConfigurationView& view) {
    typed(&view, XR_TYPE_VIEW_CONFIGURATION_VIEW);
    view.recommendedImageRectWidth = static_cast<uint32_t>(instance.script.width);
    view.recommendedImageRectHeight = static_cast<uint32_t>(instance.script.height);
    view.maxImageRectWidth = view.maxImageRectHeight = kMaximumPixels;
    view.recommendedSwapchainSampleCount = view.maxSwapchainSampleCount = 1;
  });
}

XrResult enumerateEnvironmentBlendModes(Instance&, XrInstance, XrSystemId system, XrViewConfigurationType type,
                                        uint32_t capacity, uint32_t* count, XrEnvironmentBlendMode* modes) {
  checkViews(system, type);
  return enumerate(std::array{XR_ENVIRONMENT_BLEND_MODE_OPAQUE}, capacity, count, modes);
}

XrResult getOpenGLGraphicsRequirements(Instance& instance, XrInstance, XrSystemId system,
                                       XrGraphicsRequirementsOpenGLKHR* requirements) {
  checkSystem(system);
  typed(requirements, XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR);
  requirements->minApiVersionSupported = XR_MAKE_VERSION(3, 3, 0);
  requirements->maxApiVersionSupported = XR_MAKE_VERSION(4, 6, 0);
  instance.graphicsAsked = true;
  return XR_SUCCESS;
}

// What a lens does not show: the four corners, a triangle each, at the distance 1 from the eye.
XrResult getVisibilityMask(Instance& instance, XrSession handle, XrViewConfigurationType type, uint32_t view,
                           XrVisibilityMaskTypeKHR kind, XrVisibilityMaskKHR* mask) {
  sessionOf(instance, handle);
  requireStereo(type);
  require(view < kEyes, XR_ERROR_VALIDATION_FAILURE, "there is no such eye");
  require(kind == XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR, XR_ERROR_VALIDATION_FAILURE,
          "this runtime has a mask of hidden triangles only");
  typed(mask, XR_TYPE_VISIBILITY_MASK_KHR);
  if (instance.script.hiddenCorners <= 0) {
    mask->vertexCountOutput = mask->indexCountOutput = 0;
    return XR_SUCCESS;
  }
  const float edge = std::tan(instance.script.fieldOfView / 2), inner = (1 - instance.script.hiddenCorners) * edge;
  constexpr float kSigns[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const auto vertex = [&](size_t i, XrVector2f& place) {
    const auto& [x, y] = kSigns[i / 3];
    const std::array<XrVector2f, 3> corner = {{{x * edge, y * edge}, {x * inner, y * edge}, {x * edge, y * inner}}};
    const bool turned = x * y < 0;  // all counter-clockwise
    place = corner[i % 3 == 0 || !turned ? i % 3 : 3 - i % 3];
  };
  enumerate(12, mask->indexCapacityInput, &mask->indexCountOutput, mask->indices,
            [](size_t i, uint32_t& index) { index = static_cast<uint32_t>(i); });
  return enumerate(12, mask->vertexCapacityInput, &mask->vertexCountOutput, mask->vertices, vertex);
}

XrResult enumerateDisplayRefreshRates(Instance& instance, XrSession handle, uint32_t capacity, uint32_t* count,
                                      float* rates) {
  sessionOf(instance, handle);
  return enumerate(instance.script.refreshRates, capacity, count, rates);
}

XrResult getDisplayRefreshRate(Instance& instance, XrSession handle, float* rate) {
  sessionOf(instance, handle);
  wanted(rate) = 1e9f / static_cast<float>(instance.clock.period);
  return XR_SUCCESS;
}

XrResult requestDisplayRefreshRate(Instance& instance, XrSession handle, float rate) {
  sessionOf(instance, handle);
  if (rate == 0) return XR_SUCCESS;  // no wish
  const std::vector<float>& offered = instance.script.refreshRates;
  require(std::find(offered.begin(), offered.end(), rate) != offered.end(),
          XR_ERROR_DISPLAY_REFRESH_RATE_UNSUPPORTED_FB, "that refresh rate was not among those that were listed");
  changeRefreshRate(instance, rate);
  return XR_SUCCESS;
}

}  // namespace ps::scripted
