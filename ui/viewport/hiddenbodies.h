// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"

#include <set>
#include <string>

namespace ps {

/// The snapshot without the particles of some bodies; the same one when none is hidden.
SnapshotPtr withoutBodies(const SnapshotPtr& snapshot, const std::set<std::string>& hidden);

}  // namespace ps
