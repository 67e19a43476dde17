// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/constraint.h>

#include <array>

// One pass over ties of two particles that share none, a vector of them at a time (Highway), with the same bits on
// every instruction set: each tie has a lane of its own, and roots and divisions are exact.
namespace ps::constraint {

/// XPBD distance constraints (Macklin et al. 2016, eq. 18 and 26).
struct Pairs {
  size_t count;
  const uint32_t* particles;  ///< two of each
  const float* length;        ///< m, at rest
  float* multiplier;          ///< N s2
  float damping;              ///< time of inner friction over that of the substep
};

/// Softness of bonds, 1/(k dt2): each has its own compliance.
struct BondSoftness {
  const float* compliance;  ///< m/N
  float perDt2;             ///< 1/s2
};

/// Of springs: by their kind, and no less than the step resolves for a pair of inverse masses.
struct SpringSoftness {
  const float* kind;            ///< 0, 1 or 2
  std::array<float, 3> ofKind;  ///< 1/kg; below 0: there is none
  float perInverseMass;
};

void projectPairs(const api::MovableParticles& particles, const Pairs& pairs, const BondSoftness& softness);
void projectPairs(const api::MovableParticles& particles, const Pairs& pairs, const SpringSoftness& softness);

/// The same one after the other, from pair `first` on.
void projectPairsPlainly(const api::MovableParticles& particles, const Pairs& pairs, const BondSoftness& softness,
                         size_t first = 0);
void projectPairsPlainly(const api::MovableParticles& particles, const Pairs& pairs, const SpringSoftness& softness,
                         size_t first = 0);

}  // namespace ps::constraint
