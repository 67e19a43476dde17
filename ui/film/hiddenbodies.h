// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/simulation/snapshot.h"

#include <set>
#include <string>

namespace ps {

/// By their ids; of a tap that is hidden too, whose matter goes by its id as a body's does.
std::set<std::string> hiddenBodies(const Project& project);
/// The snapshot without the particles of some bodies; the same one when none is hidden.
SnapshotPtr withoutBodies(const SnapshotPtr& snapshot, const std::set<std::string>& hidden);

}  // namespace ps
