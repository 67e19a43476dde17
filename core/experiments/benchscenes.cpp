// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/benchscenes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ps {
namespace {

/// Particles along x, y and z.
struct Counts {
  int x, y, z;
};

SceneMaterial materialOf(const std::string& id) {
  SceneMaterial material;
  material.id = material.base = id;
  return material;
}

/// A block of particles whose lowest corner cell begins at `low`, in m.
Body blockOf(const std::string& material, const Vector3& low, const Counts& counts, double spacing) {
  Body body;
  body.id = body.name = body.material = material;
  const Vector3 size{counts.x * spacing, counts.y * spacing, counts.z * spacing};
  body.shape = BoxShape{low + 0.5 * size, size, {}};
  return body;
}

void addWall(Project& project, const std::string& id, const Vector3& point, const Vector3& normal) {
  SceneWall wall;
  wall.id = wall.name = id;
  wall.point = point;
  wall.normal = normal;
  project.environment.walls.push_back(wall);
}

/// Floor and four sides of a box that begins at y = 0, with bounds a metre around it.
void addTray(Project& project, double halfWidth, double halfDepth, double height) {
  addWall(project, "floor", {0, 0, 0}, {0, 1, 0});
  addWall(project, "left", {-halfWidth, 0, 0}, {1, 0, 0});
  addWall(project, "right", {halfWidth, 0, 0}, {-1, 0, 0});
  addWall(project, "back", {0, 0, -halfDepth}, {0, 0, 1});
  addWall(project, "front", {0, 0, halfDepth}, {0, 0, -1});
  project.environment.boundsMinimum = {-halfWidth - 1, -1, -halfDepth - 1};
  project.environment.boundsMaximum = {halfWidth + 1, height + 1, halfDepth + 1};
}

void setNumbers(ParameterSet& set, std::initializer_list<std::pair<const char*, double>> values) {
  for (const auto& [key, value] : values) set.values[key] = value;
}

/// `height`: of the box, m. It is ten times as long as the block, and as deep.
Project damBreakOf(const Counts& block, double height) {
  constexpr double kSpacing = 0.05, kLengths = 10;
  Project project;
  project.title = "dam break";
  project.materials.push_back(materialOf("water"));
  // Where others line a box with layers of particles on its faces, walls stand half a spacing before these.
  const double halfWidth = 0.5 * (kLengths * 0.5 * (block.x + 1) - 1) * kSpacing, halfDepth = 0.5 * block.z * kSpacing;
  addTray(project, halfWidth, halfDepth, height);
  addWall(project, "lid", {0, height - kSpacing, 0}, {0, -1, 0});
  project.bodies.push_back(blockOf("water", {-halfWidth, 0, -halfDepth}, block, kSpacing));
  setNumbers(
      project.solver.parameters,
      {{"particle_spacing", kSpacing}, {"dt", 0.0025}, {"substeps", 1}, {"iterations", 8}, {"chebyshev_radius", 0.9}});
  return project;
}

}  // namespace

Project tank(int particles) {
  constexpr double kSpacing = 0.02;
  const double edge = std::cbrt(particles / 4.0);  // n = 2e x e x 2e
  const int layers = std::max(2, static_cast<int>(std::lround(edge))),
            across = std::max(2, static_cast<int>(std::lround(2 * edge)));
  const double half = 0.5 * across * kSpacing;
  Project project;
  project.title = "tank";
  project.materials.push_back(materialOf("water"));
  project.bodies.push_back(blockOf("water", {-half, 0, -half}, {across, layers, across}, kSpacing));
  addTray(project, half, half, layers * kSpacing);
  project.solver.parameters.values["particle_spacing"] = kSpacing;
  return project;
}

Project damBreak(int particles) {
  constexpr double kSlender = 1.25, kSpacing = 0.05;  // height by width of the block
  const double width = std::cbrt(particles / kSlender);
  const int across = std::max(2, static_cast<int>(std::lround(width))),
            high = std::max(2, static_cast<int>(std::lround(kSlender * width)));
  return damBreakOf({across, high, across}, 2.25 * high * kSpacing);
}

std::vector<std::string> benchSceneNames() { return {"tank", "dambreak-20k", "dambreak-100k", "dambreak-1m"}; }

std::optional<Project> benchProject(const std::string& name, std::optional<long> particles) {
  const auto count = [&](long usual) { return static_cast<int>(particles.value_or(usual)); };
  if (name == "tank") return tank(count(20000));
  if (name.starts_with("dambreak-") && particles) return damBreak(count(0));
  if (name == "dambreak-20k") return damBreakOf({25, 32, 25}, 4);
  if (name == "dambreak-100k") return damBreakOf({43, 54, 43}, 6);
  if (name == "dambreak-1m") return damBreak(1'000'000);
  return std::nullopt;
}

void scaleTo(Project& project, long particles, size_t present) {
  if (present == 0) return;
  Value& spacing = project.solver.parameters.values["particle_spacing"];
  const double before = numberOf(project.solver.parameters, solverParameters(), "particle_spacing");
  // Sheets and rows stay one particle thick, so that their number goes by fewer powers of the spacing.
  std::array<double, 4> byPower{0, 0, 0, static_cast<double>(present)};
  std::vector<double*> thin;  // edges, m
  for (Body& body : project.bodies) {
    auto* box = std::get_if<BoxShape>(&body.shape);
    if (!box) continue;
    size_t power = 3;
    for (double& edge : box->size) {
      if (layersAlong(edge, before) > 1) continue;
      thin.push_back(&edge);
      --power;
    }
    byPower[power] += particleCount(body, before);
    byPower[3] -= particleCount(body, before);
  }
  const auto countAt = [&](double ratio) {
    return byPower[0] + (byPower[1] + (byPower[2] + byPower[3] / ratio) / ratio) / ratio;
  };
  double low = 1e-3, high = 1e3;  // new spacing by old
  for (int step = 0; step < 60; ++step) {
    const double middle = std::sqrt(low * high);
    (countAt(middle) > static_cast<double>(particles) ? low : high) = middle;
  }
  spacing = low * before;
  for (double* edge : thin) *edge = low * before;
}

}  // namespace ps
