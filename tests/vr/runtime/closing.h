// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/vr/runtime/state.h"

namespace ps::scripted {

/// Ends the session with all that belongs to it. Its OpenGL context must not be current on another thread.
void closeSession(Instance& instance);
/// Deletes the swapchain's textures; the session's OpenGL context must be current.
void deleteTextures(Instance& instance, Swapchain& swapchain);

}  // namespace ps::scripted
