// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/vr/runtime/state.h"

#include <string>
#include <vector>

namespace ps::scripted {

/// What an action is bound to on a controller that is there.
struct Source {
  size_t hand = 0;
  std::string component;  ///< "/input/trigger/value"
};

/// The controller that a hand holds now: the script's where the client has suggested bindings for it and it is awake,
/// "" otherwise.
std::string profileOf(const Instance& instance, size_t hand);
/// Of an action, for one hand or (-1) for both, the left first.
std::vector<Source> sourcesOf(const Instance& instance, XrAction action, int hand);
/// Tells the client where a hand's controller is another one than it knows of.
void reportProfiles(Instance& instance);

/// The hand of a subaction path that the action declares, -1 for XR_NULL_PATH. Throws Refusal
/// XR_ERROR_PATH_UNSUPPORTED for a path that it does not declare.
int subactionHand(const Instance& instance, const Action& action, XrPath path);

}  // namespace ps::scripted
