// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"

#include <string>
#include <vector>

namespace ps {

/// Phases, temperatures and energies of a solver's state, summed in a fixed order.
FrameStats measure(const Solver& solver, const StepReport& report);
/// Value of a probe now, in the unit of its quantity; NaN where nothing matches (a mean over no particles).
double measureProbe(const Solver& solver, const Project& project, const Probe& probe);
/// "name.quantity[unit]"
std::string probeTitle(const Probe& probe);

/// Copies what views need.
void fillSnapshot(Snapshot& snapshot, const Solver& solver);

}  // namespace ps
