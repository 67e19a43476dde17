// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <openxr/openxr.h>

#include <stdexcept>
#include <string>

namespace ps::scripted {

/// A call that breaks the specification: it ends with this result, and the log tells why.
class Refusal : public std::runtime_error {
 public:
  Refusal(XrResult result, const std::string& why) : std::runtime_error(why), m_result(result) {}
  XrResult result() const { return m_result; }

 private:
  XrResult m_result;
};

inline void require(bool holds, XrResult result, const std::string& why) {
  if (!holds) throw Refusal(result, why);
}

/// Checks the type of a structure that the client gave. Throws Refusal XR_ERROR_VALIDATION_FAILURE.
template <class Structure>
const Structure& typed(const Structure* structure, XrStructureType type) {
  require(structure && structure->type == type, XR_ERROR_VALIDATION_FAILURE,
          "a structure is missing or of a wrong type");
  return *structure;
}
template <class Structure>
Structure& typed(Structure* structure, XrStructureType type) {
  typed(static_cast<const Structure*>(structure), type);
  return *structure;
}
template <class Value>
Value& wanted(Value* place) {
  require(place != nullptr, XR_ERROR_VALIDATION_FAILURE, "a pointer for what is asked is missing");
  return *place;
}

/// The structure of that type in a chain, or nullptr.
template <class Structure>
const Structure* chained(const void* chain, XrStructureType type) {
  for (auto* link = static_cast<const XrBaseInStructure*>(chain); link; link = link->next)
    if (link->type == type) return reinterpret_cast<const Structure*>(link);
  return nullptr;
}

/// The idiom of two calls: tells the count, and gives the elements where there is room. write(i, element) fills one.
template <class Element, class Write>
XrResult enumerate(size_t size, uint32_t capacity, uint32_t* count, Element* elements, Write write) {
  wanted(count) = static_cast<uint32_t>(size);
  if (capacity == 0) return XR_SUCCESS;
  require(capacity >= size, XR_ERROR_SIZE_INSUFFICIENT, "the list has no room for all");
  wanted(elements);
  for (size_t i = 0; i < size; ++i) write(i, elements[i]);
  return XR_SUCCESS;
}
template <class List, class Element>
XrResult enumerate(const List& list, uint32_t capacity, uint32_t* count, Element* elements) {
  return enumerate(list.size(), capacity, count, elements, [&](size_t i, Element& element) { element = list[i]; });
}

}  // namespace ps::scripted
