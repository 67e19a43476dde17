// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/benchscenes.h"

#include <algorithm>
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

void hold(Body& body, const std::string& plugin, std::initializer_list<std::pair<const char*, double>> values = {}) {
  BodyConstraint constraint;
  constraint.plugin = plugin;
  setNumbers(constraint.parameters, values);
  body.constraints.push_back(std::move(constraint));
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

Project jelly(long particles) {
  constexpr double kSpacing = 0.01;
  const int edge = std::max(2, static_cast<int>(std::lround(std::cbrt(static_cast<double>(particles)))));
  Project project;
  project.title = "jelly";
  project.materials.push_back(materialOf("jelly"));
  Body cube =
      blockOf("jelly", {-0.5 * edge * kSpacing, 2 * kSpacing, -0.5 * edge * kSpacing}, {edge, edge, edge}, kSpacing);
  hold(cube, "clusters");
  project.bodies.push_back(cube);
  addTray(project, edge * kSpacing, edge * kSpacing, 2 * edge * kSpacing);
  setNumbers(project.solver.parameters, {{"particle_spacing", kSpacing}, {"substeps", 8}, {"iterations", 4}});
  return project;
}

/// A sheet that is held along an edge and swings down.
Project cloth(long particles) {
  constexpr double kSpacing = 0.02;
  const int edge = std::max(2, static_cast<int>(std::lround(std::sqrt(static_cast<double>(particles)))));
  const double half = 0.5 * edge * kSpacing;
  Project project;
  project.title = "cloth";
  project.materials.push_back(materialOf("cotton"));
  Body sheet = blockOf("cotton", {-half, 2 * half, -half}, {edge, 1, edge}, kSpacing);
  hold(sheet, "cloth");
  Region held;
  held.minimum = {-half, 2 * half, -half};
  held.maximum = {-half + kSpacing, 2 * half + kSpacing, half};
  sheet.pins.push_back(held);
  project.bodies.push_back(sheet);
  addTray(project, 3 * half, 3 * half, 4 * half);
  setNumbers(project.solver.parameters, {{"particle_spacing", kSpacing}, {"substeps", 8}, {"iterations", 2}});
  return project;
}

/// A bar of 49,795 distance constraints, the nearest neighbours of a lattice of 61 x 26 x 11, held at one end.
Project bar(std::optional<long> particles) {
  constexpr double kSpacing = 0.02;
  constexpr Counts kWhole{61, 26, 11};
  const double scale = particles ? std::cbrt(static_cast<double>(*particles) / (kWhole.x * kWhole.y * kWhole.z)) : 1;
  const auto scaled = [&](int count) { return std::max(2, static_cast<int>(std::lround(scale * count))); };
  const Counts counts{scaled(kWhole.x), scaled(kWhole.y), scaled(kWhole.z)};
  Project project;
  project.title = "bar";
  project.materials.push_back(materialOf("rubber"));
  Body body = blockOf("rubber", {0, 0, 0}, counts, kSpacing);
  hold(body, "bonds");
  body.constraints.back().parameters.values["neighbours"] = std::string("six");
  Region held;
  held.maximum = {kSpacing, counts.y * kSpacing, counts.z * kSpacing};
  body.pins.push_back(held);
  project.bodies.push_back(body);
  const double reach = 2 * counts.x * kSpacing;
  project.environment.boundsMinimum = {-reach, -reach, -reach};
  project.environment.boundsMaximum = {reach, reach, reach};
  setNumbers(project.solver.parameters, {{"particle_spacing", kSpacing}, {"substeps", 4}, {"iterations", 8}});
  return project;
}

/// Ice on a hot floor below water under a cold lid: both changes of phase at once.
Project meltFreeze(long particles) {
  constexpr double kSpacing = 0.02;
  const int layers = std::max(2, static_cast<int>(std::lround(std::cbrt(static_cast<double>(particles) / 64) * 2))),
            edge = std::max(2, static_cast<int>(std::lround(std::sqrt(static_cast<double>(particles) / (2 * layers)))));
  const double half = 0.5 * edge * kSpacing, height = layers * kSpacing;
  Project project;
  project.title = "melting and freezing";
  project.materials.push_back(materialOf("water"));
  Body ice = blockOf("water", {-half, 0, -half}, {edge, layers, edge}, kSpacing), water = ice;
  ice.id = ice.name = "ice";
  setNumbers(ice.parameters, {{"temperature", 263.15}});
  hold(ice, "bonds");
  std::get<BoxShape>(water.shape).center += Vector3{0, height, 0};
  setNumbers(water.parameters, {{"temperature", 275.15}});
  project.bodies = {ice, water};
  addTray(project, half, half, 2 * height);
  addWall(project, "lid", {0, 2 * height + kSpacing, 0}, {0, -1, 0});
  for (SceneWall& wall : project.environment.walls) {
    const bool hot = wall.id == "floor", cold = wall.id == "lid";
    wall.parameters.values["heat"] = std::string(hot || cold ? "fixed_temperature" : "adiabatic");
    if (hot || cold) wall.parameters.values["temperature"] = hot ? 350.0 : 230.0;
  }
  project.solver.thermalModel = "enthalpy";
  setNumbers(project.solver.parameters, {{"particle_spacing", kSpacing}, {"thermal_time_scale", 2000}});
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

std::vector<std::string> benchSceneNames() {
  return {"tank",      "dambreak-20k", "dambreak-100k", "dambreak-1m",
          "jelly-20k", "cloth-20k",    "bar-49795",     "melt-freeze-100k"};
}

std::optional<Project> benchProject(const std::string& name, std::optional<long> particles) {
  const auto count = [&](long usual) { return static_cast<int>(particles.value_or(usual)); };
  if (name == "tank") return tank(count(20000));
  if (name.starts_with("dambreak-") && particles) return damBreak(count(0));
  if (name == "dambreak-20k") return damBreakOf({25, 32, 25}, 4);
  if (name == "dambreak-100k") return damBreakOf({43, 54, 43}, 6);
  if (name == "dambreak-1m") return damBreak(1'000'000);
  if (name == "jelly-20k") return jelly(count(20000));
  if (name == "cloth-20k") return cloth(count(20000));
  if (name == "bar-49795") return bar(particles);
  if (name == "melt-freeze-100k") return meltFreeze(count(100000));
  return std::nullopt;
}

void scaleTo(Project& project, long particles, size_t present) {
  if (present == 0) return;
  Value& spacing = project.solver.parameters.values["particle_spacing"];
  spacing = numberOf(project.solver.parameters, solverParameters(), "particle_spacing") *
            std::cbrt(static_cast<double>(present) / static_cast<double>(particles));
}

}  // namespace ps
