// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "springmodel.h"

namespace ps::constraint {

/// A line one particle thick. Its stretch stiffness is that of the rope, E A in N, so the springs have k = E A/dx; its
/// mass per length is density times the square of the particle spacing. It cannot do: twist, bending moments for small
/// angles, or heavy loads on few iterations (a rope that carries 250 times the mass of a particle stretches by 12 % at
/// 8 substeps of 4 iterations, by 3 % at 16 of 4).
class RopeModel : public SpringModel {
 public:
  enum Parameter { kStretchStiffness, kBendStiffness, kDamping, kTearStrain, kTied, kParameterCount };

  RopeModel();
  const void* extension(const char* name) const noexcept override;

 protected:
  Springs springsOf(api::Span<const double> parameters, double spacing) const override;
  Asked askedOf(Kind kind, double spacing) const override;
};

}  // namespace ps::constraint
