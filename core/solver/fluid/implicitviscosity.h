// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/solver/fluid/density.h"
#include "core/solver/fluid/viscousgroups.h"

#include <array>

namespace ps {

/// Symmetric 3 x 3 matrix, kg.
struct SymmetricBlock {
  float xx, yy, zz, xy, xz, yz;
};

/// Viscosity beyond what a filter delivers, after Weiler, Koschier, Brand & Bender 2018, "A physically consistent
/// implicit viscosity solver for SPH fluids": (M + dt K) dv = -dt K v*, where each pair resists along its
/// own line, k_ij = 10 mu_ij V_i V_j G_ij x_ij (x) x_ij, so that momentum and angular momentum stay (for G see
/// kStressNormalisation).
/// Solved matrix-free by conjugate gradients with the 3 x 3 diagonal blocks as preconditioner, from the last dv.
///
/// Walls, and the surfaces of fixed bodies, hold the liquid at their plane, at the velocity that these have: half a
/// space of liquid whose velocity goes on linearly through zero there (Morris, Fox & Zhu 1997), with a fifth more drag
/// along them, since films bend. Solids, fixed or not, hold it at their surface, halfway between the two particles of a
/// pair.
///
/// An unfinished iteration would leak momentum through its residual. Groups of particles that touch no boundary are
/// therefore solved in the space of motions without linear and angular momentum of their own (preconditioner P D^-1,
/// P the mass-orthogonal projection), where every iterate keeps both to rounding.
///
/// All sums run in segments of a fixed size, in one order, in double: neither threads nor instruction sets matter.
/// Error: it delivers 1.01 to 1.09 of the viscosity, as particles lie, with 2 spacings of reach.
class ImplicitViscosity {
 public:
  void configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                 const FixedShapes& shapes = FixedShapes::none());
  /// The most that is asked of the iteration, m2/s.
  double greatestViscosity() const;
  /// Lists or motions have changed.
  void listsChanged() { m_dirty = true; }
  /// Once per frame: `viscous` is 1 for the particles of this stage, else 0; size() + 16 entries.
  void refresh(ParticleStore& store, std::span<const float> viscous);
  /// Nobody is viscous this frame.
  void deactivate();
  bool active() const { return m_active; }
  /// A boundary took part in the last apply().
  bool held() const { return m_active && m_groups.anyHeld(); }

  /// After velocities follow from positions. `viscosity`: Pa s, negative for what has none; size() + 16 entries.
  void apply(ParticleStore& store, const Neighbours& neighbours, const DensityStage& density, const float* viscosity);
  /// sqrt(2 D:D) in 1/s as the operator sees it, for every particle of this stage; others keep what they had.
  void shearRates(const ParticleStore& store, const Neighbours& neighbours, const DensityStage& density,
                  std::vector<float>& rates);

  /// Where walls and fixed particles are told what they get.
  void tell(Reactions& reactions) { m_reactions = &reactions; }

  int iterations() const { return m_iterations; }  ///< the most of a substep since refresh()
  double residual() const { return m_residual; }   ///< the largest of a substep since refresh(), relative

 private:
  using Role = ViscousGroups::Role;
  using Segment = ViscousGroups::Segment;
  Role roleOf(const ParticleStore& store, std::span<const float> viscous, size_t i) const;
  void findGroups(const Neighbours& neighbours);
  void loadPoints(const ParticleStore& store, const DensityStage& density);
  void assemble(const ParticleStore& store, const PairLists& lists, double scale, const float* viscosity);
  bool addWall(const WallPlane& plane, const api::Float4& at, float weight, SymmetricBlock& block) const;
  /// And to `drag` what those that move pull it along with, N s or as the weight is.
  bool addWalls(uint32_t i, float weight, SymmetricBlock& block, api::Float4& drag) const;
  /// visit(plane, its velocity in m/s, slot of its owner's reaction) for each that liquid sticks to near particle i.
  template <class Visit>
  void forPlanes(uint32_t i, Visit&& visit) const;
  void tellHeld(const ParticleStore& store, const PairLists& lists, const float* viscosity, double scale);
  /// Product of A, with `massShare` (0 or 1) of M, and m_direction.
  void multiply(const ParticleStore& store, const PairLists& lists, size_t first, size_t last, float massShare);
  double sum(size_t which) const;
  void start(ParticleStore& store, const PairLists& lists, const api::Float4* guess);
  double curvature(const ParticleStore& store, const PairLists& lists);
  double advance(const ParticleStore& store, float step, bool change);
  void redirect(const ParticleStore& store, float keep);
  void iterate(const ParticleStore& store, const PairLists& lists);
  uint32_t row(size_t k) const { return m_groups.rows()[k]; }
  template <class Body>
  void forSegments(const Body& body);

  SolverSettings m_settings;
  const FixedShapes* m_shapes = nullptr;
  std::vector<WallSurface> m_held;                ///< walls that liquid sticks to
  std::vector<size_t> m_wallOf;                   ///< index of the wall, by wall that is held
  double m_support = 0;                           ///< m
  std::vector<std::array<float, 2>> m_wallTable;  ///< tangential and normal, over distance 0 .. R, 1/m2 times d
  bool m_active = false, m_dirty = true;
  int m_iterations = 0;
  double m_residual = 0;

  std::vector<Role> m_roles;
  std::vector<float> m_viscous;
  ViscousGroups m_groups;
  std::vector<api::Float4> m_points, m_direction;  ///< by particle
  RoomVector<float> m_coefficient;                 ///< by slot of the lists
  std::vector<SymmetricBlock> m_own, m_inverse;    ///< by row, as all below
  std::vector<api::Float4> m_drag;                 ///< N s, of surfaces that move
  std::vector<api::Float4> m_diagonal, m_offDiagonal, m_change, m_rest, m_preconditioned, m_product;
  std::vector<float> m_shear;
  std::vector<uint8_t> m_touched;                ///< by segment: a wall holds some of it
  std::vector<std::array<double, 2>> m_partial;  ///< by segment
  Reactions* m_reactions = &Reactions::none();
  double m_target = 0, m_reference = 0, m_residualSquare = 0;
};

}  // namespace ps
