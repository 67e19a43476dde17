// SPDX-License-Identifier: Apache-2.0
#pragma once
// Why a list of its own: geometry does not change while heat is subcycled, so distances, kernels and conductances are
// worked out once a frame and each heat substep is one multiply-add per neighbour. Both partners of a pair compute the
// same float from commutative operations alone, so what one gains the other loses to the last bit, and the loop needs
// no scatter: every particle sums its own list.
#include "core/math/kernels.h"
#include "core/matter/material.h"
#include "core/particles/pairroom.h"
#include "core/particles/particlestore.h"
#include "core/solver/heat/heatpairkernels.h"

#include <span>
#include <vector>

namespace ps {

/// Thermal conductances between neighbours (Cleary & Monaghan 1999): for particles of one material per unit of
/// conductivity, G = -2 F V_i V_j in m, to be multiplied by a difference of Kirchhoff potentials in W/m; for particles
/// of different materials with the harmonic mean of their conductivities, in W/K. A contact conductance h lies in
/// series with the slab of one spacing that a pair stands for, G' = G/(1 + k/(h dx)). V is the rest volume of the
/// condensed matter, which conducts better than 1/sum W under disorder and does not swell with vapour.
///
/// Where one of the two stands for a fluid behind a surface, of convection h, the pair carries its share of the area A
/// that the other one sees of that surface, in W/K: A = C V |sum V_j grad W| over such particles j, whose sum over all
/// matter is the area of the surface, whichever way it lies on a lattice; for a plane one C makes it exact. Through
/// that 1/U = 1/h + (dx/2)/k, k of the other one. Two such particles conduct nothing.
class HeatPairs {
 public:
  struct Options {
    double support = 0.04, spacing = 0.02;  ///< m
    KernelShape kernel = KernelShape::CubicSpline;
    bool momentCorrection = true;
    /// W/(m2 K) between particles of different bodies of which at least one is solid, in series; 0: perfect contact.
    double contactConductance = 0;
    std::span<const uint8_t> insulated{};  ///< by particle, 1: it conducts nothing; none: all conduct
    std::span<const float>
        convection{};  ///< by particle, W/(m2 K) of a fluid that it stands for, or 0; none: none does
  };
  /// Lists may be older than the positions by less than their skin. Temperature and fractions must be current. Partners
  /// and conductances lie in `room` as long as nobody else writes there; without one in its own.
  void build(const ParticleStore& store, const api::NeighbourView& lists, std::span<const BakedMaterial> materials,
             const Options& options, PairRoom* room = nullptr);
  bool isInsulated(size_t i) const { return !m_options.insulated.empty() && m_options.insulated[i] != 0; }

  // Partners of particle i: [begin[i], same[i]) of its own material, [other[i], end[i]) of others.
  std::vector<uint32_t> begin, same, other, end;
  std::span<uint32_t> partner;
  std::span<float> conductance;
  std::vector<double> sameTotal, otherTotal;  ///< sums of conductance over each particle's two ranges
  std::vector<float> conductivity;            ///< W/(m K), mixture of the phases present
  std::vector<float> volume;                  ///< m3, condensed
  std::vector<float> filled;                  ///< sum of V W, with condensed volumes; below 1 beside a surface
  std::vector<float> immersion;  ///< share of the surroundings that keeps air away, 0..1; only of particles with vapour

 private:
  void prepare(size_t count, size_t slots, PairRoom& room);
  /// Of one particle at a time, by its slots: partners as they are found, and with their squared distances as they are
  /// put in order; W.
  struct Room {
    std::vector<uint32_t> partner;
    std::vector<float> found, square, kernel;
  };
  HeatSlots findPartners(const ParticleStore& store, const api::NeighbourView& lists, uint32_t i, Room& room);
  void measure(const ParticleStore& store, const api::NeighbourView& lists, size_t first, size_t last);
  void conduct(size_t first, size_t last);
  void resist(const ParticleStore& store, size_t first, size_t last);
  void insulate(size_t first, size_t last);
  bool isFluidBehind(size_t i) const { return !m_options.convection.empty() && m_options.convection[i] > 0; }
  void seeFilms(const ParticleStore& store, size_t first, size_t last);
  float throughFilm(uint32_t i, uint32_t j, float slope) const;
  float condensedAround(const ParticleStore& store, size_t i, const float* kernel) const;

  Options m_options;
  PairRoom m_ownRoom;
  bool m_oneMaterial = false;
  std::vector<float> m_inverseMoment;  ///< 1/M of the moment correction
  std::vector<Room> m_rooms;           ///< by chunk
  double m_filmScale = 0;              ///< m3, C of the above
  std::vector<float> m_film;           ///< by particle, see seeFilms()
};

}  // namespace ps
