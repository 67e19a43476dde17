// SPDX-License-Identifier: Apache-2.0
#include "core/sketch/cellset.h"

#include "core/base/error.h"
#include "core/scene/coat.h"
#include "core/scene/pose.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <string>

namespace ps {
namespace {

bool before(const api::Cell& a, const api::Cell& b) { return compareCells(a, b) < 0; }
bool beforeEntry(const VoxelCanvas::Entry& a, const VoxelCanvas::Entry& b) { return before(a.cell, b.cell); }

std::vector<api::Cell> sorted(std::span<const api::Cell> cells) {
  std::vector<api::Cell> result(cells.begin(), cells.end());
  putInOrder(result);
  return result;
}

void checkRun(const VoxelShape::Run& run, size_t number) {
  const int64_t last = int64_t{run.x} + run.length - 1;
  if (run.length < 1)
    throw InputError("run " + std::to_string(number) + ": its length must be at least 1, not " +
                     std::to_string(run.length));
  if (last > std::numeric_limits<int>::max())
    throw InputError("run " + std::to_string(number) + ": it ends past the largest cell index");
}

/// Appends a cell to the last run, or begins a new one.
void extend(std::vector<VoxelShape::Run>& runs, const api::Cell& cell, int palette) {
  if (!runs.empty()) {
    VoxelShape::Run& last = runs.back();
    if (last.z == cell.z && last.y == cell.y && last.palette == palette && int64_t{last.x} + last.length == cell.x) {
      ++last.length;
      return;
    }
  }
  runs.push_back({cell.x, cell.y, cell.z, 1, palette});
}

}  // namespace

SketchGrid gridOf(const VoxelShape& voxels) { return {voxels.origin, voxels.spacing, poseOf(voxels)}; }

void putInOrder(std::vector<api::Cell>& cells) {
  std::sort(cells.begin(), cells.end(), before);
  cells.erase(std::unique(cells.begin(), cells.end(), sameCell), cells.end());
}

void CellSet::add(std::span<const api::Cell> cells) { addOrdered(sorted(cells)); }

void CellSet::remove(std::span<const api::Cell> cells) { removeOrdered(sorted(cells)); }

void CellSet::addOrdered(std::span<const api::Cell> cells) {
  size_t old = m_cells.size(), common = 0;
  for (size_t i = 0, k = 0; i < old && k < cells.size();) {
    const std::strong_ordering order = compareCells(m_cells[i], cells[k]);
    common += order == 0 ? 1 : 0;
    i += order <= 0 ? 1 : 0;
    k += order >= 0 ? 1 : 0;
  }
  size_t fresh = cells.size() - common;
  m_cells.resize(old + fresh);
  // From the end on, so that none is written over before it has moved; what is left in front stays where it is.
  for (size_t k = cells.size(), to = m_cells.size(); fresh > 0;) {
    if (old > 0 && before(cells[k - 1], m_cells[old - 1])) {
      m_cells[--to] = m_cells[--old];
    } else {
      const bool isNew = old == 0 || !sameCell(cells[k - 1], m_cells[old - 1]);
      --(isNew ? fresh : old);
      m_cells[--to] = cells[--k];
    }
  }
}

void CellSet::removeOrdered(std::span<const api::Cell> cells) {
  auto outgoing = cells.begin();
  std::erase_if(m_cells, [&](const api::Cell& cell) {
    while (outgoing != cells.end() && before(*outgoing, cell)) ++outgoing;
    return outgoing != cells.end() && sameCell(*outgoing, cell);
  });
}

bool CellSet::contains(const api::Cell& cell) const {
  return std::binary_search(m_cells.begin(), m_cells.end(), cell, before);
}

std::vector<std::array<int, 3>> CellSet::indices() const {
  std::vector<std::array<int, 3>> result;
  result.reserve(m_cells.size());
  for (const api::Cell& cell : m_cells) result.push_back({cell.x, cell.y, cell.z});
  return result;
}

bool CellSet::operator==(const CellSet& other) const {
  return std::equal(m_cells.begin(), m_cells.end(), other.m_cells.begin(), other.m_cells.end(), sameCell);
}

VoxelCanvas::VoxelCanvas(std::span<const VoxelShape::Run> runs) {
  struct Owned {
    Entry entry;
    size_t run;
  };
  std::vector<Owned> owned;
  for (size_t r = 0; r < runs.size(); ++r) {
    checkRun(runs[r], r);
    for (int i = 0; i < runs[r].length; ++i)
      owned.push_back({{{runs[r].x + i, runs[r].y, runs[r].z}, runs[r].palette}, r});
  }
  std::stable_sort(owned.begin(), owned.end(),
                   [](const Owned& a, const Owned& b) { return beforeEntry(a.entry, b.entry); });
  m_entries.reserve(owned.size());
  for (size_t i = 0; i < owned.size(); ++i) {
    const api::Cell& cell = owned[i].entry.cell;
    if (i > 0 && sameCell(owned[i - 1].entry.cell, cell))
      throw InputError("run " + std::to_string(owned[i].run) + " covers cell (" + std::to_string(cell.x) + ", " +
                       std::to_string(cell.y) + ", " + std::to_string(cell.z) + "), which run " +
                       std::to_string(owned[i - 1].run) + " holds already");
    m_entries.push_back(owned[i].entry);
  }
}

CellSet VoxelCanvas::paint(const CellSet& cells, int palette) {
  CellSet filled = cells;
  filled.remove(this->cells().cells());
  VoxelCanvas fresh;
  fresh.m_entries.reserve(filled.size());
  for (const api::Cell& cell : filled.cells()) fresh.m_entries.push_back({cell, palette});
  restore(fresh);
  return filled;
}

VoxelCanvas VoxelCanvas::erase(const CellSet& cells) {
  VoxelCanvas erased;
  std::vector<Entry> kept;
  kept.reserve(m_entries.size());
  for (const Entry& entry : m_entries) (cells.contains(entry.cell) ? erased.m_entries : kept).push_back(entry);
  m_entries = std::move(kept);
  return erased;
}

void VoxelCanvas::restore(const VoxelCanvas& erased) {
  std::vector<Entry> merged;
  merged.reserve(m_entries.size() + erased.m_entries.size());
  // set_union takes what both hold from the first range: an occupied cell keeps its palette entry.
  std::set_union(m_entries.begin(), m_entries.end(), erased.m_entries.begin(), erased.m_entries.end(),
                 std::back_inserter(merged), beforeEntry);
  m_entries = std::move(merged);
}

std::vector<VoxelShape::Run> VoxelCanvas::runs() const {
  std::vector<VoxelShape::Run> result;
  for (const Entry& entry : m_entries) extend(result, entry.cell, entry.palette);
  return result;
}

CellSet VoxelCanvas::cells() const {
  std::vector<api::Cell> result;
  result.reserve(m_entries.size());
  for (const Entry& entry : m_entries) result.push_back(entry.cell);
  return CellSet(result);
}

Repainted repainted(const VoxelShape& shape, const CellSet& cells, const std::string& coat) {
  Repainted result;
  std::vector<VoxelShape::Paint> palette = shape.palette;
  const auto entryOf = [&](const VoxelShape::Paint& wanted) {
    const auto found = std::find_if(palette.begin(), palette.end(), [&](const VoxelShape::Paint& paint) {
      return paint.material == wanted.material && paint.temperature == wanted.temperature &&
             paint.colour == wanted.colour;
    });
    const auto entry = static_cast<int>(found - palette.begin());
    if (found == palette.end())
      result.added.push_back(
          palette.emplace_back(VoxelShape::Paint{wanted.material, wanted.temperature, wanted.colour}));
    return entry;
  };
  const VoxelCanvas hit = VoxelCanvas(shape.runs).erase(cells);
  for (const VoxelCanvas::Entry& entry : hit.entries()) {
    const VoxelShape::Paint before = palette.at(static_cast<size_t>(entry.palette));
    VoxelShape::Paint after = before;
    if (isColour(coat)) {
      after.colour = coat == kNoColour ? "" : coat;
    } else {
      after.material = coat;
    }
    if (after == before) continue;
    extend(result.before, entry.cell, entry.palette);
    extend(result.after, entry.cell, entryOf(after));
  }
  return result;
}

void replaceRuns(VoxelShape& shape, std::span<const VoxelShape::Run> runs) {
  VoxelCanvas canvas(shape.runs);
  const VoxelCanvas changed(runs);
  canvas.erase(changed.cells());
  canvas.restore(changed);
  shape.runs = canvas.runs();
}

std::vector<VoxelShape::Run> encodeRuns(const CellSet& cells, int palette) {
  std::vector<VoxelShape::Run> result;
  for (const api::Cell& cell : cells.cells()) extend(result, cell, palette);
  return result;
}

}  // namespace ps
