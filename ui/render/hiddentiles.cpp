// SPDX-License-Identifier: Apache-2.0
#include "ui/render/hiddentiles.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ps::render {
namespace {

constexpr int kTile = TileSet::kTile;

/// Where the corners of tiles are in triangles. What is seen has a round edge much larger than a tile, so that between
/// corners that are hidden nothing of it shows.
class Corners {
 public:
  Corners(int width, int height)
      : m_width(width),
        m_height(height),
        m_columns((width + kTile - 1) / kTile + 1),
        m_rows((height + kTile - 1) / kTile + 1),
        m_hidden(static_cast<size_t>(m_columns * m_rows)) {}

  /// Pixels, from the upper left corner of the picture.
  void cover(const std::array<Eigen::Vector2d, 3>& triangle) {
    const Eigen::Vector2d low = triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]);
    const Eigen::Vector2d high = triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2]);
    if (!low.allFinite() || !high.allFinite()) return;
    // The outermost corners of tiles lie on the picture's edge, or beyond.
    const auto first = [](double pixel, int count) {
      return static_cast<int>(std::clamp(std::floor(pixel / kTile) - 1, 0.0, count - 1.0));
    };
    const auto last = [](double pixel, int count) {
      return static_cast<int>(std::clamp(std::ceil(pixel / kTile) + 1, 0.0, count - 1.0));
    };
    for (int row = first(low.y(), m_rows); row <= last(high.y(), m_rows); ++row)
      for (int column = first(low.x(), m_columns); column <= last(high.x(), m_columns); ++column)
        if (holds(triangle, place(column, row))) m_hidden[index(column, row)] = 1;
  }
  /// Whether all corners of a tile and of those around it are hidden, as far as the picture goes.
  bool surround(int column, int row) const {
    for (int y = std::max(row - 1, 0); y <= std::min(row + 2, m_rows - 1); ++y)
      for (int x = std::max(column - 1, 0); x <= std::min(column + 2, m_columns - 1); ++x)
        if (!m_hidden[index(x, y)]) return false;
    return true;
  }

 private:
  static constexpr double kInside = 0.5;  // pixels from the picture's edge

  size_t index(int column, int row) const { return static_cast<size_t>(row * m_columns + column); }
  Eigen::Vector2d place(int column, int row) const {
    return {std::clamp<double>(column * kTile, kInside, m_width - kInside),
            std::clamp<double>(row * kTile, kInside, m_height - kInside)};
  }
  /// In either sense of rotation; edges count, so that nothing is left between neighbours.
  static bool holds(const std::array<Eigen::Vector2d, 3>& triangle, const Eigen::Vector2d& point) {
    constexpr double kNone = 1e-9;
    double least = 0, most = 0;
    for (size_t k = 0; k < 3; ++k) {
      const Eigen::Vector2d side = triangle[(k + 1) % 3] - triangle[k], to = point - triangle[k];
      const double turn = side.x() * to.y() - side.y() * to.x();
      least = std::min(least, turn);
      most = std::max(most, turn);
    }
    return least > -kNone || most < kNone;
  }

  int m_width, m_height, m_columns, m_rows;
  std::vector<char> m_hidden;
};

std::array<double, 4> windowOf(const Eye& eye) {
  const Matrix4& p = eye.projection;
  return {p(0, 0), p(1, 1), p(0, 2), p(1, 2)};
}

void mark(TileSet& tiles, const HiddenTriangles& triangles, const std::array<double, 4>& window, int width,
          int height) {
  Corners corners(width, height);
  const auto& [wide, high, right, up] = window;
  for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
    std::array<Eigen::Vector2d, 3> triangle;
    for (size_t k = 0; k < 3; ++k) {
      const double x = double(triangles[i + k][0]) * wide - right, y = double(triangles[i + k][1]) * high - up;
      triangle[k] = {(1 + x) / 2 * width, (1 - y) / 2 * height};
    }
    corners.cover(triangle);
  }
  tiles.reset(width, height);
  for (int row = 0; row < tiles.rows(); ++row)
    for (int column = 0; column < tiles.columns(); ++column)
      if (corners.surround(column, row)) tiles.markTile(column, row);
}

}  // namespace

const HiddenTiles::Hidden* HiddenTiles::find(const std::shared_ptr<const HiddenTriangles>& triangles, const Eye& eye,
                                             int width, int height) {
  if (!triangles || triangles->empty()) return nullptr;
  const std::array<double, 4> window = windowOf(eye);
  const auto known = std::find_if(m_found.begin(), m_found.end(), [&](const Found& one) {
    return one.triangles == triangles && one.window == window && one.width == width && one.height == height;
  });
  if (known != m_found.end()) {
    m_found.splice(m_found.begin(), m_found, known);
  } else {
    m_found.push_front({triangles, window, width, height, {}});
    Hidden& hidden = m_found.front().hidden;
    mark(hidden.tiles, *triangles, window, width, height);
    hidden.tiles.triangles(hidden.corners);
    hidden.tiles.pack(hidden.bits);
    if (m_found.size() > kKept) m_found.pop_back();
  }
  const Hidden& hidden = m_found.front().hidden;
  return hidden.corners.empty() ? nullptr : &hidden;
}

}  // namespace ps::render
