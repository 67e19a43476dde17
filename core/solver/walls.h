// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/particlestore.h"
#include "core/solver/settings.h"

#include <array>

namespace ps {

/// Half-space walls: a particle's centre stays half a spacing inside. Projection onto a plane is already swept, so that
/// nothing passes a wall at any speed. Solids rub: the tangential way of the substep is reduced by up to friction times
/// the depth (Macklin et al. 2014, eq. 24).
class WallStage {
 public:
  void configure(const SolverSettings& settings, const std::vector<Wall>& walls);
  void project(ParticleStore& store) const;
  /// One particle, without friction; `position` in m.
  void clamp(std::array<double, 3>& position) const;

 private:
  struct Plane {
    float x, y, z, offset, friction;
  };
  std::vector<Plane> m_planes;
};

}  // namespace ps
