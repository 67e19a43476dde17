// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/simulation/snapshot.h"
#include "core/solver/solver.h"

#include <functional>
#include <map>
#include <span>

namespace ps {

/// Emitters and sinks of one run. Matter comes and goes between two frames; its energy is booked as a source in the
/// heat ledger, its amount in total().
class MatterFlow {
 public:
  /// Gives birth to an emitter's particles.
  using Birth = std::function<void(Spawn, const Emitter&)>;

  /// Takes away what the sinks hold.
  void drain(Solver& solver, const Project& project);
  /// Pours what is due between the solver's time less `dt` and its time, in layers a spacing apart, each as far down
  /// the jet as it has come since it left the mouth, so that the mean flow is speed times area whatever the frame.
  /// `bodyOf` says which body an emitter's particles are of. A place that is taken stays empty.
  void pour(Solver& solver, const Project& project, std::span<const BakedMaterial> materials, double spacing, double dt,
            const std::function<uint32_t(const Emitter&)>& bodyOf, const Birth& birth);
  const FlowTotal& total() const { return m_total; }

 private:
  std::map<std::string, double> m_travelled;  ///< m, of the jet since its last layer, by Emitter::id
  FlowTotal m_total;
};

}  // namespace ps
