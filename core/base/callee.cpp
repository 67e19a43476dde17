// SPDX-License-Identifier: Apache-2.0
#include "core/base/callee.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <mutex>

// Why each thread keeps a copy of the name: whoever watches reads it at any time, also when the call has just come back
// and the solver that held the name is gone. Why words and a number that is odd meanwhile: a batch must not wait for a
// lock, and a watcher that met the writing looks again later.
namespace ps {
namespace {

constexpr size_t kWords = 16;  ///< of 8 bytes: a name beyond that is cut

struct ThreadCall {
  std::atomic<uint64_t> number{0};
  std::array<std::atomic<uint64_t>, kWords> id{};  ///< ends with a zero
  uint64_t thread = 0;
  ThreadCall* next = nullptr;
  ThreadCall();
  ~ThreadCall();
};

struct Threads {
  std::mutex mutex;
  ThreadCall* first = nullptr;
  uint64_t count = 0;
};
Threads& threads() {
  static auto& all = *new Threads;  // threads may end after everything else
  return all;
}

ThreadCall::ThreadCall() {
  Threads& all = threads();
  const std::lock_guard lock(all.mutex);
  thread = ++all.count;
  next = all.first;
  all.first = this;
}

ThreadCall::~ThreadCall() {
  Threads& all = threads();
  const std::lock_guard lock(all.mutex);
  ThreadCall** place = &all.first;
  while (*place != this) place = &(*place)->next;
  *place = next;
}

thread_local ThreadCall t_call;

}  // namespace

void CalleeScope::enter(const char* id) noexcept {
  t_callee = id;
  ThreadCall& call = t_call;
  const uint64_t number = call.number.load(std::memory_order_relaxed);
  call.number.store(number + 1, std::memory_order_relaxed);
  const size_t length = id ? std::min(std::strlen(id), kWords * 8 - 1) : 0;
  for (size_t word = 0; word * 8 <= length; ++word) {
    char text[8]{};
    std::memcpy(text, id ? id + word * 8 : text, std::min<size_t>(8, length - word * 8));
    uint64_t packed = 0;
    std::memcpy(&packed, text, sizeof packed);
    call.id[word].store(packed, std::memory_order_release);
  }
  call.number.store(number + 2, std::memory_order_release);
}

std::vector<OngoingCall> ongoingCalls() {
  std::vector<OngoingCall> calls;
  Threads& all = threads();
  const std::lock_guard lock(all.mutex);
  for (const ThreadCall* call = all.first; call; call = call->next) {
    const uint64_t number = call->number.load(std::memory_order_acquire);
    char text[kWords * 8];
    for (size_t word = 0; word < kWords; ++word) {
      const uint64_t packed = call->id[word].load(std::memory_order_acquire);
      std::memcpy(text + word * 8, &packed, sizeof packed);
    }
    text[sizeof text - 1] = 0;
    if (number % 2 == 0 && *text && call->number.load(std::memory_order_acquire) == number)
      calls.push_back({call->thread, number, text});
  }
  return calls;
}

}  // namespace ps
