// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/constraint.h>

namespace ps::constraint {

/// Soft bodies as overlapping clusters (Mueller et al. 2005; Rivers & James 2007): each cluster pulls its members
/// towards their places in its undeformed shape, carried along by the rotation that fits best. The pull is a spring for
/// each member, solved as XPBD (Macklin et al. 2016), so that stiffness is a material's, not an effect of iterations.
/// The springs of a cluster have k_i = kappa m_i with kappa = E V/(sum m r²/3), where V is the volume that the cluster
/// answers for: each particle's, divided by the number of clusters that hold it. A uniform strain then stores E/2 of
/// its square per volume: Young's modulus E, from the material at the members' mean temperature, with Poisson's ratio
/// 0. Weights by mass keep each cluster's linear momentum. Angular momentum, which velocities from positions lose at a
/// rate of w² dt, is given back (deriveVelocities). It cannot do: keep the
/// volume under large strain, plasticity, fracture by force, strains that change within a cluster (it is stiffer
/// against them), or take back matter that has melted.
class ClusterModel : public api::Described<api::GroupPlugin>, public api::StructureCount, public api::GroupPoses {
 public:
  enum Parameter { kRadius, kSpacing, kDamping, kStiffnessRatio, kParameterCount };
  enum Value {
    kRotationX,
    kRotationY,
    kRotationZ,
    kRotationW,
    kVolume,
    kScale,
    kKappa,
    kHeld,
    kMass,  ///< as the next ones in two parts, of which the second follows
    kRestCentreX = kMass + 2,
    kRestCentreY = kRestCentreX + 2,
    kRestCentreZ = kRestCentreY + 2,
    kValueCount = kRestCentreZ + 2
  };
  enum MemberValue {
    kRestX,
    kRestY,
    kRestZ,
    kRestVolume,
    kDisplacementX,
    kDisplacementY,
    kDisplacementZ,
    kWayX,
    kWayY,
    kWayZ,
    kMemberMass,
    kMemberValueCount
  };

  ClusterModel();

  bool traits(api::GroupTraits* out) const noexcept override;
  const void* extension(const char* name) const noexcept override;
  double perParticle(api::Span<const double> parameters) const noexcept override;

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
  double energy(const api::ConstraintContext& context, const api::ParticleView& particles,
                const api::GroupBatch& batch) const override;
  void limits(const api::ConstraintContext& context, const api::ParticleView& particles,
              api::LimitSink& sink) const override;
};

}  // namespace ps::constraint
