// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/callee.h"

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>

namespace ps {

/// How long a brush may take for what a hand did since it was asked last; it takes some microseconds. Counted in looks,
/// so that a program that was stopped accuses nobody.
inline constexpr std::chrono::milliseconds kBrushLook{100};
inline constexpr int kBrushLooks = 20;
/// What is said of a brush that took longer.
inline constexpr const char* kNotBack = "it does not come back";

/// On a thread that nobody waits for; here where none is to be had.
template <class Task>
void runDetached(Task task) {
  const auto shared = std::make_shared<Task>(std::move(task));
  try {
    std::thread([shared] { (*shared)(); }).detach();
  } catch (const std::system_error&) {
    (*shared)();
  }
}

/// What a brush gives, called on a thread of its own: one that does not come back must not take the window along, which
/// waits for it. nullopt: it has not come back in time; the call goes on, and what it gives then is dropped. Throws
/// what the call throws. `work` owns all that it needs.
template <class Work>
std::optional<std::invoke_result_t<Work&>> inTime(const std::string& brush, Work work) {
  std::packaged_task<std::invoke_result_t<Work&>()> task([brush, work = std::move(work)]() mutable {
    const CalleeScope callee(brush.c_str());
    return work();
  });
  auto result = task.get_future();
  runDetached(std::move(task));
  for (int look = 0; look < kBrushLooks; ++look)
    if (result.wait_for(kBrushLook) == std::future_status::ready) return result.get();
  return std::nullopt;
}

}  // namespace ps
