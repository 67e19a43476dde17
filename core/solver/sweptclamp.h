// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/neighbours.h"
#include "core/solver/walls.h"

namespace ps {

/// The last word on positions: nothing passes a layer of static particles, however fast. Each moving particle is swept
/// from its old to its final position against spheres of 0.75 spacings around static ones, exactly (a quadratic), and
/// slides on along what it meets. The largest opening of a lattice layer leaves 0.71 spacings, so 0.75 closes it, and
/// resting contact (about one spacing) is left alone.
/// Moving solids are not obstacles here: see SolidContact and RigidContact.
class SweptClamp {
 public:
  void configure(const SolverSettings& settings);
  /// Once per frame: finds the static particles.
  void refresh(const ParticleStore& store);
  /// After new lists: which particles have a static one in their list.
  void refreshLists(const ParticleStore& store, const Neighbours& neighbours);
  /// Members of rigid bodies (1 in `rigid`) are not moved: see held().
  void apply(ParticleStore& store, const Neighbours& neighbours, const WallStage& walls,
             std::span<const uint8_t> rigid);
  /// For each particle the way back (m) by which a member of a rigid body would have to be moved; empty when there is
  /// nothing static.
  std::span<const api::Float4> held() const { return m_held; }

 private:
  struct Hit {
    double time = 2;  ///< of the way, 0..1
    std::array<double, 3> center{};
  };
  bool maySkip(const ParticleStore& store, const Neighbours& neighbours, size_t i) const;
  Hit firstHit(const std::array<double, 3>& from, const std::array<double, 3>& way) const;
  void firstHit(const std::array<double, 3>& from, const std::array<double, 3>& way, Hit& hit) const;
  void imagesHit(const std::array<double, 3>& from, const std::array<double, 3>& way, Hit& hit) const;
  std::array<double, 3> sweep(std::array<double, 3> from, std::array<double, 3> way) const;
  int cellOf(double coordinate, int axis) const;

  double m_radius = 0, m_cell = 1, m_safeWay = 0;
  Period m_period;
  std::array<double, 3> m_low{}, m_high{};
  std::array<int, 3> m_cells{1, 1, 1};
  std::vector<std::array<double, 3>> m_centers;  ///< in order of cell
  std::vector<uint32_t> m_cellStart;
  std::vector<uint8_t> m_nearStatic;
  std::vector<api::Float4> m_held;
};

}  // namespace ps
