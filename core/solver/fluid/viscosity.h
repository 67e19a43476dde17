// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"
#include "core/particles/impulse.h"
#include "core/solver/fluid/implicitviscosity.h"
#include "core/solver/report.h"

namespace ps {

/// Viscosity of liquids. Thin ones by the XSPH filter of Monaghan 1992, momentum-conserving, over fluid particles and
/// the solids they touch: a coefficient c acts like the kinematic viscosity nu = c s2/(2 dt), s2 = int W x^2 dV
/// (0.075 R^2 for the cubic spline), so c follows from the material's viscosity. At c = 1 the filter is exhausted, and
/// it feels no walls: what is thicker, what a wall drags along by more than a spacing in some seconds (sqrt(nu t); in
/// one where no wall is that liquid sticks to), and what has a yield stress, goes to ImplicitViscosity, as
/// SolverSettings::viscosityModel says.
///
/// Mush, matter within its melting range, is a suspension of its crystals: mu = mu_l (1 - s/0.6)^-1.5, s the solid
/// fraction (Krieger & Dougherty 1959), at most viscosityMax. Half-molten particles of a pure substance are no mush: a
/// front crosses them. Yield stress (Bingham): mu_eff = mu + tau_y/(gamma_dot + 0.001/s), gamma_dot of the last
/// substep; below it matter creeps instead of resting.
///
/// Calming, the least c, is a rate: substeps shorter than 1/240 s take less of it, so that the viscosity that it adds
/// does not grow with their number. Longer ones take it once.
///
/// It cannot do, and limits() says: films of one or two layers, which flow a fourth or an eighth too fast (of two or
/// three a fifth, on fixed particles); slopes below a degree, and of films of ten layers and more below two to four,
/// where layers of particles in order hold on to each other; gaps between walls that a liquid fills, whose layers
/// find no room to pass each other, the less the more substeps and iterations; walls, with the filter; liquids thinner
/// than their calming.
class ViscosityStage {
 public:
  void configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                 std::span<const BakedMaterial> materials, const FixedShapes& shapes = FixedShapes::none());
  void listsChanged() { m_implicit.listsChanged(); }
  /// Once per frame: coefficients and viscosities of all particles from their temperatures.
  void refresh(ParticleStore& store, const Neighbours& neighbours, const DensityStage& density);
  /// After velocities follow from positions.
  void apply(ParticleStore& store, const Neighbours& neighbours, const DensityStage& density);
  /// `time`: s, since the start.
  void limits(const ParticleStore& store, double time, std::vector<Limit>& out) const;
  /// What walls and fixed particles gave in apply(), kg m/s.
  ExternalImpulse& externalImpulse() { return m_externalImpulse; }
  /// Where walls and fixed particles are told what they get.
  void tell(Reactions& reactions) {
    m_reactions = &reactions;
    m_implicit.tell(reactions);
  }
  int iterations() const { return m_implicit.iterations(); }  ///< of the implicit stage, the most of a substep

 private:
  double filterReach() const;                                      ///< m2/s, at c = 1
  double calming() const;                                          ///< the least c, of a substep
  double filterSuffices() const;                                   ///< m2/s, up to which the filter alone will do
  double viscosityOf(const ParticleStore& store, size_t i) const;  ///< Pa s, without yield stress
  void filter(ParticleStore& store, const Neighbours& neighbours, const DensityStage& density);
  void tellFixed(const ParticleStore& store, const PairLists& pairs, std::span<const uint32_t> fixed) const;
  void gatherThick(const ParticleStore& store, const DensityStage& density);
  /// A material's liquid at one wall, or on fixed particles, of one of the two stages.
  struct AtWall {
    size_t all = 0, touching = 0, near = 0;   ///< particles: of the stage, in the first layer, within four
    double speed = 0, viscosity = 0, nu = 0;  ///< sums over the first layer: m/s along the wall, Pa s, m2/s
    Vector3 normal;                           ///< likewise, of unit vectors away from the wall
    size_t above = 0;                         ///< particles of the second layer
    double speedAbove = 0;                    ///< sum over it, m/s along the wall
    Vector3 places;                           ///< sums over the first layer on fixed particles, m, and of squares
    Matrix3 squares = Matrix3::Zero();
  };
  void measureBeds(const ParticleStore& store, const PairLists& lists, std::span<const uint32_t> fluid);
  void addTouching(const ParticleStore& store, size_t i, const Vector3& velocity, const Vector3& normal,
                   AtWall& at) const;
  bool flatten(AtWall& bed) const;
  double gapShare(size_t one, size_t other, std::span<const AtWall> atWalls) const;
  template <class Tell>
  void filmLimits(const AtWall& film, double few, double faster, const Tell& tell) const;
  std::vector<AtWall> atWalls(const ParticleStore& store) const;
  void wallLimits(size_t material, double time, std::span<const AtWall> atWalls, std::vector<Limit>& out) const;
  bool isLiquid(const ParticleStore& store, size_t i) const {
    return store.motion()[i] == api::Motion::Liquid && store.material()[i] < m_materials.size() && store.mass()[i] > 0;
  }
  Vector3 momentumOf(const ParticleStore& store, const DensityStage& density);
  void addYieldStress(const ParticleStore& store);

  SolverSettings m_settings;
  std::vector<WallSurface> m_held;  ///< walls that liquid sticks to
  std::span<const BakedMaterial> m_materials;
  ImplicitViscosity m_implicit;
  double m_secondMoment = 0;     ///< s2, m2
  std::vector<uint8_t> m_mushy;  ///< by material: melts over a range
  bool m_yields = false, m_filters = false;
  std::vector<float> m_coefficient;                          ///< XSPH's
  float m_common = -1;                                       ///< that of all fluid particles; -1: there is none
  std::vector<float> m_plastic, m_yieldStress, m_shearRate;  ///< Pa s, Pa, 1/s
  std::vector<float> m_viscosity, m_viscous;                 ///< what the implicit stage is asked, and for whom
  ExternalImpulse m_externalImpulse;
  Reactions* m_reactions = &Reactions::none();
  std::vector<uint32_t> m_which;
  std::vector<api::Float4> m_change;
  ChunkSum m_partial;
  std::vector<AtWall> m_beds, m_bedParts;  ///< by material; by chunk and material
};

}  // namespace ps
