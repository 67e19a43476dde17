// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/camera.h"
#include "ui/render/tiles.h"

#include <array>
#include <list>
#include <memory>
#include <vector>

namespace ps::render {

/// Finds which tiles of pictures nobody sees, and keeps what it found for as long as the eyes' windows stay as they
/// are.
class HiddenTiles {
 public:
  struct Hidden {
    TileSet tiles;
    std::vector<TileSet::Corner> corners;  ///< as TileSet::triangles()
    std::vector<uint32_t> bits;            ///< as TileSet::pack()
  };
  /// Tiles that lie in the triangles with a tile around them, so that what is seen may look a little way over its edge;
  /// nullptr where there are none. It stays until the next call.
  const Hidden* find(const std::shared_ptr<const HiddenTriangles>& triangles, const Eye& eye, int width, int height);

 private:
  struct Found {
    std::shared_ptr<const HiddenTriangles> triangles;
    std::array<double, 4> window{};  ///< of the projection
    int width = 0, height = 0;       ///< pixels
    Hidden hidden;
  };
  static constexpr size_t kKept = 4;
  std::list<Found> m_found;  ///< the one used last comes first
};

}  // namespace ps::render
