// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace ps {

/// Whose code this thread is running, by a plugin's id; nullptr: the program's own. A crash handler reads it.
inline thread_local const char* t_callee = nullptr;

/// Says so for as long as it lives, to this thread and to those who watch it. `id` must live longer.
class CalleeScope {
 public:
  explicit CalleeScope(const char* id) noexcept : m_before(t_callee) { enter(id); }
  ~CalleeScope() { enter(m_before); }
  CalleeScope(const CalleeScope&) = delete;
  CalleeScope& operator=(const CalleeScope&) = delete;

 private:
  static void enter(const char* id) noexcept;
  const char* m_before;
};

/// A call of a plugin that has not come back. Seen twice alike, it is one and the same.
struct OngoingCall {
  uint64_t thread = 0, number = 0;
  std::string id;
  bool operator==(const OngoingCall&) const = default;
};
/// Of all threads, at this moment. From any thread.
std::vector<OngoingCall> ongoingCalls();

}  // namespace ps
