// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/solver/solver.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ps {

/// A body before and after an edit; nothing: it did not exist (then `index` says where it goes).
struct BodyEdit {
  std::string id;
  std::optional<Body> before, after;
  size_t index = 0;
};

/// What a stroke did to the particles. Belongs to the engine's thread: nothing else reads or writes it.
struct StrokeTrace {
  uint64_t run = 0;                ///< of SceneLink; ids of another run mean nothing
  std::vector<uint32_t> ids;       ///< born by an adding stroke, or put back by an undone erasing one
  std::vector<TakenMatter> taken;  ///< what is out of the scene now: by an erasing stroke, or an undone adding one
};

/// One finished stroke.
struct StrokeRecord {
  bool erase = false;
  std::string body;  ///< that an adding stroke paints
  int palette = 0;
  std::vector<std::array<int, 3>> cells;  ///< that it touched, on the lattice of `lattice`
  VoxelShape lattice;                     ///< origin only
  std::vector<BodyEdit> edits;            ///< what it changes in the document
  std::shared_ptr<StrokeTrace> trace = std::make_shared<StrokeTrace>();
};

/// Applies edits to a project's bodies, forwards or backwards (then in reverse order).
void applyEdits(Project& project, const std::vector<BodyEdit>& edits, bool forward);

/// Body `body` with `cells` of `palette` painted where free, and the stroke noted. Throws InputError for a damaged
/// body.
Body withCells(Body body, const std::vector<std::array<int, 3>>& cells, int palette, const VoxelShape::Stroke& stroke);
/// Body without the cells of `lattice` that it holds; nullopt when none is left. Boxes become voxels first.
/// `changed` tells whether it held any.
std::optional<Body> withoutCells(Body body, const VoxelShape& lattice, const std::vector<std::array<int, 3>>& cells,
                                 double spacing, bool& changed);
/// The cells of `lattice` in which no other body has matter at the start (centres within 0.9 spacings): what a reset
/// can bring back without two particles in one place.
std::vector<std::array<int, 3>> freeAtStart(const Project& project, const std::string& body, const VoxelShape& lattice,
                                            const std::vector<std::array<int, 3>>& cells);
/// The body with a box turned into the cells that it fills at the start.
Body asVoxels(Body body, double spacing);
/// Cells of a voxel `body` that `without` lacks, by palette entry: what an undone erasure must bring back.
std::vector<std::vector<std::array<int, 3>>> missingCells(const Body& body, const std::optional<Body>& without);

}  // namespace ps
