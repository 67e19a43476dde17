// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/views.h>

#include "core/math/kernels.h"
#include "core/particles/period.h"

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

// The loops over pairs that the step spends its time in. They are written once and compiled for every instruction set;
// the best one is chosen when the program runs, and all give the same bits: sums are kept in 16 virtual lanes whatever
// the width of a vector, are added in one order, and no multiply-add is contracted.
namespace ps {

/// Padded lists (see Neighbours) and the kernel, in units of the support radius R.
struct PairLists {
  const uint32_t *begin, *last, *end, *index;
  KernelShape kernel;
  float inverseSupportSquared;  ///< 1/R2
  Period period;                ///< pairs are measured between their nearest images
  size_t slots;                 ///< entries of `index`
};

/// Sums of one particle's density constraint. Volumes are multiplied by the kernel's factor (8/(pi R3) for the spline),
/// so that W appears as the plain polynomial w(q).
struct DensitySums {
  float excess;   ///< sum_j V_j w(q_ij), without the particle itself
  float x, y, z;  ///< sum_j V_j w'(q)/q (x_i - x_j), m; times 1/R2 it is the gradient
};

/// The weights u_j = V_j2/m_j of a density sum, 0 for what does not move. Where few inverse masses are about, the
/// lowest bits of a volume say which one is its particle's, so that they come with what is loaded anyway: one more load
/// for each pair is a quarter of the loop.
struct DensityWeights {
  static constexpr uint32_t kKinds = 4;  ///< that volumes tell apart
  const float* each = nullptr;           ///< u_j by particle; nullptr: by kind
  float inverseMass[kKinds] = {};        ///< 1/kg, by kind; what does not move is of the first one

  /// Whether all that moves has one mass.
  bool onlyKind() const { return each == nullptr && inverseMass[2] == 0; }
  /// A volume that says its kind, changed by less than 4e-7 of it.
  static float marked(float volume, uint32_t kind) {
    return std::bit_cast<float>((std::bit_cast<uint32_t>(volume) & ~(kKinds - 1)) | kind);
  }
};

/// For the particles which[first .. last): sums over `points` (position and scaled volume), and where `squares` is
/// given sum_j u_j w'(q)2 with the weights u_j: times 1/R2 it is the neighbours' share of the denominator. Where
/// `slopes` is given, w'(q)/q of each slot of their lists, but for a factor of the kernel's, is left there.
void sumDensity(const PairLists& lists, const api::Float4* points, const DensityWeights& weights, const uint32_t* which,
                size_t first, size_t last, DensitySums* out, float* squares = nullptr, float* slopes = nullptr);

/// For the particles which[first .. last): out[k] = sum_j lambda_j w'(q)/q (x_i - x_j), lambda_j in points[j].w.
/// `slopes` are those of sumDensity() at the same places, or nullptr.
void sumMultipliers(const PairLists& lists, const api::Float4* points, const uint32_t* which, size_t first, size_t last,
                    api::Float4* out, const float* slopes = nullptr);

/// Which entries of lists are near, and where they go.
struct NearRoom {
  float q2;                ///< of the farthest
  uint32_t dummy;          ///< fills lists up
  uint32_t *last, *index;  ///< ends of lists, by particle; entries from where a list began
};
/// For the particles which[first .. last): keeps the near entries of their lists, in their order and padded.
void findNear(const PairLists& lists, const api::Float4* points, const NearRoom& room, const uint32_t* which,
              size_t first, size_t last);
/// sumDensity() with findNear(): slopes lie at the entries that were kept.
void sumDensityFindingNear(const PairLists& lists, const api::Float4* points, const DensityWeights& weights,
                           const NearRoom& room, const uint32_t* which, size_t first, size_t last, DensitySums* out,
                           float* squares, float* slopes);

/// What is to be told of a particle's density, not solved for.
struct CompressionSums {
  float excess;         ///< sum_j V_j w(q_ij), without the particle itself
  float byVolumes;      ///< -sum_j V_j w'(q) q / 3: a third of what the density sum grows by where all around comes
                        ///< nearer by the same share; 1 in the continuum
  float byMultipliers;  ///< the same with the multipliers in their w in place of volumes
};
/// For the particles which[first .. last).
void sumCompression(const PairLists& lists, const api::Float4* points, const api::Float4* multipliers,
                    const uint32_t* which, size_t first, size_t last, CompressionSums* out);

/// XSPH (Monaghan 1992) with harmonic masses and mean volumes: for the particles which[first .. last),
/// out[k] = sum_j c_ij (V_i + V_j)/2 2 m_j/(m_i + m_j) w(q) (v_j - v_i), to be multiplied by the kernel's factor.
/// `coefficient` is negative for particles that are no fluid: c_ij is the mean of two fluid particles, the fluid's one
/// for a mixed pair, 0 between others.
void sumViscosity(const PairLists& lists, const api::Float4* position, const api::Float4* velocity,
                  const float* coefficient, const uint32_t* which, size_t first, size_t last, api::Float4* out);
/// The same for fluid particles where all that are fluid have one coefficient.
void sumViscosity(const PairLists& lists, const api::Float4* position, const api::Float4* velocity, float coefficient,
                  const uint32_t* which, size_t first, size_t last, api::Float4* out);

/// What viscous stress reads of all particles, by index with the dummy at the end.
struct StressField {
  const api::Float4* points;  ///< position; w: volume times the kernel's factor, 0 for what takes no part
  const float* viscosity;     ///< Pa s; negative for what has none of its own (solids, boundaries)
  const float* viscous;       ///< 1 for particles of the implicit stage; a pair counts when one of two is
};

/// Weight of a pair's resistance, g(q) = (1 - q)2 (1 + 1/q), times this and 1/R7: then int g r4 dV = 3, as for the
/// -F/(r2 + 0.01 R2) that Weiler et al. 2018 have in its place. Any weight of that moment gives the same viscosity in
/// the continuum; with 2 spacings of reach theirs delivers 0.70 of it to shear along a lattice (0.79 to layers that
/// slide), this one 1.07 (1.01), and 1.02 to 1.06 in disorder.
inline constexpr double kStressNormalisation = 378 / (5 * 3.14159265358979324);

/// For the particles which[first .. last), with x = x_i - x_j:
/// coefficient[slot] = factor (mu_i + mu_j)/2 V_i V_j g(q) for each slot of their lists, and the sums of
/// coefficient x (x) x: (xx, yy, zz, 0) in `diagonal`, (xy, xz, yz, 0) in `offDiagonal`. Where only one of two has a
/// viscosity, it stands for the mean.
void stressCoefficients(const PairLists& lists, const StressField& field, float factor, const uint32_t* which,
                        size_t first, size_t last, float* coefficient, api::Float4* diagonal, api::Float4* offDiagonal);

/// For the particles which[first .. last): out[k] = sum_j coefficient[slot] (x . (u_i - u_j)) x.
void sumStress(const PairLists& lists, const api::Float4* points, const float* coefficient, const api::Float4* vectors,
               const uint32_t* which, size_t first, size_t last, api::Float4* out);

/// For the particles which[first .. last): out[k] = sum_j V_j g(q) (x . (v_i - v_j))2.
void sumShear(const PairLists& lists, const api::Float4* points, const api::Float4* velocity, const uint32_t* which,
              size_t first, size_t last, float* out);

namespace targets {
int64_t compiled();  ///< Highway's bits of the instruction sets in this binary
}  // namespace targets

}  // namespace ps
