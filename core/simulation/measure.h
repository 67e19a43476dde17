// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"

#include <string>
#include <vector>

namespace ps {

/// Phases, temperatures and energies of a solver's state, summed in a fixed order.
FrameStats measure(const Solver& solver, const StepReport& report);
/// Value of a probe now, in the unit of its quantity; means are weighted with mass, NaN where nothing matches.
/// `bodyIds`: Body::id by the particles' body index.
double measureProbe(const Solver& solver, const std::vector<std::string>& bodyIds, const Probe& probe);
/// "name.quantity[unit]"
std::string probeTitle(const Probe& probe);

/// Copies what views need.
void fillSnapshot(Snapshot& snapshot, const Solver& solver);

}  // namespace ps
