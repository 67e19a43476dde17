// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <optional>
#include <string>
#include <vector>

namespace ps {

/// Water at rest in a tank, twice as wide as high: the density solver's daily work.
Project tank(int particles);

/// A block of water that falls apart in a long box: 5 cm between particles, one substep of 2.5 ms with 8
/// iterations, no heat. The fluid part of benchmarks of position-based fluids (Macklin & Müller 2013) elsewhere, so
/// that figures may be compared.
Project damBreak(int particles);

/// The scenes of liquid alone that bench makes, by name; those that plugins hold together are files in projects/bench.
std::vector<std::string> benchSceneNames();
/// One of them, with about so many particles where that is asked for; nothing for another name.
std::optional<Project> benchProject(const std::string& name, std::optional<long> particles);

/// Changes the spacing so that bodies, which hold `present` particles, hold about `particles`; boxes that are one
/// particle thick stay so.
void scaleTo(Project& project, long particles, size_t present);

}  // namespace ps
