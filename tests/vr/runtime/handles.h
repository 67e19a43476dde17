// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/vr/runtime/refusal.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace ps::scripted {

/// A number that no object has had, so that a handle of one that is gone, or of another kind, is told.
uint64_t nextHandle();

/// The objects behind one type of handles, in the order in which they were made.
template <class Handle, class Object>
class Handles {
 public:
  Handle add(Object object) {
    const uint64_t number = nextHandle();
    m_objects.emplace(number, std::make_unique<Object>(std::move(object)));
    return reinterpret_cast<Handle>(number);
  }
  /// Throws Refusal XR_ERROR_HANDLE_INVALID.
  Object& at(Handle handle) {
    const auto it = m_objects.find(reinterpret_cast<uint64_t>(handle));
    if (it == m_objects.end()) throw Refusal(XR_ERROR_HANDLE_INVALID, "the handle is of nothing that exists");
    return *it->second;
  }
  void erase(Handle handle) { m_objects.erase(reinterpret_cast<uint64_t>(handle)); }
  void clear() { m_objects.clear(); }
  template <class Use>
  void each(Use use) {
    for (auto& [number, object] : m_objects) use(reinterpret_cast<Handle>(number), *object);
  }
  template <class Condition>
  void eraseIf(Condition condition) {
    std::erase_if(m_objects, [&](const auto& entry) { return condition(*entry.second); });
  }
  size_t size() const { return m_objects.size(); }

 private:
  std::map<uint64_t, std::unique_ptr<Object>> m_objects;
};

}  // namespace ps::scripted
