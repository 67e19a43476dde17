// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/failure.h"
#include "ui/vr/openxr.h"

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ps::vr {

/// An empty structure of a type of OpenXR.
template <class Structure>
Structure structure(XrStructureType type) {
  Structure empty{};
  empty.type = type;
  return empty;
}

/// What a call of OpenXR lists: call(room, &count, elements), asked for the number first. Throws Failure.
template <class Element, class Call>
std::vector<Element> listed(const char* name, const Call& call, const Element& empty = {}) {
  uint32_t count = 0;
  check(call(0, &count, static_cast<Element*>(nullptr)), name);
  std::vector<Element> all(count, empty);
  check(call(count, &count, all.data()), name);
  all.resize(count);
  return all;
}

/// The headset's software, which OpenXR's loader finds, and the headset that it has.
class Runtime {
 public:
  /// Enables OpenGL, and of the extensions that are wished those that are offered. Throws Error where no runtime runs,
  /// it has no headset, or does not show OpenGL's pictures.
  explicit Runtime(const std::vector<std::string>& wishes);
  ~Runtime();
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;

  XrInstance instance() const { return m_instance; }
  XrSystemId system() const { return m_system; }
  bool has(std::string_view extension) const { return m_extensions.count(extension) > 0; }
  XrPath path(const std::string& text) const;
  /// Throws Failure when the runtime is lost.
  std::optional<XrEventDataBuffer> nextEvent();
  /// Of an extension that is enabled. Throws Failure.
  template <class Function>
  Function function(const char* name) const {
    return reinterpret_cast<Function>(address(name));
  }

 private:
  void create(const std::vector<std::string>& wishes);
  PFN_xrVoidFunction address(const char* name) const;

  XrInstance m_instance = XR_NULL_HANDLE;
  XrSystemId m_system = XR_NULL_SYSTEM_ID;
  std::set<std::string, std::less<>> m_extensions;
};

}  // namespace ps::vr
