// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

namespace ps {

/// What a mesh is found to be.
struct MeshFacts {
  size_t triangles = 0;
  size_t openEdges = 0;  ///< that belong to one triangle only, or that two see the same way round
  double volume = 0;     ///< m3 that it encloses; of an open one it depends on where the holes are
  bool closed() const { return triangles > 0 && openEdges == 0; }
};
MeshFacts factsOf(const SceneMesh& mesh);

/// What was wrong with a mesh and is no more.
struct MeshRepair {
  size_t joined = 0;    ///< points that were the same place as another one
  size_t left = 0;      ///< triangles without an area
  bool turned = false;  ///< it was inside out
};

/// Makes one point of those that are the same place (within a millionth of the mesh's extent), leaves out triangles
/// without an area and points that no triangle needs, and turns all triangles of a mesh that is inside out.
/// Throws Cancelled, and InputError for a point that is no number, a triangle of a point that does not exist, and where
/// no triangle is left.
MeshRepair repair(SceneMesh& mesh);

}  // namespace ps
