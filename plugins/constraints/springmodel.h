// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/constraint.h>

#include <array>

namespace ps::constraint {

/// What cloth and rope share: a lattice of springs between neighbours (stretch), across a square's diagonal (shear) and
/// from one neighbour over the particle between to the next (bend, Provot 1995), as XPBD distance constraints (Macklin
/// et al. 2016, eq. 18 and 26). Cells that were sketched askew and meet across a corner alone are neighbours too, of a
/// spring as stiff as between two that are a spacing apart. Springs keep linear and angular momentum. A stretch spring
/// tears when its strain passes a bound; a shear or bend spring goes with the last particle that held both its ends.
/// Lengths at rest are those at the start; heat does not change them.
class SpringModel : public api::Described<api::StructuralPlugin> {
 public:
  using Described::Described;
  enum Kind { kStretch, kShear, kBend, kKinds };
  enum Value { kRestLength, kKind, kMultiplier, kValueCount };

  bool traits(api::StructuralTraits* out) const noexcept override;
  void build(const api::ConstraintContext& context, const api::ParticleView& particles, const api::NeighbourView& lists,
             api::Span<const uint32_t> members, api::ConstraintSink& sink) const override;
  void predict(const api::ConstraintContext& context, const api::ParticleView& particles,
               const api::ConstraintBatch& batch) const override;
  void project(const api::ConstraintContext& context, const api::MovableParticles& particles,
               const api::ConstraintBatch& batch) const override;
  void topology(const api::ConstraintContext& context, const api::ParticleView& particles,
                const api::NeighbourView& lists, const api::ConstraintBatch& all,
                api::ConstraintSink& sink) const override;
  double energy(const api::ConstraintContext& context, const api::ParticleView& particles,
                const api::ConstraintBatch& batch) const override;
  void limits(const api::ConstraintContext& context, const api::ParticleView& particles,
              api::LimitSink& sink) const override;

 protected:
  /// What a body asks for.
  struct Springs {
    std::array<double, kKinds> stiffness{};  ///< N/m of each spring; 0: none of this kind
    double damping = 0;                      ///< s
    double tearStrain = 0;                   ///< 0: never
    bool tiesToFixed = false;                ///< to fixed matter of other bodies, too
  };
  virtual Springs springsOf(api::Span<const double> parameters, double spacing) const = 0;
  /// What a spring's stiffness of `kind` is in the user's parameter: "cloth.stretch_stiffness", and its unit;
  /// `perSpring` turns N/m of a spring into that unit.
  struct Asked {
    const char *what, *unit;
    double perSpring;
  };
  virtual Asked askedOf(Kind kind, double spacing) const = 0;
};

}  // namespace ps::constraint
