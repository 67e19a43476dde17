// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"
#include "core/sketch/cellset.h"

#include <array>
#include <optional>
#include <vector>

namespace ps {

/// The cells that a brush fills at a touch, as a body with a surface: faces between a cell and none, and their edges.
/// Why not the cells themselves: a picture of it needs what can be seen from somewhere, thirty times a second.
struct StampForm {
  struct Face {
    std::array<int, 3> cell{};  ///< that it belongs to
    int axis = 0;               ///< it stands across
    int side = 1;               ///< -1: towards lower values
  };
  struct Edge {
    std::array<int, 3>
        from{};  ///< corner of cell `from` towards lower values, from which it goes one cell along `axis`
    int axis = 0;
    std::vector<size_t> faces;  ///< that meet there
  };
  double spacing = 0;      ///< m, edge of a cell
  Vector3 first{0, 0, 0};  ///< m, middle of cell (0, 0, 0) from where the brush is
  std::vector<Face> faces;
  std::vector<Edge> edges;

  /// m from where the brush is: corner of a cell towards lower values.
  Vector3 corner(const std::array<int, 3>& cell) const;
  Vector3 middle(const Face& face) const;
  Vector3 normal(const Face& face) const;
  /// Around it.
  std::array<Vector3, 4> corners(const Face& face) const;
  /// From an eye, in m from where the brush is.
  bool isSeen(const Face& face, const Vector3& eye) const;
  /// The edges between what can be seen from there and what cannot: its outline, and that of what stands out in front.
  std::vector<std::array<Vector3, 2>> outline(const Vector3& eye) const;
};

/// Of cells on a lattice; more than a picture shows are taken together, eight by eight. nullopt: there are none, or
/// they are a box, whose edges say more.
std::optional<StampForm> stampForm(const CellSet& cells, double spacing, const Vector3& first);

}  // namespace ps
