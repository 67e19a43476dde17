// SPDX-License-Identifier: Apache-2.0
#include "ui/document/redrawing.h"

#include "core/plugin_host/registry.h"
#include "core/scene/pose.h"
#include "core/scene/shownname.h"
#include "core/simulation/compile.h"
#include "core/sketch/redraw.h"
#include "core/sketch/stroke.h"
#include "ui/document/strokerecord.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace ps {
namespace {

/// Matter of one body at the start, its cells' middles, within a radius (m) of a place; in a periodic box its nearest
/// images.
void addSeen(const Project& project, const VoxelShape& voxels, size_t body, const Vector3& centre, double radius,
             SeenMatter& seen) {
  const Environment& environment = project.environment;
  const Period period(double3Of(environment.boundsMinimum), double3Of(environment.boundsMaximum), environment.periodic);
  const SketchGrid grid = gridOf(voxels);
  const auto rest = static_cast<float>(voxels.spacing * std::cbrt(3 / (4 * std::numbers::pi)));
  for (const VoxelShape::Run& run : voxels.runs) {
    const VoxelShape::Paint& paint = voxels.palette.at(static_cast<size_t>(run.palette));
    const uint32_t material = materialIndex(project, paint.material, shownName(project.bodies[body]));
    for (int k = 0; k < run.length; ++k) {
      const Vector3 place = imageNear(period, grid.centreOf({run.x + k, run.y, run.z}), centre);
      if (!((place - centre).squaredNorm() <= radius * radius)) continue;
      seen.position.push_back(float4Of(place, rest));
      seen.temperature.push_back(static_cast<float>(paint.temperature));
      seen.speed.push_back(0);
      seen.phase.push_back(api::Phase::Solid);
      seen.motion.push_back(api::Motion::Solid);
      seen.body.push_back(static_cast<uint32_t>(body));
      seen.material.push_back(material);
    }
  }
}

/// What brushes see while the sketch of a body is drawn again: the other bodies are made into cells when first asked.
MatterBeside matterBeside(const Project& project, const std::string& body, double spacing) {
  std::vector<std::optional<VoxelShape>> others(project.bodies.size());
  return [&project, body, spacing, others](const VoxelShape& soFar, const Vector3& centre, double radius) mutable {
    const std::vector<Body>& bodies = project.bodies;
    SeenMatter seen;
    for (size_t b = 0; b < bodies.size(); ++b) {
      std::optional<VoxelShape>& voxels = others[b];
      if (bodies[b].id != body && !voxels) voxels = std::get<VoxelShape>(asVoxels(bodies[b], spacing).shape);
      addSeen(project, voxels ? *voxels : soFar, b, centre, radius, seen);
    }
    return seen;
  };
}

}  // namespace

VoxelShape redrawnIn(const Project& project, const std::string& body, const VoxelShape& sketch, double spacing,
                     const PluginRegistry& plugins) {
  const auto freeOf = [&](const SketchGrid& grid, const CellSet& cells) {
    std::vector<api::Cell> inside;
    for (const api::Cell& cell : cells.cells()) {
      if (isInScene(project.environment, grid, cell)) inside.push_back(cell);
    }
    VoxelShape lattice = latticeOf(sketch);
    lattice.origin = grid.origin, lattice.spacing = grid.spacing;
    std::vector<api::Cell> free;
    for (const auto& [x, y, z] : freeAtStart(project, body, lattice, CellSet(inside).indices()))
      free.push_back({x, y, z});
    return CellSet(free);
  };
  const auto brushOf = [&](const std::string& id) { return plugins.brush(id); };
  const auto barrierOf = [&](const SketchGrid& grid, const api::Cell& cell) {
    return barrierIn(project.environment, grid, cell);
  };
  return redrawn(sketch, spacing, freeOf, brushOf, project.environment.gravity, matterBeside(project, body, spacing),
                 barrierOf);
}

size_t cellCount(const VoxelShape& sketch) {
  size_t cells = 0;
  for (const VoxelShape::Run& run : sketch.runs) cells += static_cast<size_t>(run.length);
  return cells;
}

size_t cellsBeyond(const VoxelShape& sketch, const VoxelShape& other) {
  CellSet cells = VoxelCanvas(sketch.runs).cells();
  cells.remove(VoxelCanvas(other.runs).cells().cells());
  return cells.cells().size();
}

}  // namespace ps
