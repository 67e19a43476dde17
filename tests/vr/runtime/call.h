// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/vr/runtime/state.h"

#include <algorithm>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <type_traits>

// What all functions of the API have in common. Each is written as XrResult f(Instance&, arguments...); Entry makes the
// C function of it, which takes the lock, does what the script says of the function instead, finds calls after a loss,
// and notes in the log what breaks the specification.
namespace ps::scripted {

/// The one instance that there is at a time, and what guards it.
struct Runtime {
  std::mutex mutex;
  std::condition_variable_any frameBegun;  ///< xrWaitFrame() waits for it
  std::unique_ptr<Instance> instance;
  XrInstance handle = XR_NULL_HANDLE;
};
Runtime& runtime();

/// A name of a function as a template argument.
template <size_t N>
struct FunctionName {
  char text[N]{};
  constexpr FunctionName(const char (&name)[N]) { std::copy_n(name, N, text); }  // NOLINT(google-explicit-constructor)
};

/// What the call is answered with before it is carried out: by the script, after the runtime's death, or after the loss
/// of its session. Nothing where it goes on.
std::optional<XrResult> answerInstead(Instance& instance, std::string_view function, bool ofSession);
/// Lets go of the lock for as long as the script says, as a runtime does that hangs, and then comes back after all.
void hangWhereTold(Instance& instance, std::string_view function);
/// Leaves no context of OpenGL current, as runtimes may that draw with the client's own thread.
void stealContextWhereTold(const Instance& instance, std::string_view function);
/// Notes a call that breaks the specification.
void noteViolation(Instance& instance, std::string_view function, const Refusal& refusal);

/// Whether a function's first argument is a session or belongs to one, so that the session's loss concerns it.
template <class First, class...>
inline constexpr bool kOfSession = std::is_same_v<First, XrSession> || std::is_same_v<First, XrSpace> ||
                                   std::is_same_v<First, XrSwapchain> || std::is_same_v<First, XrHandTrackerEXT>;

template <FunctionName name, auto implementation>
struct Entry;

template <FunctionName name, class... Arguments, XrResult (*implementation)(Instance&, Arguments...)>
struct Entry<name, implementation> {
  static XRAPI_ATTR XrResult XRAPI_CALL call(Arguments... arguments) {
    Runtime& own = runtime();
    const std::lock_guard lock(own.mutex);
    if (!own.instance) return XR_ERROR_HANDLE_INVALID;
    Instance& instance = *own.instance;
    constexpr bool kSession = kOfSession<Arguments...>;
    constexpr bool kDestroys = std::string_view(name.text).starts_with("xrDestroy");
    hangWhereTold(instance, name.text);
    if (const auto answer = answerInstead(instance, name.text, kSession)) return *answer;
    try {
      const XrResult result = implementation(instance, arguments...);
      if constexpr (kSession && !kDestroys) stealContextWhereTold(instance, name.text);
      if constexpr (kSession && !kDestroys) {
        const bool ends = instance.session && instance.session->state == XR_SESSION_STATE_LOSS_PENDING;
        if (ends && result == XR_SUCCESS) return XR_SESSION_LOSS_PENDING;
      }
      return result;  // xrDestroyInstance() leaves no instance to look at
    } catch (const Refusal& refusal) {
      noteViolation(instance, name.text, refusal);
      return refusal.result();
    } catch (const std::exception& error) {
      noteViolation(instance, name.text, Refusal(XR_ERROR_RUNTIME_FAILURE, error.what()));
      return XR_ERROR_RUNTIME_FAILURE;
    }
  }
};

}  // namespace ps::scripted
