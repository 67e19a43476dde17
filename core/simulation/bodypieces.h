// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/command.h"
#include "core/simulation/snapshot.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ps {

class Engine;

/// A scene at a moment with what ties its matter together. The engine's thread gives it at once; what pieces there are
/// takes longer, and may be found on any thread.
struct TiedScene {
  SnapshotPtr scene;           ///< nullptr: none was asked for
  std::vector<uint32_t> ties;  ///< Solver::pieces() of its particles
};
TiedScene tiedScene(const Engine& engine);
/// Whether some of a body is solid.
bool isSolid(const TiedScene& moment, const std::string& body);
/// Whether a body is sketched, and its pieces could go anywhere: those of what is locked or held in place cannot.
bool mayComeApart(const Body& body);

/// The pieces that a sketched body has come to at a moment, the one of most particles first: the cells that the matter
/// of each was made of, as far as that is known. One that is whole is one piece. Solid matter is of one piece where it
/// is tied together and no gap of a whole particle goes through it; four particles at least. What is loose, melted or
/// smaller is of the piece that it touches, else of the first. Where nothing is tied, matter that touches is a piece.
/// In a periodic box, where a gap is no gap at its faces, ties alone decide.
std::vector<CellIndices> piecesOf(const TiedScene& moment, const Body& body);

/// The pieces of a body that have come off since it was of the pieces `before`: of those that one of these has come to,
/// all but the largest. One of fewer than `least` cells is a crumb, and has come off nothing.
std::vector<CellIndices> cutOff(const std::vector<CellIndices>& before, const std::vector<CellIndices>& after,
                                size_t least);

}  // namespace ps
