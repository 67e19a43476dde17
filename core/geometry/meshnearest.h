// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ps {

/// The nearest place on triangles, by a tree of boxes (Ericson 2005, "Real-Time Collision Detection", 5.1.5 and 6.2).
class MeshNearest {
 public:
  using Triangle = std::array<Vector3, 3>;  ///< corners, m; anticlockwise as seen from outside
  explicit MeshNearest(std::vector<Triangle> triangles);

  struct Hit {
    Vector3 place;   ///< m
    Vector3 normal;  ///< unit, of the triangle
    double squared = 0;
  };
  /// May be called from any thread. There is one triangle at least.
  Hit at(const Vector3& place) const;

 private:
  struct Node {
    Vector3 low, high;             ///< m
    uint32_t first = 0, last = 0;  ///< of m_triangles
    uint32_t right = 0;            ///< second child; the first one follows; 0: a leaf
  };
  uint32_t build(uint32_t first, uint32_t last);

  std::vector<Triangle> m_triangles;
  std::vector<Node> m_nodes;
};

}  // namespace ps
