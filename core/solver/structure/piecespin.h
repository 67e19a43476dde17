// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"
#include "core/particles/particlestore.h"

#include <cstdint>
#include <vector>

namespace ps {

class ConstraintSystem;
struct StructureGraph;

/// Gives what hangs together back the angular momentum that velocities of first order lose. XPBD takes
/// v = (x - x_old)/dt, as if the impulses of the substep, m (x - x_predicted)/dt, had acted at the places of before;
/// constraints find them at the predicted places, where they add up to no torque. The difference, dt times the sum of
/// m v_predicted x v about the centre, makes a free block that turns at w lose spin as w/sqrt(1 + 2 w^2 t dt). Here
/// each connected piece gets it back as a rigid turn, I^-1 dL. It cannot do: pieces with fixed particles or with groups
/// (rigid bodies and clusters keep theirs themselves), single particles and liquids.
class PieceSpin {
 public:
  /// After a new order or a new structure.
  void refresh(const ParticleStore& store, ConstraintSystem& constraints);
  /// While velocities are still those of the prediction.
  void read(const ParticleStore& store, double dt);
  /// When velocities follow from positions.
  void apply(ParticleStore& store) const;

 private:
  /// Members from `first` to `last` of a piece, as many as a chunk holds.
  struct Run {
    size_t first, last, piece;
  };
  struct Sums {
    double mass = 0;                     ///< kg
    Vector3 place, predicted, momentum;  ///< kg m, kg m/s, kg m/s
    Vector3 torque;                      ///< kg m2/s2: m v_predicted x v
    Matrix3 moments;                     ///< kg m2: m x x^T
  };
  struct Piece {
    Vector3 centre, spin;  ///< m, rad/s
  };

  void findPieces(const ParticleStore& store, const StructureGraph& graph);

  static constexpr uint32_t kNone = ~0u;
  std::vector<uint32_t> m_piece;    ///< of each particle, kNone for one that is tied to nothing
  std::vector<uint32_t> m_count;    ///< members of each piece, 0 for one that is left out
  std::vector<uint32_t> m_open;     ///< of a piece, still to be followed
  std::vector<uint32_t> m_members;  ///< piece by piece
  std::vector<Run> m_runs;
  std::vector<Sums> m_sums;  ///< of runs
  std::vector<Piece> m_pieces;
};

}  // namespace ps
