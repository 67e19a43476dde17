// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/rigidmove.h"
#include "core/scene/project.h"
#include "core/sketch/cellset.h"
#include "ui/document/matterref.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ps {

/// A body before and after an edit; nothing: it did not exist (then `index` says where it goes).
struct BodyEdit {
  std::string id;
  std::optional<Body> before, after;
  size_t index = 0;
};

/// Cells that a sketched body gains or loses. Why not the body before and after: it carries the samples of all strokes
/// so far, and a hundred strokes would be kept five thousand times.
struct CellsEdit {
  std::string id;
  bool erase = false;
  std::vector<VoxelShape::Run> cells;       ///< added, or erased
  std::vector<VoxelShape::Stroke> strokes;  ///< that did it, noted with the body's earlier ones
  std::vector<VoxelShape::Paint> added{};   ///< that its palette needs beyond its own
};
/// Cells of a sketched body that become of another material.
struct RepaintEdit {
  std::string id;
  Repainted cells;
  std::vector<VoxelShape::Stroke> strokes;  ///< that did it, noted with the body's earlier ones
};
using SceneEdit = std::variant<BodyEdit, CellsEdit, RepaintEdit>;

/// One finished stroke.
struct StrokeRecord {
  bool erase = false;
  /// SceneMaterial::id that matter becomes, or the colour that it gets (core/scene/coat.h); "": it paints nothing
  std::string material{};
  std::string body;  ///< that an adding stroke paints
  int palette = 0;
  std::vector<std::array<int, 3>> cells;  ///< that it touched, on the lattice of `lattice`
  VoxelShape lattice;                     ///< see latticeOf()
  RigidMove way{};                        ///< from where the document has that lattice to where it stood
  std::vector<SceneEdit> edits;           ///< what it changes in the document
  MatterRef matter = newMatter();         ///< its particles
  bool onlyNow = false;                   ///< none of what it drew has room at the start
  /// What it did to the matter that was there: "Heat matter"; the document's bodies are as before. "": it drew or
  /// erased.
  std::string deed{};
};

/// Applies edits to a project's bodies, forwards or backwards (then in reverse order).
void applyEdits(Project& project, const std::vector<SceneEdit>& edits, bool forward);
const std::string& bodyOf(const SceneEdit& edit);

/// Paints `cells` where they are free with what `painted` has at `palette`, and notes the stroke: into the project's
/// body of the id of `painted`, whose palette grows where it has no such entry, or as that body where there is none
/// yet. Throws InputError for a damaged body.
SceneEdit paintEdit(const Project& project, const Body& painted, const std::vector<std::array<int, 3>>& cells,
                    int palette, const VoxelShape::Stroke& stroke);
/// Takes the cells of `lattice` out of a body, the project's at `index`; boxes become cells first. Nothing when it
/// holds none of them. A body that was drawn by strokes keeps the erasing ones as well.
std::optional<SceneEdit> eraseEdit(const Body& body, size_t index, const VoxelShape& lattice,
                                   const std::vector<std::array<int, 3>>& cells,
                                   const std::vector<VoxelShape::Stroke>& strokes = {});
/// Makes the cells of `lattice` of a material in a body, the project's at `index`; boxes become cells first, by an edit
/// before. None where it has none of them that are of another material. A body that was drawn by strokes keeps those
/// that paint as well.
std::vector<SceneEdit> repaintEdits(const Body& body, size_t index, const VoxelShape& lattice,
                                    const std::vector<std::array<int, 3>>& cells, const std::string& material,
                                    const std::vector<VoxelShape::Stroke>& strokes = {});
/// Cells by palette entry that an erasing edit took, on the lattice of asVoxels(body, spacing); `spacing`: of the
/// lattice that erased.
std::vector<std::vector<std::array<int, 3>>> takenCells(const SceneEdit& edit, double spacing);
/// The cells of `lattice` in which no other body has matter at the start (centres within 0.9 of its spacing): what a
/// reset can bring back without two particles in one place.
std::vector<std::array<int, 3>> freeAtStart(const Project& project, const std::string& body, const VoxelShape& lattice,
                                            const std::vector<std::array<int, 3>>& cells);
/// The body as cells of edge `spacing` m: those that a box fills at the start; a sketch of another spacing resampled.
Body asVoxels(Body body, double spacing);

}  // namespace ps
