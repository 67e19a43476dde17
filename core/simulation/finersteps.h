// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <optional>

// Steps with which matter does not sink into itself. In a substep of length h what lies below n layers of spacing d
// gives way by about g h^2 n / d of itself, and passes divide that by their number. A block of ice of 27 layers of 4 mm
// that melts from below (heat 200 times as fast, its first half second, error in the mean of the liquid): 25 % with 4
// substeps and 4 iterations, 3.5 % with 9 and 4, 1.2 % with 16 and 4, as with 8 and 16, which takes as long or longer;
// in two thirds of a second 7 % with 4 and 8, 4 % with 8 and 4. So substeps are raised (Macklin et al. 2019, Small
// steps in physics simulation).
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
