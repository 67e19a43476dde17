// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/solver/report.h"

#include <optional>

namespace ps {

/// The row that fillLimit() is about.
inline constexpr const char* kFillLimit = "solver.particle_spacing";

/// m3 of a body as its shape has it, and as particles `spacing` m apart fill it.
struct Filling {
  double asked = 0, filled = 0;
};
Filling fillingOf(const Body& body, double spacing);

/// Layers are whole: 2.5 of them become 3, and a box has a fifth more matter than its shape. Told of the body whose
/// volume is missed most, by a twentieth at least, with a spacing that fits all bodies to less, where there is one down
/// to half of the present. What is left out where bodies overlap does not count: its place is filled.
std::optional<Limit> fillLimit(const Project& project, double spacing);

}  // namespace ps
