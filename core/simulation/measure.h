// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/particlefield.h"
#include "core/simulation/snapshot.h"
#include "core/solver/solver.h"

#include <span>
#include <string>
#include <vector>

namespace ps {

/// m²/s²
inline double squaredSpeed(const api::Float4& v) { return double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z; }
/// Phases, temperatures and energies of a solver's state, summed in a fixed order.
FrameStats measure(const Solver& solver, const StepReport& report);
/// What probes look at.
struct ProbeView {
  const Solver& solver;
  const std::vector<std::string>& bodyIds;  ///< Body::id by the particles' body index
  const ParticleFields& fields;
  std::vector<Wall> walls{};
  double spacing = 0;                      ///< m, of the particles
  std::span<const Vector3> start{};        ///< m, places at the start by the particles' ids
  std::vector<std::string> materialIds{};  ///< SceneMaterial::id by the particles' material index
};
/// Value of a probe now, in the unit of its quantity; means are weighted with mass, NaN where nothing matches. Fixed
/// particles are seen by probes that say so alone, but count as other bodies.
double measureProbe(const ProbeView& view, const Probe& probe);
/// "name.quantity[unit]"
std::string probeTitle(const Probe& probe, const ParticleFields& fields);

/// Copies what views need, and these fields as far as it has them.
void fillSnapshot(Snapshot& snapshot, const Solver& solver, std::span<const FieldPtr> shown);

}  // namespace ps
