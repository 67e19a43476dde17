// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/vr/runtime/state.h"

// The virtual clock. It stands still but for frames: each xrWaitFrame() is one, and each xrPollEvent() that finds
// nothing while a session exists that does not run (a headset that lies on the table), so that a client that waits for
// its turn gets it.
namespace ps::scripted {

/// When a frame is shown.
XrTime timeOf(const Instance& instance, int64_t frame);
/// The frame, whole or not, of a time.
double frameOf(const Instance& instance, XrTime time);

/// Frames last as long as `rate` in Hz says, from the present one on; the client is told where it asked to be.
void changeRefreshRate(Instance& instance, float rate);

/// Goes to the next frame, and does what the script has for it.
void nextFrame(Instance& instance);
/// Does what the script has up to the present frame.
void applyEvents(Instance& instance);

}  // namespace ps::scripted
