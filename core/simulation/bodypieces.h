// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/command.h"

#include <vector>

namespace ps {

class Engine;

/// The pieces that a sketched body has come to by now, the one of most particles first: the cells that the matter of
/// each was made of, as far as that is known. One that is whole is one piece. Solid matter is of one piece where it is
/// tied together and no gap of a whole particle goes through it; four particles at least. What is loose, melted or
/// smaller is of the piece that it touches, else of the first. Where nothing is tied, matter that touches is a piece.
/// In a periodic box, where a gap is no gap at its faces, ties alone decide.
std::vector<CellIndices> piecesOf(const Engine& engine, const Body& body);

}  // namespace ps
