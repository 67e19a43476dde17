// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/solver/structure/flatparts.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ps {

/// Who belongs to each piece, as flat lists that all who ask for pieces share: members ascending, and pieces in order
/// of their first ones. Why runs: particles lie in order of cells, so that neighbours in the list mostly belong to one
/// piece. Threads find where runs begin and copy them; one thread only says where each goes.
class PieceLists {
 public:
  /// `pieceOf` as ConstraintSystem::findPieces() has it: by particle the first of its piece.
  void refresh(std::span<const uint32_t> pieceOf);
  size_t count() const { return m_first.size(); }
  /// Members of one piece after the other.
  std::span<const uint32_t> members() const { return m_members; }
  /// Where those of each piece begin there; one entry more than there are pieces.
  std::span<const size_t> begin() const { return m_begin; }
  std::span<const uint32_t> members(size_t piece) const {
    return members().subspan(m_begin[piece], m_begin[piece + 1] - m_begin[piece]);
  }
  /// The piece whose first member that is.
  size_t pieceOf(uint32_t first) const { return m_number[first]; }

  /// visit(piece, members) for what of [first, last) in members() belongs to each piece.
  template <class Visit>
  void eachPart(size_t first, size_t last, const Visit& visit) const {
    eachFlatPart(m_begin, first, last,
                 [&](size_t piece, size_t from, size_t to) { visit(piece, members(piece).subspan(from, to - from)); });
  }

 private:
  std::vector<size_t> m_begin{0};
  std::vector<uint32_t> m_members;
  std::vector<uint32_t> m_first;       ///< members of pieces
  std::vector<uint32_t> m_number;      ///< of the piece, by its first member; not set for others
  std::vector<uint32_t> m_tied;        ///< particles that belong to any piece, ascending
  std::vector<uint32_t> m_runs, m_to;  ///< where runs of one piece begin among them, and where they go
  std::vector<size_t> m_next;          ///< by piece
};

}  // namespace ps
