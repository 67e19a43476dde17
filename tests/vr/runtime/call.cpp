// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/call.h"

#include "tests/vr/runtime/graphics.h"
#include "tests/vr/runtime/names.h"

#include <chrono>

namespace ps::scripted {

Runtime& runtime() {
  static Runtime instance;
  return instance;
}

std::optional<XrResult> answerInstead(Instance& instance, std::string_view function, bool ofSession) {
  if (function.starts_with("xrDestroy")) return {};  // whatever was lost can be put away
  const auto note = [&](XrResult result) {
    instance.log.write({{"failed", function}, {"result", nameOf(result)}, {"frame", instance.frame}});
    return result;
  };
  if (instance.death != XR_SUCCESS) return note(instance.death);
  if (ofSession && instance.session && instance.session->lost) return note(XR_ERROR_SESSION_LOST);
  const auto failure = instance.failures.find(function);
  if (failure == instance.failures.end()) return {};
  if (failure->second.after > 0) {
    --failure->second.after;
    return {};
  }
  const XrResult result = failure->second.result;
  if (--failure->second.times == 0) instance.failures.erase(failure);
  return note(result);
}

void hangWhereTold(Instance& instance, std::string_view function) {
  if (!instance.hangs || instance.hangs->function != function) return;
  const auto until = std::chrono::steady_clock::now() + instance.hangs->lasts;
  instance.hangs.reset();
  std::condition_variable_any never;
  never.wait_until(runtime().mutex, until, [] { return false; });
}

void stealContextWhereTold(const Instance& instance, std::string_view function) {
  if (instance.stealsContext == function) leaveNoContext();
}

void noteViolation(Instance& instance, std::string_view function, const Refusal& refusal) {
  instance.log.write({{"violation", refusal.what()},
                      {"call", function},
                      {"result", nameOf(refusal.result())},
                      {"frame", instance.frame}});
}

}  // namespace ps::scripted
