// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/runtime.h"

#include <cstdio>

namespace ps::vr {
namespace {

// The loader tells a missing runtime by one of several results, of which two may mean other things elsewhere.
XrResult checkLoader(XrResult result, const char* call) {
  const bool none = result == XR_ERROR_RUNTIME_FAILURE || result == XR_ERROR_FILE_ACCESS_ERROR ||
                    result == XR_ERROR_FILE_CONTENTS_INVALID || result == XR_ERROR_INITIALIZATION_FAILED;
  return check(none ? XR_ERROR_RUNTIME_UNAVAILABLE : result, call);
}

std::set<std::string, std::less<>> offeredExtensions() {
  constexpr const char* kCall = "xrEnumerateInstanceExtensionProperties";
  uint32_t count = 0;
  checkLoader(xrEnumerateInstanceExtensionProperties(nullptr, 0, &count, nullptr), kCall);
  std::vector<XrExtensionProperties> list(count, structure<XrExtensionProperties>(XR_TYPE_EXTENSION_PROPERTIES));
  checkLoader(xrEnumerateInstanceExtensionProperties(nullptr, count, &count, list.data()), kCall);
  std::set<std::string, std::less<>> names;
  for (const XrExtensionProperties& extension : list) names.insert(extension.extensionName);
  return names;
}

}  // namespace

Runtime::Runtime(const std::vector<std::string>& wishes) {
  create(wishes);
  try {
    auto info = structure<XrSystemGetInfo>(XR_TYPE_SYSTEM_GET_INFO);
    info.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
    check(xrGetSystem(m_instance, &info, &m_system), "xrGetSystem");
  } catch (...) {
    xrDestroyInstance(m_instance);
    throw;
  }
}

void Runtime::create(const std::vector<std::string>& wishes) {
  const auto offered = offeredExtensions();
  if (!offered.count(XR_KHR_OPENGL_ENABLE_EXTENSION_NAME))
    throw Error("The headset's software does not show OpenGL's pictures; choose another OpenXR runtime.");
  m_extensions.insert(XR_KHR_OPENGL_ENABLE_EXTENSION_NAME);
  for (const std::string& wish : wishes)
    if (offered.count(wish)) m_extensions.insert(wish);
  std::vector<const char*> names;
  for (const std::string& name : m_extensions) names.push_back(name.c_str());

  auto info = structure<XrInstanceCreateInfo>(XR_TYPE_INSTANCE_CREATE_INFO);
  std::snprintf(info.applicationInfo.applicationName, sizeof info.applicationInfo.applicationName, "PhaseSketch");
  info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
  info.enabledExtensionCount = static_cast<uint32_t>(names.size());
  info.enabledExtensionNames = names.data();
  XrResult result = xrCreateInstance(&info, &m_instance);
  // The loader may remember what another runtime offered, whom it has asked before; having failed, it forgets.
  if (result == XR_ERROR_EXTENSION_NOT_PRESENT) result = xrCreateInstance(&info, &m_instance);
  checkLoader(result, "xrCreateInstance");
}

Runtime::~Runtime() { xrDestroyInstance(m_instance); }

XrPath Runtime::path(const std::string& text) const {
  XrPath path = XR_NULL_PATH;
  check(xrStringToPath(m_instance, text.c_str(), &path), "xrStringToPath");
  return path;
}

std::optional<XrEventDataBuffer> Runtime::nextEvent() {
  auto event = structure<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
  if (check(xrPollEvent(m_instance, &event), "xrPollEvent") == XR_EVENT_UNAVAILABLE) return {};
  return event;
}

PFN_xrVoidFunction Runtime::address(const char* name) const {
  PFN_xrVoidFunction found = nullptr;
  check(xrGetInstanceProcAddr(m_instance, name, &found), name);
  return found;
}

}  // namespace ps::vr
