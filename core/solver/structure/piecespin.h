// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/parallel.h"
#include "core/math/vector.h"
#include "core/particles/particlestore.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ps {

class PieceLists;
struct StructureGraph;

/// Gives what hangs together back the angular momentum that velocities of first order lose. XPBD takes
/// v = (x - x_old)/dt, as if the impulses of the substep, m (x - x_predicted)/dt, had acted at the places of before;
/// constraints find them at the predicted places, where they add up to no torque. The difference, dt times the sum of
/// m v_predicted x v about the centre, makes a free block that turns at w lose spin as w/sqrt(1 + 2 w^2 t dt). Here
/// each connected piece gets it back as a rigid turn, I^-1 dL. So it gets what contact has turned it: pushes of two
/// that are not along the line of their centres are a couple, which is given back to their pieces. It cannot do: pieces
/// with fixed particles, single particles and liquids, and the first of both for groups (rigid bodies and clusters keep
/// theirs themselves).
class PieceSpin {
 public:
  /// After a new order or a new structure, whose pieces live as long as they are the same.
  void refresh(const ParticleStore& store, const StructureGraph& graph, const PieceLists& pieces);
  /// While velocities are still those of the prediction. `couple` has by particle what turns its piece back, kg m2;
  /// none where nothing touched.
  void read(const ParticleStore& store, std::span<const api::Float4> couple, double dt);
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
    Vector3 couple;                      ///< kg m2
    Matrix3 moments;                     ///< kg m2: m x x^T
  };
  struct Piece {
    Vector3 centre, spin;  ///< m, rad/s
    bool grouped = false;
  };
  Sums sumOf(const ParticleStore& store, const Run& run, std::span<const api::Float4> couple, double dt) const;

  std::vector<uint8_t> m_kinds;         ///< of pieces: what there is among their members
  std::span<const uint32_t> m_members;  ///< piece by piece
  std::vector<Run> m_runs;
  std::vector<Sums> m_sums;  ///< of runs
  std::vector<Piece> m_pieces;
};

}  // namespace ps
