// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"
#include "core/particles/particlestore.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ps {

/// Carries stress along long bodies before Gauss-Seidel goes over their ties. A pass hands a push on from tie to tie;
/// where k dt2/m is large, few passes deliver but a share of the stiffness against whatever is slow and smooth: beams
/// sag, columns sink. Here the linear system of an implicit step, (M/dt2 + J^T k J) d = -J^T k C, is solved by
/// conjugate gradients (Baraff & Witkin 1998, without the geometric stiffness, which may be negative), with the inverse
/// masses as preconditioner: what moves is then a sum of pulls along the ties, which keeps momentum and angular
/// momentum however early it ends. It begins with the multipliers of the substep before, which a load at rest leaves as
/// they are, and hands its own on to Gauss-Seidel, which does what is not linear and what touches. It cannot do: ties
/// of more than two particles; what would take more than kMostIterations. All held bodies are one system: where one of
/// them takes too long, none gets any of it in that substep, and limits() of their plugin count on passes alone.
class ImplicitTies {
 public:
  /// Ties of one plugin, as many as the last entry of `colourStart` says.
  struct Source {
    std::span<const size_t> colourStart;
    const uint32_t* particles;  ///< two each
    const float* pull;          ///< N, on the first particle, away from the second
    const float* stiffness;     ///< N/m by which the pull falls when they move apart; 0: left out
    float* multiplier;          ///< N s2
  };

  void clear();
  /// Takes the ties whose stiffness is above 0; the arrays are read again in each solve().
  void add(const Source& source);
  /// After the last add().
  void number(const ParticleStore& store);
  bool any() const { return !m_ties.empty(); }

  /// Moves the particles and sets the multipliers.
  void solve(ParticleStore& store, double dt, double spacing);
  bool done() const { return m_done; }  ///< whether every solve() since clear() got there

  static constexpr int kMostIterations = 80;

 private:
  struct Tie {
    uint32_t a, b;  ///< places in m_members
    float x, y, z;  ///< unit vector from b to a
    float pull, stiffness, multiplier;
  };
  struct Place {
    uint32_t source, tie;
  };

  void read(const ParticleStore& store);
  void start(const ParticleStore& store);
  template <class Size>
  void pull(std::vector<Vector3>& out, const Size& size) const;
  void beginResidual(double perDt2);
  bool iterate(double perDt2, double enough);
  double multiplied(double perDt2);
  template <class Term>
  double sum(const Term& term) const;

  std::vector<Source> m_sources;
  std::vector<Tie> m_ties;      ///< colour by colour
  std::vector<Place> m_places;  ///< of each tie
  std::vector<size_t> m_colourStart{0};
  std::vector<uint32_t> m_local;    ///< of each particle, its place in m_members
  std::vector<uint32_t> m_members;  ///< ascending
  std::vector<double> m_inverseMass;
  std::vector<Vector3> m_way, m_residual, m_search, m_image;  ///< m, N, N/kg, N
  bool m_done = true;
};

}  // namespace ps
