// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/plane.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ps {

/// The nearest place on triangles, by a tree of boxes (Ericson 2005, "Real-Time Collision Detection", 5.1.5 and 6.2).
/// All of it may be called from any thread. There is one triangle at least.
class MeshNearest {
 public:
  using Triangle = std::array<Vector3, 3>;  ///< corners, m; anticlockwise as seen from outside
  explicit MeshNearest(std::vector<Triangle> triangles);

  struct Hit {
    Vector3 place;   ///< m
    Vector3 normal;  ///< unit, of the triangle; where some meet, of that which faces the place most
    double squared = 0;
  };
  Hit at(const Vector3& place) const;
  /// The nearest place within `reach` m that lies over each of these planes, if there is one.
  std::optional<Hit> within(double reach, const Vector3& place, std::span<const Plane> over = {}) const;
  /// Corners of the box around all of them, m.
  const Vector3& low() const { return m_nodes[0].low; }
  const Vector3& high() const { return m_nodes[0].high; }

 private:
  struct Node {
    Vector3 low, high;             ///< m
    uint32_t first = 0, last = 0;  ///< of m_triangles
    uint32_t right = 0;            ///< second child; the first one follows; 0: a leaf
  };
  struct Search;
  uint32_t build(uint32_t first, uint32_t last);
  void find(Search& search) const;

  std::vector<Triangle> m_triangles;
  std::vector<Node> m_nodes;
};

}  // namespace ps
