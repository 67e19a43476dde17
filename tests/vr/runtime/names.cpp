// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/names.h"

#include <openxr/openxr_reflection.h>

#include <iterator>

namespace ps::scripted {
namespace {

struct Name {
  int64_t value;
  std::string_view text;
};

#define PS_NAME(symbol, number) {number, #symbol},
constexpr Name kResults[] = {XR_LIST_ENUM_XrResult(PS_NAME)};
constexpr Name kTypes[] = {XR_LIST_ENUM_XrStructureType(PS_NAME)};
constexpr Name kStates[] = {XR_LIST_ENUM_XrSessionState(PS_NAME)};
#undef PS_NAME

constexpr std::string_view kStatePrefix = "XR_SESSION_STATE_";

template <size_t N>
const Name* withValue(const Name (&names)[N], int64_t value) {
  for (const Name& name : names)
    if (name.value == value) return &name;
  return nullptr;
}

template <size_t N>
const Name* withText(const Name (&names)[N], std::string_view text) {
  for (const Name& name : names)
    if (name.text == text) return &name;
  return nullptr;
}

}  // namespace

std::string nameOf(XrResult result) {
  if (const Name* name = withValue(kResults, result)) return std::string(name->text);
  return (result < 0 ? "XR_UNKNOWN_FAILURE_" : "XR_UNKNOWN_SUCCESS_") + std::to_string(result);
}

std::string nameOf(XrStructureType type) {
  if (const Name* name = withValue(kTypes, type)) return std::string(name->text);
  return "XR_UNKNOWN_STRUCTURE_TYPE_" + std::to_string(type);
}

std::string nameOf(XrSessionState state) {
  if (const Name* name = withValue(kStates, state)) return std::string(name->text.substr(kStatePrefix.size()));
  return std::to_string(state);
}

std::optional<XrResult> resultNamed(std::string_view text) {
  const Name* name = withText(kResults, text);
  return name ? std::optional(static_cast<XrResult>(name->value)) : std::nullopt;
}

std::optional<XrSessionState> stateNamed(std::string_view text) {
  const Name* name = withText(kStates, std::string(kStatePrefix) + std::string(text));
  return name ? std::optional(static_cast<XrSessionState>(name->value)) : std::nullopt;
}

}  // namespace ps::scripted
