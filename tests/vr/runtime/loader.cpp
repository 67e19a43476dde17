// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/call.h"
#include "tests/vr/runtime/functions.h"
#include "tests/vr/runtime/timeline.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>

// What OpenXR's loader asks a runtime for: xrNegotiateLoaderRuntimeInterface() gives it xrGetInstanceProcAddr(), and
// that all others.
namespace ps::scripted {

// Debian 12 does not install the loader's own header; these two are the structures of its interface 1 (OpenXR loader
// specification, "Runtime interface negotiation").
struct LoaderInfo {
  int32_t structType;
  uint32_t structVersion;
  size_t structSize;
  uint32_t minimumInterface, maximumInterface;
  XrVersion minimumApi, maximumApi;
};
struct RuntimeRequest {
  int32_t structType;
  uint32_t structVersion;
  size_t structSize;
  uint32_t interfaceVersion;
  XrVersion apiVersion;
  PFN_xrGetInstanceProcAddr getInstanceProcAddr;
};

namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

// A script that cannot be read is told where a test looks first, and in the log.
std::optional<Script> readScript() {
  try {
    Script script(environment("PS_XR_SCRIPT"));
    const std::string without = "," + environment("PS_XR_WITHOUT") + ",";
    std::erase_if(script.extensions,
                  [&](const std::string& name) { return without.find("," + name + ",") != std::string::npos; });
    return script;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scripted OpenXR runtime: %s\n", error.what());
    Log(environment("PS_XR_LOG")).write({{"script", error.what()}});
    return {};
  }
}

void writeText(const std::string& text, char* place, size_t room) { std::snprintf(place, room, "%s", text.c_str()); }

XRAPI_ATTR XrResult XRAPI_CALL enumerateInstanceExtensionProperties(const char* layer, uint32_t capacity,
                                                                    uint32_t* count, XrExtensionProperties* list) {
  if (layer) return XR_ERROR_API_LAYER_NOT_PRESENT;
  const std::optional<Script> script = readScript();
  if (!script) return XR_ERROR_RUNTIME_FAILURE;
  try {
    return enumerate(script->extensions.size(), capacity, count, list, [&](size_t i, XrExtensionProperties& extension) {
      typed(&extension, XR_TYPE_EXTENSION_PROPERTIES).extensionVersion = 1;
      writeText(script->extensions[i], extension.extensionName, sizeof extension.extensionName);
    });
  } catch (const Refusal& refusal) {
    return refusal.result();
  }
}

XRAPI_ATTR XrResult XRAPI_CALL enumerateApiLayerProperties(uint32_t, uint32_t* count, XrApiLayerProperties*) {
  if (!count) return XR_ERROR_VALIDATION_FAILURE;
  *count = 0;  // layers are the loader's
  return XR_SUCCESS;
}

void start(Instance& instance, const XrInstanceCreateInfo& info) {
  typed(&info, XR_TYPE_INSTANCE_CREATE_INFO);
  require(XR_VERSION_MAJOR(info.applicationInfo.apiVersion) == 1, XR_ERROR_API_VERSION_UNSUPPORTED,
          "the runtime has OpenXR 1");
  const auto& offered = instance.script.extensions;
  for (uint32_t i = 0; i < info.enabledExtensionCount; ++i) {
    const std::string name = info.enabledExtensionNames[i];
    require(std::find(offered.begin(), offered.end(), name) != offered.end(), XR_ERROR_EXTENSION_NOT_PRESENT,
            name + ": is not offered");
    instance.extensions.insert(name);
  }
  instance.profile = instance.script.profile;
  instance.clock.period = std::llround(1e9 * instance.script.period);
  instance.log.write({{"instance", info.applicationInfo.applicationName}, {"extensions", instance.extensions}});
  applyEvents(instance);
}

XRAPI_ATTR XrResult XRAPI_CALL createInstance(const XrInstanceCreateInfo* info, XrInstance* handle) {
  Runtime& own = runtime();
  const std::lock_guard lock(own.mutex);
  if (!info || !handle) return XR_ERROR_VALIDATION_FAILURE;
  if (own.instance) return XR_ERROR_LIMIT_REACHED;
  std::optional<Script> script = readScript();
  if (!script) return XR_ERROR_RUNTIME_FAILURE;
  auto instance = std::make_unique<Instance>(std::move(*script), environment("PS_XR_SCRIPT"), environment("PS_XR_LOG"));
  try {
    start(*instance, *info);
  } catch (const Refusal& refusal) {
    noteViolation(*instance, "xrCreateInstance", refusal);
    return refusal.result();
  }
  if (const auto answer = answerInstead(*instance, "xrCreateInstance", false)) return *answer;
  own.instance = std::move(instance);
  own.handle = *handle = reinterpret_cast<XrInstance>(nextHandle());
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL getInstanceProcAddr(XrInstance handle, const char* name, PFN_xrVoidFunction* function);

struct Function {
  std::string_view name, extension;
  PFN_xrVoidFunction address;
  bool withoutInstance = false;
};

template <FunctionName name, auto implementation>
Function entry(std::string_view extension = {}) {
  return {name.text, extension, reinterpret_cast<PFN_xrVoidFunction>(&Entry<name, implementation>::call)};
}

std::vector<Function> globalFunctions() {
  const auto global = [](std::string_view name, auto function) {
    return Function{name, {}, reinterpret_cast<PFN_xrVoidFunction>(function), true};
  };
  return {global("xrGetInstanceProcAddr", &getInstanceProcAddr),
          global("xrEnumerateInstanceExtensionProperties", &enumerateInstanceExtensionProperties),
          global("xrEnumerateApiLayerProperties", &enumerateApiLayerProperties),
          global("xrCreateInstance", &createInstance)};
}

std::vector<Function> instanceFunctions() {
  return {entry<"xrDestroyInstance", destroyInstance>(),
          entry<"xrGetInstanceProperties", getInstanceProperties>(),
          entry<"xrPollEvent", pollEvent>(),
          entry<"xrResultToString", resultToString>(),
          entry<"xrStructureTypeToString", structureTypeToString>(),
          entry<"xrStringToPath", stringToPath>(),
          entry<"xrPathToString", pathToString>(),
          entry<"xrGetSystem", getSystem>(),
          entry<"xrGetSystemProperties", getSystemProperties>(),
          entry<"xrEnumerateViewConfigurations", enumerateViewConfigurations>(),
          entry<"xrGetViewConfigurationProperties", getViewConfigurationProperties>(),
          entry<"xrEnumerateViewConfigurationViews", enumerateViewConfigurationViews>(),
          entry<"xrEnumerateEnvironmentBlendModes", enumerateEnvironmentBlendModes>(),
          entry<"xrGetOpenGLGraphicsRequirementsKHR", getOpenGLGraphicsRequirements>("XR_KHR_opengl_enable"),
          entry<"xrCreateActionSet", createActionSet>(),
          entry<"xrDestroyActionSet", destroyActionSet>(),
          entry<"xrCreateAction", createAction>(),
          entry<"xrDestroyAction", destroyAction>(),
          entry<"xrSuggestInteractionProfileBindings", suggestInteractionProfileBindings>()};
}

std::vector<Function> sessionFunctions() {
  return {entry<"xrCreateSession", createSession>(),
          entry<"xrDestroySession", destroySession>(),
          entry<"xrBeginSession", beginSession>(),
          entry<"xrEndSession", endSession>(),
          entry<"xrRequestExitSession", requestExitSession>(),
          entry<"xrWaitFrame", waitFrame>(),
          entry<"xrBeginFrame", beginFrame>(),
          entry<"xrEndFrame", endFrame>(),
          entry<"xrEnumerateSwapchainFormats", enumerateSwapchainFormats>(),
          entry<"xrCreateSwapchain", createSwapchain>(),
          entry<"xrDestroySwapchain", destroySwapchain>(),
          entry<"xrEnumerateSwapchainImages", enumerateSwapchainImages>(),
          entry<"xrAcquireSwapchainImage", acquireSwapchainImage>(),
          entry<"xrWaitSwapchainImage", waitSwapchainImage>(),
          entry<"xrReleaseSwapchainImage", releaseSwapchainImage>(),
          entry<"xrEnumerateReferenceSpaces", enumerateReferenceSpaces>(),
          entry<"xrCreateReferenceSpace", createReferenceSpace>(),
          entry<"xrGetReferenceSpaceBoundsRect", getReferenceSpaceBoundsRect>(),
          entry<"xrCreateActionSpace", createActionSpace>(),
          entry<"xrDestroySpace", destroySpace>(),
          entry<"xrLocateSpace", locateSpace>(),
          entry<"xrLocateViews", locateViews>(),
          entry<"xrGetVisibilityMaskKHR", getVisibilityMask>("XR_KHR_visibility_mask"),
          entry<"xrCreateHandTrackerEXT", createHandTracker>("XR_EXT_hand_tracking"),
          entry<"xrDestroyHandTrackerEXT", destroyHandTracker>("XR_EXT_hand_tracking"),
          entry<"xrLocateHandJointsEXT", locateHandJoints>("XR_EXT_hand_tracking"),
          entry<"xrEnumerateDisplayRefreshRatesFB", enumerateDisplayRefreshRates>("XR_FB_display_refresh_rate"),
          entry<"xrGetDisplayRefreshRateFB", getDisplayRefreshRate>("XR_FB_display_refresh_rate"),
          entry<"xrRequestDisplayRefreshRateFB", requestDisplayRefreshRate>("XR_FB_display_refresh_rate")};
}

std::vector<Function> inputFunctions() {
  return {entry<"xrAttachSessionActionSets", attachSessionActionSets>(),
          entry<"xrGetCurrentInteractionProfile", getCurrentInteractionProfile>(),
          entry<"xrEnumerateBoundSourcesForAction", enumerateBoundSourcesForAction>(),
          entry<"xrGetInputSourceLocalizedName", getInputSourceLocalizedName>(),
          entry<"xrSyncActions", syncActions>(),
          entry<"xrGetActionStateBoolean", getActionStateBoolean>(),
          entry<"xrGetActionStateFloat", getActionStateFloat>(),
          entry<"xrGetActionStateVector2f", getActionStateVector2f>(),
          entry<"xrGetActionStatePose", getActionStatePose>(),
          entry<"xrApplyHapticFeedback", applyHapticFeedback>(),
          entry<"xrStopHapticFeedback", stopHapticFeedback>()};
}

const std::vector<Function>& functions() {
  static const std::vector<Function> kFunctions = [] {
    std::vector<Function> all;
    for (const auto& part : {globalFunctions(), instanceFunctions(), sessionFunctions(), inputFunctions()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return kFunctions;
}

XRAPI_ATTR XrResult XRAPI_CALL getInstanceProcAddr(XrInstance handle, const char* name, PFN_xrVoidFunction* function) {
  if (!name || !function) return XR_ERROR_VALIDATION_FAILURE;
  *function = nullptr;
  Runtime& own = runtime();
  const std::lock_guard lock(own.mutex);
  if (handle != XR_NULL_HANDLE && (!own.instance || handle != own.handle)) return XR_ERROR_HANDLE_INVALID;
  const auto known =
      std::find_if(functions().begin(), functions().end(), [&](const Function& one) { return one.name == name; });
  if (known == functions().end()) return XR_ERROR_FUNCTION_UNSUPPORTED;
  if (handle == XR_NULL_HANDLE && !known->withoutInstance) return XR_ERROR_HANDLE_INVALID;
  if (!known->extension.empty() && !has(*own.instance, known->extension)) return XR_ERROR_FUNCTION_UNSUPPORTED;
  *function = known->address;
  return XR_SUCCESS;
}

}  // namespace

uint64_t nextHandle() {
  static uint64_t last = 0;
  return ++last;
}

}  // namespace ps::scripted

extern "C" __attribute__((visibility("default"))) XrResult xrNegotiateLoaderRuntimeInterface(
    const ps::scripted::LoaderInfo* loader, ps::scripted::RuntimeRequest* request) {
  if (!loader || !request || loader->minimumInterface > 1 || loader->maximumInterface < 1 ||
      request->structSize != sizeof *request)
    return XR_ERROR_INITIALIZATION_FAILED;
  request->interfaceVersion = 1;
  request->apiVersion = XR_CURRENT_API_VERSION;
  request->getInstanceProcAddr = &ps::scripted::getInstanceProcAddr;
  return XR_SUCCESS;
}
