// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

/// Whose code this thread is running, by a plugin's id; nullptr: the program's own. A crash handler reads it.
inline thread_local const char* t_callee = nullptr;

/// Says so for as long as it lives. `id` must live longer.
class CalleeScope {
 public:
  explicit CalleeScope(const char* id) : m_before(t_callee) { t_callee = id; }
  ~CalleeScope() { t_callee = m_before; }
  CalleeScope(const CalleeScope&) = delete;
  CalleeScope& operator=(const CalleeScope&) = delete;

 private:
  const char* m_before;
};

}  // namespace ps
