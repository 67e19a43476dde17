// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <vector>

namespace ps {

/// How often a mesh winds around a place: 1 inside of a closed one, 0 outside, and in between near the holes of an open
/// one, so that it tells inside from outside where counting crossings cannot. Jacobson, Kavan, Sorkine-Hornung 2013,
/// "Robust inside-outside segmentation using generalized winding numbers", eq. 5 with the solid angle of van Oosterom
/// and Strackee 1983; triangles that are far away count together as one dipole: Barill, Dickson, Schmidt, Levin,
/// Jacobson 2018, "Fast winding numbers for soups and clouds", eq. 13. The dipole is wrong by some hundredths at most
/// (farther away than twice the radius of what it stands for).
class MeshWinding {
 public:
  explicit MeshWinding(const SceneMesh& mesh);
  /// May be called from any thread.
  double at(const Vector3& place) const;

 private:
  struct Node {
    Vector3 centre;                ///< m, of its triangles by area
    Vector3 dipole;                ///< m2, sum of area times normal
    double radius = 0;             ///< m about `centre`
    uint32_t first = 0, last = 0;  ///< of m_corners / 3
    uint32_t left = 0, right = 0;  ///< children; 0: a leaf
  };
  uint32_t build(std::vector<uint32_t>& order, const std::vector<Vector3>& centres, uint32_t first, uint32_t last,
                 const SceneMesh& mesh);

  std::vector<Vector3> m_corners;  ///< three for each triangle
  std::vector<Node> m_nodes;
};

}  // namespace ps
