// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <optional>

// Steps with which matter does not sink into itself. In a substep of length h what lies below n layers of spacing d
// gives way by about g h^2 n / d of itself, and passes divide that by their number. A block of ice of 27 layers of 4 mm
// that melts from below is 69 % too dense there with 4 substeps and 4 iterations, 3 % with 9 substeps, and 1.4 % with
// 16; 8 substeps with 16 iterations reach the same and take 2.5 times as long (Macklin et al. 2019, Small steps in
// physics simulation). So substeps are raised.
namespace ps {

struct FinerSteps {
  int substeps = 0, iterations = 0;
  bool operator==(const FinerSteps&) const = default;
};

/// For a scene whose liquid is squeezed more than the solver can mend: up to four times its substeps, and the default's
/// iterations where it has fewer. Nothing where no more substeps can be had, or a track leads either of them.
std::optional<FinerSteps> finerSteps(const Project& project);

/// Substeps with which as many layers rest on each other at the spacing of a scene as with the defaults at theirs.
/// Nothing where that is less than twice the default, or where somebody has chosen substeps, iterations or the frame.
std::optional<int> substepsAtSpacing(const Project& project);

}  // namespace ps
