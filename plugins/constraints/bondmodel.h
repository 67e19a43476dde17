// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/constraint.h>

namespace ps::constraint {

/// Elastic solids as lattices of springs: XPBD distance constraints (Macklin et al. 2016, eq. 18) between a particle
/// and its 18 nearest of a cubic lattice. Six axial and twelve diagonal springs of one stiffness k make an isotropic
/// solid with Poisson's ratio 1/4 and E = 2.5 k/dx, so k = 0.4 E dx with E at the pair's mean temperature. With the six
/// axial ones alone, k = E dx: pulled along an axis it is as stiff, and sheared it has no stiffness. Rest lengths
/// follow the particles' rest volumes, l = l_ref ((V_i + V_j)/V_ref)^(1/3), so heat dilates the solid. Bonds break
/// where a particle ceases to be solid and form by the rule of Joining: where one has frozen, and where dry pieces that
/// sinter are pressed together. Matter of other bodies is taken in too, but pairs that rigid bodies take back are left
/// to them. The parameters of the group Legacy choose the 2020 thesis's rules instead. It cannot do: another Poisson's
/// ratio, plasticity, fracture by force, or a stiffness beyond what the substeps resolve (limits() says so).
/// Gauss-Seidel passes alone deliver but a share of a stiffness beyond k dt2/m = 2 (convergence.h); what is held by
/// something fixed has the host's help (linearise()), and then its modulus.
///
/// At a surface the diagonal springs across it are missing. The axial ones there are stiffer by 3/32 for each spring
/// that a particle lacks of 18, half by either end: with all of its neighbours a particle has E, and a row of single
/// ones has E dx² too. A beam two particles thick sags 1.7 times too far, three 1.3, four 1.15, eight 1.05 times.
class BondModel : public api::Described<api::StructuralPlugin>,
                  public api::StructureCount,
                  public api::SpringTies,
                  public api::Welding {
 public:
  enum Parameter {
    kBondMax,
    kDamping,
    kStiffnessRatio,
    kNeighbours,
    kAcross,
    kSpringStiffness,
    kRestRatio,
    kReferenceTemperature,
    kSolver,
    kPbdStiffness,
    kBondRule,
    kStiffnessLaw,
    kSoftening,
    kParameterCount
  };
  /// Per particle, how many bonds it has: of the frame before, as they break and form.
  static constexpr const char* kTiesField = "bonds.ties";
  enum Value { kRestLength, kReferenceVolume, kMultiplier, kLength, kCompliance, kTemperature, kCarried, kValueCount };

  BondModel();

  void attach(api::Host& host) override { m_threads = static_cast<const api::Threads*>(host.extension(api::kThreads)); }
  bool traits(api::StructuralTraits* out) const noexcept override;
  const void* extension(const char* name) const noexcept override;
  double perParticle(api::Span<const double> parameters) const noexcept override;

  void build(const api::ConstraintContext& context, const api::ParticleView& particles, const api::NeighbourView& lists,
             api::Span<const uint32_t> members, api::ConstraintSink& sink) const override;
  void predict(const api::ConstraintContext& context, const api::ParticleView& particles,
               const api::ConstraintBatch& batch) const override;
  void project(const api::ConstraintContext& context, const api::MovableParticles& particles,
               const api::ConstraintBatch& batch) const override;
  void topology(const api::ConstraintContext& context, const api::ParticleView& particles,
                const api::NeighbourView& lists, const api::ConstraintBatch& all,
                api::ConstraintSink& sink) const override;
  void weld(const api::ConstraintContext& context, const api::ParticleView& particles, const api::NeighbourView& lists,
            api::Span<const uint32_t> members, api::ConstraintSink& sink) const override;
  double energy(const api::ConstraintContext& context, const api::ParticleView& particles,
                const api::ConstraintBatch& batch) const override;
  void limits(const api::ConstraintContext& context, const api::ParticleView& particles,
              api::LimitSink& sink) const override;
  size_t multiplier() const noexcept override { return kMultiplier; }
  void linearise(const api::ConstraintContext& context, const api::ParticleView& particles,
                 const api::ConstraintBatch& batch, float* pull, float* stiffness) const override;

 private:
  static void refresh(const api::ConstraintContext& context, const api::ParticleView& particles,
                      const api::ConstraintBatch& batch);
  /// At rest: share of the distance, volume of both in m³ and temperature in K at which it is; 0 K: the present one.
  struct Length {
    float ratio, volume;
    double temperature;
  };
  static void addBond(const api::ParticleView& particles, uint32_t i, uint32_t j, const Length& length,
                      api::ConstraintSink& sink);

  const api::Threads* m_threads = nullptr;
};

}  // namespace ps::constraint
