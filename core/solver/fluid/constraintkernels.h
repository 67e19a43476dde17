// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/solver/fluid/halfspaces.h"
#include "core/solver/fluid/pairkernels.h"

// What density constraints do with each particle between two passes over pairs. As those passes, these loops are
// compiled for every instruction set and give the same bits on each: a lane is one particle.
namespace ps {

/// What a density constraint is solved from, by particle.
struct ConstraintFields {
  const api::Float4 *points, *velocity;  ///< position, scaled volume; w of the velocity: 1/kg
  const float* compression;              ///< what is allowed yet, see DensityStage::handOver()
  /// What surfaces of fixed bodies add, by place in the list of particles, with spare elements as sums have
  /// them; nullptr for nothing.
  const HalfSpaces::Sum* ofShapes = nullptr;
};

struct ConstraintRule {
  float relaxation, epsilon;  ///< epsilon: 1/m2, added to the squared gradient
  float inverseSupportSquared;
};

/// Gradient in 1/m and multiplier of a density constraint.
struct DensityConstraint {
  float x, y, z, lambda;
};

/// For the particles which[first .. last), from their sums over pairs and what walls add: the constraint of each, and
/// its place with the multiplier in `multipliers`, by particle. The multiplier is -relaxation C/(sum of w_j |grad_j
/// C|2), 0 where C <= 0 (Macklin & Mueller 2013, eq. 11). `first` is a multiple of 16, `last` too or the end: the
/// arrays by place in `which` hold 16 elements more than that.
void solveConstraints(const ConstraintRule& rule, const ConstraintFields& fields, const HalfSpaces& walls,
                      const uint32_t* which, size_t first, size_t last, const DensitySums* sums, const float* squares,
                      DensityConstraint* constraints, api::Float4* multipliers);

/// What density moves, by particle.
struct MoveFields {
  api::Float4* position;
  api::Float4* carried;  ///< m, of the iteration before; w: its multiplier
  const api::Float4* velocity;
  const float *volume, *mass;  ///< scaled; kg
  float* multiplierSum;        ///< or nullptr
};

struct MoveRule {
  float chebyshev;  ///< factor of the semi-iteration; 1: a step of Jacobi's
  float inverseSupportSquared;
};

/// Moves the particles which[first .. last) by what others' multipliers gave to them (`byOthers`), what their own did
/// (`constraints`; nullptr for what has none), and `beside`, m kg (or nullptr); carries on as the semi-iteration asks.
/// Returns what was moved, m kg.
api::Double3 applyMoves(const MoveRule& rule, const MoveFields& fields, const uint32_t* which, size_t first,
                        size_t last, const api::Float4* byOthers, const DensityConstraint* constraints,
                        const api::Float4* beside);

}  // namespace ps
