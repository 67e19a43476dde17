// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/sketch/grid.h"

#include <span>
#include <vector>

// Why sorted arrays and no hash map: the order of cells decides the order in which particles are born, and so the state
// hash. Sorted by z, y, x the order is the same on every machine, runs along x are neighbours, and a stroke of
// thousands of cells is merged in one pass.
namespace ps {

/// The lattice of a sketch, where it stands.
SketchGrid gridOf(const VoxelShape& voxels);

/// Puts cells in the order of compareCells(), each once.
void putInOrder(std::vector<api::Cell>& cells);

/// A set of cells in the order of compareCells().
class CellSet {
 public:
  CellSet() = default;
  explicit CellSet(std::span<const api::Cell> cells) { add(cells); }

  /// Adds cells in any order, duplicates allowed. O(n + k log k) for k cells.
  void add(std::span<const api::Cell> cells);
  void remove(std::span<const api::Cell> cells);
  /// The same for cells in order, none twice: these allocate nothing, but for add() where there is no more room.
  void addOrdered(std::span<const api::Cell> cells);
  void removeOrdered(std::span<const api::Cell> cells);
  /// Keeps its room.
  void clear() { m_cells.clear(); }
  bool contains(const api::Cell& cell) const;
  bool empty() const { return m_cells.empty(); }
  size_t size() const { return m_cells.size(); }
  std::span<const api::Cell> cells() const { return m_cells; }
  /// As the engine takes them: {x, y, z} each, in the same order.
  std::vector<std::array<int, 3>> indices() const;
  bool operator==(const CellSet& other) const;

 private:
  std::vector<api::Cell> m_cells;
};

/// The cells of a sketched body, each with an index into its palette (VoxelShape::palette).
class VoxelCanvas {
 public:
  struct Entry {
    api::Cell cell;
    int palette = 0;
  };

  VoxelCanvas() = default;
  /// From saved runs. Throws InputError for a run shorter than 1, past the range of int32, or one that covers a cell of
  /// another: "run 3 covers cell (4, 0, 2), which run 1 holds already".
  explicit VoxelCanvas(std::span<const VoxelShape::Run> runs);

  /// Fills the free ones of `cells`; returns those that it filled (for undo: erase them).
  CellSet paint(const CellSet& cells, int palette);
  /// Empties cells; returns what they held (for undo: restore() it).
  VoxelCanvas erase(const CellSet& cells);
  /// Puts back what erase() returned, where the cells are free.
  void restore(const VoxelCanvas& erased);

  /// Run-length encoding along x, in cell order; neighbouring cells of one palette entry make one run. Canonical: equal
  /// canvases give equal runs, however they were painted.
  std::vector<VoxelShape::Run> runs() const;
  CellSet cells() const;
  std::span<const Entry> entries() const { return m_entries; }
  bool empty() const { return m_entries.empty(); }
  size_t size() const { return m_entries.size(); }

 private:
  std::vector<Entry> m_entries;
};

/// Of a sketch in which cells become of a material.
struct Repainted {
  std::vector<VoxelShape::Run> before, after;  ///< of the cells that change
  std::vector<VoxelShape::Paint> added;        ///< that its palette needs beyond its own
};
/// Those of some cells that are there get a coat (core/scene/coat.h): they become of a material, each as warm as it is,
/// or have a colour of their own.
Repainted repainted(const VoxelShape& shape, const CellSet& cells, const std::string& coat);
/// Puts runs in the place of what their cells hold.
void replaceRuns(VoxelShape& shape, std::span<const VoxelShape::Run> runs);

/// Runs of one palette entry.
std::vector<VoxelShape::Run> encodeRuns(const CellSet& cells, int palette);

}  // namespace ps
