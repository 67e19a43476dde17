// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/particlestore.h"
#include "core/solver/settings.h"

#include <array>
#include <bit>
#include <span>
#include <vector>

namespace ps {

class StateReader;
class StateWriter;

/// Which ways out of a particle are open, and with them its share of the free surface. Of 64 directions, spread evenly
/// over the sphere, those are covered in which a neighbour within two spacings lies no more than 43 degrees aside, or a
/// wall stands beside the particle; its surface is 6 dx2 times the share that is left. Vapour neither covers nor has a
/// surface.
///
/// The total of a cube of 8^3 particles is 2 % too large, that of a sphere of radius 5 dx 5 % too small; in disorder of
/// a fifth of a spacing 1 and 3 % too small. A particle on its own has 6 dx2. The open directions of a plane
/// surface lie within about 50 degrees of its normal.
class OpenSurface {
 public:
  static constexpr int kDirections = 64;
  /// Unit vectors of a Fibonacci lattice on the sphere, from pole to pole along z.
  static const std::array<std::array<float, 3>, kDirections>& directions();

  /// `filled`: sum of V W of each particle; only those below 1.1 are looked at. `scaledArea`: m2 by index of body, 0
  /// where the surface is what was found; otherwise the body's particles share this area as they would share theirs.
  void measure(const ParticleStore& store, const api::NeighbourView& lists, std::span<const float> filled,
               std::span<const Wall> walls, double spacing, std::span<const double> scaledArea);
  /// Whether what was measured last still says which particle is which.
  bool fits(const ParticleStore& store) const;
  /// Walls or numbers have changed.
  void forget() { m_id.clear(); }
  /// What was measured, which may be some frames ago; nothing where it does not fit.
  void save(StateWriter& writer, const ParticleStore& store) const;
  void restore(const StateReader& reader, const ParticleStore& store);
  /// Bit d: direction d is open.
  uint64_t open(size_t i) const { return m_open[i]; }
  /// m2 that each open direction of particle i stands for.
  double areaPerDirection(size_t i) const { return double{m_scale[i]} * m_unit; }
  double area(size_t i) const { return std::popcount(m_open[i]) * areaPerDirection(i); }  ///< m2

 private:
  template <bool kPeriodic>
  void cover(const ParticleStore& store, const api::NeighbourView& lists, std::span<const float> filled,
             std::span<const Wall> walls, size_t first, size_t last);
  static uint64_t behind(const api::Double3& normal);
  void scaleToBodies(const ParticleStore& store, std::span<const double> scaledArea);

  double m_spacing = 0.02, m_unit = 0;  ///< m, m2
  std::vector<uint64_t> m_open, m_behindWall;
  std::vector<float> m_scale;
  std::vector<double> m_found;  ///< m2 by body
  std::vector<uint32_t> m_id;   ///< of the particles, as they were measured
};

}  // namespace ps
