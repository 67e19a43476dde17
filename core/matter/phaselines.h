// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/phasediagram.h"

#include <optional>
#include <vector>

namespace ps {

struct PhasePoint {
  double temperature = 0, pressure = 0;  ///< K, Pa
};

/// The lines of a diagram over temperature and pressure, as they are drawn; each by pressure, lowest first, and empty
/// where the substance has none in the range.
struct PhaseLines {
  std::vector<PhasePoint> melting, boiling, sublimation;
  /// Also where they lie outside of the range. The critical point is where the boiling line of PhaseDiagram comes to
  /// the critical temperature, where it ends: its pressure follows from that line and may be half of the true one
  /// (water: 12 instead of 22 MPa).
  std::optional<PhasePoint> triple, critical;
};

/// Between two pressures in Pa, 0 < lowest < highest.
PhaseLines phaseLines(const PhaseDiagram& diagram, double lowest, double highest);

}  // namespace ps
