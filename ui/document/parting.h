// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/command.h"
#include "ui/document/strokerecord.h"

#include <functional>
#include <string>
#include <vector>

namespace ps {

/// A sketched body that has come apart: some of its cells, and the matter that was made of them, are bodies of their
/// own.
struct Parting {
  std::string body;    ///< Body::id
  VoxelShape lattice;  ///< see latticeOf()
  struct Piece {
    std::string body;   ///< Body::id of the new one
    CellIndices cells;  ///< of the matter that is its own by now, not all of them cells of the document
  };
  std::vector<Piece> pieces;
  std::vector<SceneEdit> edits;  ///< what it changes in the document
};

/// A part of a sketched body with some of its cells: of its strokes it has those that may have drawn them, by their
/// ways or because they may reach far from these, and of a power its share.
Body pieceOf(const Body& body, const VoxelCanvas& cells,
             const std::function<bool(const VoxelShape::Stroke&)>& reachesFar);
/// The body without the cells of its pieces. It keeps its strokes: drawn again it leaves free what others hold.
Body restOf(const Body& body, const std::vector<VoxelCanvas>& pieces);

}  // namespace ps
