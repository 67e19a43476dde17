// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/meshreduce.h"

#include "core/base/progress.h"
#include "core/geometry/meshrepair.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr float kAnyError = 1e30f;  ///< of the mesh's extent: the number of triangles alone decides

}  // namespace

MeshReduction reduce(SceneMesh& mesh, size_t most) {
  const size_t from = mesh.triangles.size();
  if (from <= most) return {from, from, 0};
  const MeshFacts before = factsOf(mesh);
  const float* points = mesh.points.data()->data();
  const size_t count = mesh.points.size(), stride = sizeof mesh.points[0];
  const double extent = double{meshopt_simplifyScale(points, count, stride)};
  for (size_t wanted = most; wanted < from; wanted += wanted / 2 + 1) {
    advance(0);
    SceneMesh reduced = mesh;
    float error = 0;
    const size_t left = meshopt_simplify(reduced.triangles.data()->data(), mesh.triangles.data()->data(), 3 * from,
                                         points, count, stride, 3 * wanted, kAnyError, 0, &error);
    reduced.triangles.resize(left / 3);
    if (reduced.triangles.empty()) continue;
    repair(reduced);  // drops the points that are left over
    const MeshFacts after = factsOf(reduced);
    const bool kept = std::abs(after.volume / before.volume - 1) <= kKeptVolume && after.closed();
    if (before.closed() && !kept) continue;
    mesh = std::move(reduced);
    return {from, mesh.triangles.size(), double{error} * extent};
  }
  return {from, from, 0};
}

}  // namespace ps
