// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/solver/heat/heatpairs.h"
#include "core/solver/heat/heatsources.h"
#include "core/solver/settings.h"

#include <span>
#include <vector>

namespace ps {

/// Heat that fixed bodies give by their surface, in W of thermal time per area of it that matter touches
/// (BodyHeat::flux), whatever the temperatures. Their own particles get none of it, and conduct nothing.
///
/// A particle i of matter gets q s V_i sum W_ij over particles j of such a body, s in m2. A particle of the body lacks
/// m_j = sum V W over a whole lattice less that over its own body; where matter fills what all of them lack, they give
/// q s sum m_j together: s = A/sum m_j for a surface A that is known (BodyHeat::area), so that a body that is wholly
/// covered gives q A exactly, and what is partly covered about its share. Of an unknown surface s is that of a plane,
/// of a body two layers thick or more.
///
/// A surface that is one layer thick stands for A or, where that is unknown, dx2 for each particle, whichever side
/// matter touches: each particle of it gives its share wholly where matter fills 35 % of what it lacks, as it does
/// beside a plane and in an edge that it fills, and in proportion below that.
///
/// Not modelled: two such surfaces nearer to each other than the kernel's reach share what stands between them.
class BodyFlux {
 public:
  /// Makes ready for a frame. `pairs`: of this frame.
  void measure(const ParticleStore& store, const HeatPairs& pairs, const BodyHeating& heating,
               const SolverSettings& solver);
  /// Adds W to particles [first, last).
  void addTo(const ParticleStore& store, const HeatPairs& pairs, size_t first, size_t last,
             std::span<double> watts) const;

 private:
  struct Sums {
    double lacks = 0, touched = 0;  ///< sums of V W: over what is not there, over matter
  };
  Sums look(const ParticleStore& store, const HeatPairs& pairs, size_t j) const;
  void share(const ParticleStore& store, const BodyHeating& heating);

  Kernel m_kernel{KernelShape::CubicSpline, 1};
  double m_spacing = 0, m_bulk = 1, m_plane = 0;  ///< m; sum V W in a lattice; s of a plane, m2
  std::vector<uint32_t> m_givers;                 ///< particles of such bodies
  std::vector<Sums> m_sums;                       ///< of each of them
  std::vector<double> m_lacks, m_particles;       ///< by body: sum of m_sums, number
  std::vector<double> m_watts;                    ///< by particle, q s of it; 0 of matter
};

}  // namespace ps
