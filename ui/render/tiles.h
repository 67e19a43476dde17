// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ps::render {

/// Which squares of a picture something may touch. Costly passes are drawn over those squares only: where a processor
/// draws, shaders have no early way out.
class TileSet {
 public:
  using Corner = std::array<float, 2>;  ///< 0..1 over the picture, from its lower left corner
  static constexpr int kTile = 16;      ///< pixels

  /// No tile of a picture of this many pixels is marked.
  void reset(int width, int height);
  /// Marks the tiles of a square of pixels around (x, y), from the upper left corner of the picture.
  void mark(float x, float y, float reach);
  /// Marks the tiles along a line.
  void markLine(float x0, float y0, float x1, float y1, float reach);
  void markTile(int column, int row) { m_marks[static_cast<size_t>(row * m_columns + column)] = 1; }
  void markAll();
  void remove(const TileSet& other);  ///< of a picture of the same size
  bool full() const;                  ///< all are marked
  int columns() const { return m_columns; }
  int rows() const { return m_rows; }
  bool marked(int column, int row) const { return m_marks[static_cast<size_t>(row * m_columns + column)] != 0; }
  /// Two triangles for each run of tiles in a row, in place of what `out` held.
  void triangles(std::vector<Corner>& out) const;
  /// The number of columns, and then a bit for each tile, row by row, in place of what `out` held.
  void pack(std::vector<uint32_t>& out) const;

 private:
  int m_width = 0, m_height = 0, m_columns = 0, m_rows = 0;
  std::vector<char> m_marks;
};

}  // namespace ps::render
