// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/engine.h"

#include <functional>

namespace ps {

/// Asked after each frame whether a run shall end early.
using StopTest = std::function<bool()>;
/// What a frame left behind.
using FrameVisitor = std::function<void(const StepReport&, const FrameStats&)>;

/// s, one frame.
double frameLength(const Project& project);

/// Runs frames and hands each one over; false when `stop` or a broken state ended them early.
bool runFrames(Engine& engine, long frames, const FrameVisitor& each, const StopTest& stop);

}  // namespace ps
