// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/vr/runtime/state.h"

#include <optional>

namespace ps::scripted {

/// Where a space is in the stage at a frame, whole or not; nothing where nobody knows.
std::optional<XrPosef> originAt(Instance& instance, const Space& space, double frame);

}  // namespace ps::scripted
