// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/events.h"

namespace ps {

/// An event of the exception at hand: what it says, whose value is to blame, and PluginFault where a plugin failed.
/// Call it in a catch block.
EngineEvent failureAtHand(EngineEvent::Kind kind);

}  // namespace ps
