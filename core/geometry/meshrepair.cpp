// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/meshrepair.h"

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/scene/solidform.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace ps {
namespace {

using Triangle = std::array<uint32_t, 3>;
constexpr double kSamePlace = 1e-6;  ///< of the largest extent

Vector3 pointOf(const SceneMesh& mesh, uint32_t index) {
  const auto& p = mesh.points[index];
  return {p[0], p[1], p[2]};
}

/// Points of one cell of a fine lattice become the first of them. Two that lie on either side of a face stay apart,
/// which leaves a crack too thin for a winding number to notice. Returns how many became another one.
size_t weld(SceneMesh& mesh) {
  const MeshBounds bounds = boundsOf(mesh);
  const double edge = std::max((bounds.maximum - bounds.minimum).maxCoeff() * kSamePlace, 1e-30);
  using Cell = std::tuple<int64_t, int64_t, int64_t>;
  std::vector<Cell> cells(mesh.points.size());
  for (uint32_t i = 0; i < cells.size(); ++i) {
    const Vector3 at = (pointOf(mesh, i) - bounds.minimum) / edge;
    cells[i] = {std::llround(at[0]), std::llround(at[1]), std::llround(at[2])};
  }
  std::vector<uint32_t> order(cells.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return cells[a] < cells[b]; });
  std::vector<uint32_t> first(cells.size());
  size_t joined = 0;
  for (size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && cells[order[k]] == cells[order[k - 1]];
    first[order[k]] = same ? first[order[k - 1]] : order[k];
    joined += same ? 1 : 0;
  }
  for (Triangle& t : mesh.triangles) {
    for (uint32_t& i : t) i = first[i];
  }
  return joined;
}

bool hasArea(const SceneMesh& mesh, const Triangle& t) {
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return false;
  const Vector3 a = pointOf(mesh, t[0]);
  return (pointOf(mesh, t[1]) - a).cross(pointOf(mesh, t[2]) - a).squaredNorm() > 0;
}

void dropUnused(SceneMesh& mesh) {
  constexpr uint32_t kNone = ~0u;
  std::vector<uint32_t> now(mesh.points.size(), kNone);
  std::vector<std::array<float, 3>> points;
  for (Triangle& t : mesh.triangles) {
    for (uint32_t& i : t) {
      if (now[i] == kNone) {
        now[i] = static_cast<uint32_t>(points.size());
        points.push_back(mesh.points[i]);
      }
      i = now[i];
    }
  }
  mesh.points = std::move(points);
}

}  // namespace

MeshFacts factsOf(const SceneMesh& mesh) {
  // Each edge of a closed surface is seen once from either side.
  std::vector<std::pair<uint64_t, int>> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint64_t from = t[k], to = t[(k + 1) % 3];
      edges.emplace_back(std::min(from, to) << 32 | std::max(from, to), from < to ? 1 : -1);
    }
  }
  std::sort(edges.begin(), edges.end());
  MeshFacts facts;
  facts.triangles = mesh.triangles.size();
  for (size_t k = 0; k < edges.size();) {
    int sides = 0;
    const uint64_t edge = edges[k].first;
    for (; k < edges.size() && edges[k].first == edge; ++k) sides += edges[k].second;
    facts.openEdges += sides != 0;
  }
  facts.volume = std::abs(signedVolume(mesh));
  return facts;
}

MeshRepair repair(SceneMesh& mesh) {
  if (const std::string problem = problemOf(mesh); !problem.empty()) throw InputError("of its mesh " + problem);
  MeshRepair done;
  done.joined = weld(mesh);
  advance(0);
  done.left = std::erase_if(mesh.triangles, [&](const Triangle& t) { return !hasArea(mesh, t); });
  if (mesh.triangles.empty()) throw InputError("the mesh has no triangle with an area");
  dropUnused(mesh);
  advance(0);
  done.turned = signedVolume(mesh) < 0;
  for (Triangle& t : mesh.triangles) {
    if (done.turned) std::swap(t[1], t[2]);
  }
  return done;
}

}  // namespace ps
