// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

// Scenes that tests and benchmarks share, built as the editor would build them.
namespace ps::scenes {

/// A tray of the given half width with a floor, four walls and a lid, all adiabatic, without air that cools.
inline Environment tray(double halfWidth, double height) {
  Environment environment;
  environment.parameters.values["air_convection"] = 0.0;
  environment.boundsMinimum = {-halfWidth, 0, -halfWidth};
  environment.boundsMaximum = {halfWidth, height, halfWidth};
  const auto wall = [&](const char* id, Vector3 point, Vector3 normal) {
    SceneWall w;
    w.id = w.name = id;
    w.point = point;
    w.normal = normal;
    environment.walls.push_back(w);
  };
  wall("floor", {0, 0, 0}, {0, 1, 0});
  wall("lid", {0, height, 0}, {0, -1, 0});
  wall("left", {-halfWidth, 0, 0}, {1, 0, 0});
  wall("right", {halfWidth, 0, 0}, {-1, 0, 0});
  wall("back", {0, 0, -halfWidth}, {0, 0, 1});
  wall("front", {0, 0, halfWidth}, {0, 0, -1});
  return environment;
}

inline SceneMaterial water() {
  SceneMaterial material;
  material.id = material.base = "water";
  material.label = "Water";
  return material;
}

/// A block of `side`^3 particles of water at a temperature in K; bonded when it is ice.
inline Body block(const char* id, int side, double spacing, Vector3 center, double temperature) {
  Body body;
  body.id = body.name = id;
  body.material = "water";
  body.shape = BoxShape{center, {side * spacing, side * spacing, side * spacing}};
  body.parameters.values["temperature"] = temperature;
  if (temperature < 273.15) body.constraints.push_back({"bonds", {}, {}});
  return body;
}

/// The thermal model of all these scenes.
inline constexpr const char* kThermalModel = "enthalpy";

/// A small block of ice on a floor held at `floorTemperature` in K, heat a few thousand times as fast as real.
inline Project iceOnPlate(int side, double floorTemperature, double timeScale = 6000) {
  constexpr double kSpacing = 0.03;
  Project project;
  project.title = "Ice on a plate";
  project.solver.thermalModel = kThermalModel;
  project.materials.push_back(water());
  project.environment = tray(0.75 * side * kSpacing, 1.2);
  ParameterSet& floor = project.environment.walls[0].parameters;
  floor.values["heat"] = std::string("fixed_temperature");
  floor.values["temperature"] = floorTemperature;
  project.bodies.push_back(block("ice", side, kSpacing, {0, 0.5 * side * kSpacing, 0}, 263.15));
  project.solver.parameters.values["particle_spacing"] = kSpacing;
  project.solver.parameters.values["thermal_time_scale"] = timeScale;
  Probe probe;
  probe.id = probe.name = "ice core";
  probe.quantity = "temperature";
  probe.body = "ice";
  project.probes.push_back(probe);
  return project;
}

/// A block of 120 mm, 0.6 m above the floor, by its mesh.
inline Body meshCube() {
  SceneMesh mesh;
  mesh.id = "cube";
  for (unsigned k = 0; k < 8; ++k) {
    const auto end = [k](unsigned bit) { return (k >> bit & 1U) != 0 ? 0.1F : -0.1F; };
    mesh.points.push_back({end(0), end(1), end(2)});
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  SolidShape solid;
  solid.parameters.values = {
      {"kind", std::string("mesh")},     {"size_x", 0.12}, {"size_y", 0.12}, {"size_z", 0.12}, {"position_y", 0.6},
      {"material", std::string("water")}};
  solid.meshId = mesh.id;
  solid.mesh = std::make_shared<const SceneMesh>(std::move(mesh));
  Body body;
  body.id = body.name = "cube";
  body.material = "water";
  body.shape = std::move(solid);
  return body;
}

}  // namespace ps::scenes
