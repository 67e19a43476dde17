// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/command.h"
#include "core/simulation/events.h"

namespace ps {

/// An event of the exception at hand: what it says, whose value is to blame, and PluginFault where a plugin failed;
/// Cancelled where that was it.
/// Call it in a catch block.
EngineEvent failureAtHand(EngineEvent::Kind kind);

/// The same of one value that was refused; `present`: the project that goes on.
EngineEvent refusalOf(const SetParameter& edit, const Project& present, EngineEvent failure);

}  // namespace ps
