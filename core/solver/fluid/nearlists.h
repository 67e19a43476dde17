// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/pairroom.h"
#include "core/solver/fluid/pairkernels.h"

#include <span>

namespace ps {

/// Copies of neighbour lists without what is out of reach. Lists are made to last until a particle has moved half the
/// skin, and a quarter of their entries lie beyond the support; passes that go over them many times in a substep pay
/// for one that leaves these out. Both particles of a pair keep it or lose it. What comes nearer than the support
/// within the passes is missed: by then it weighs less than a ten-thousandth of the particle itself.
class NearLists {
 public:
  /// Makes room for the lists of so many particles, which are yet to be found.
  void start(const PairLists& all, size_t particles);
  /// Lists of `which`, with the pairs that are no farther apart than the support and a fiftieth of it. `points` are
  /// those of all particles, with the dummy behind them.
  void find(const PairLists& all, const api::Float4* points, std::span<const uint32_t> which);
  /// For sumDensityFindingNear().
  NearRoom room();
  /// As long as `all` holds. Slots lie where they did.
  PairLists lists(const PairLists& all) const;
  /// Where the lists lie, and a float for each entry; they are lost when somebody else writes there.
  PairRoom& pairs() { return m_pairs; }

 private:
  std::vector<uint32_t> m_last;
  PairRoom m_pairs;
};

}  // namespace ps
