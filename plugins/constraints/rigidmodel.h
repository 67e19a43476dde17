// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/constraint.h>

namespace ps::constraint {

/// Rigid bodies of particles. Prediction: the body's linear and angular momentum are those of its members' velocities
/// (whatever gave them: gravity, drag, a brush); it moves on by v dt, and turns by the midpoint rule at constant
/// angular momentum, which holds the gyroscopic term and keeps momentum to rounding. Correction: what contact and
/// liquid did to its particles is absorbed by shape matching (Mueller et al. 2005; rotation by Mueller et al. 2016)
/// into a change of the pose, and the velocities follow as increments from the predicted one, v += dc/dt, w += log(R
/// R_pred^T)/dt, so that a free body loses no spin. Momentum that viscosity gave to members goes to the body. Members
/// that cease to be solid leave; what is left falls into pieces that hang together in the undeformed shape. What
/// freezes beside a piece, by the rule of Joining, becomes part of it, of its own body or of nobody's; matter of the
/// body that freezes in the open forms a piece as soon as `least_members` touch; two pieces that touch by three pairs
/// or more for half a second, frozen together or sintering, become one. All of this keeps linear and angular momentum:
/// a body takes its own from its members. Heat scales the whole body by its mean strain. It cannot do: deform, break by
/// force, freeze together across the faces of a periodic scene, or freeze onto fixed matter (bonds do).
class RigidModel : public api::Described<api::GroupPlugin>, public api::GroupPoses {
 public:
  enum Parameter { kLeastMembers, kParameterCount };
  enum Value {
    kCentreX,
    kCentreY,
    kCentreZ,
    kRotationX,
    kRotationY,
    kRotationZ,
    kRotationW,
    kScale,
    kVelocityX,
    kVelocityY,
    kVelocityZ,
    kSpinX,
    kSpinY,
    kSpinZ,
    kValueCount
  };
  enum MemberValue { kRestX, kRestY, kRestZ, kRestVolume, kMemberValueCount };

  RigidModel();

  void attach(api::Host& host) override { m_threads = static_cast<const api::Threads*>(host.extension(api::kThreads)); }
  bool traits(api::GroupTraits* out) const noexcept override;
  const void* extension(const char* name) const noexcept override;

  void build(const api::ConstraintContext& context, const api::ParticleView& particles, const api::NeighbourView& lists,
             api::Span<const uint32_t> members, const api::GroupBatch& all, api::GroupSink& sink) const override;
  void predict(const api::ConstraintContext& context, const api::MovableParticles& particles,
               const api::GroupBatch& batch) const override;
  void project(const api::ConstraintContext& context, const api::MovableParticles& particles,
               const api::GroupBatch& batch) const override;
  void deriveVelocities(const api::ConstraintContext& context, const api::MovableParticles& particles,
                        const api::GroupBatch& batch) const override;
  void topology(const api::ConstraintContext& context, const api::ParticleView& particles,
                const api::NeighbourView& lists, const api::GroupBatch& all, api::GroupSink& sink) const override;
  void restoreMembers(const api::ConstraintContext& context, const api::MovableParticles& particles,
                      const api::GroupBatch& all, const uint8_t* returned) const override;
  void carry(const api::ConstraintContext& context, const api::MovableParticles& particles, const api::GroupBatch& all,
             const uint8_t* carried, const api::Carrying& carrying) const override;

 private:
  const api::Threads* m_threads = nullptr;
};

}  // namespace ps::constraint
