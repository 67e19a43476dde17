// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"
#include "ui/session/selection.h"

#include <vector>

namespace ps {

/// m, of the particles of selected bodies that are held where they are while others of these bodies go: by an edge, an
/// end, a pin. Of what is held as a whole, or not yet let go, none: there is nothing to tell apart.
std::vector<Vector3> heldPlaces(const Project& project, const Selection& selection, const Snapshot& now);

}  // namespace ps
