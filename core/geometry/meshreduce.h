// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

namespace ps {

/// What was done to a mesh to have fewer triangles.
struct MeshReduction {
  size_t from = 0, to = 0;  ///< triangles
  double error = 0;         ///< m, how far its surface was moved at most, as edge collapses measure it
  bool any() const { return to < from; }
};

/// Collapses edges where that moves the surface least (quadrics of Garland & Heckbert 1997, "Surface simplification
/// using quadric error metrics", by meshoptimizer), until `most` triangles are left. More are, where fewer would have
/// another topology or, of a closed mesh, change its volume by more than kKeptVolume. Of a mesh that has been repaired:
/// points that are the same place are one. The same bits for the same mesh. Throws Cancelled.
MeshReduction reduce(SceneMesh& mesh, size_t most);
inline constexpr double kKeptVolume = 0.005;

}  // namespace ps
