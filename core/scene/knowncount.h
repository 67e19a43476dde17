// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <optional>

namespace ps {

/// Particles of a body at the start where they can be told without making them: of boxes and blocks, which are whole
/// layers, and of sketches that were drawn at this spacing (m). See particleCount() for others.
std::optional<double> knownCount(const Body& body, double spacing);

}  // namespace ps
