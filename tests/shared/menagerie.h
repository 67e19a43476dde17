// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/shared/scenes.h"

// A scene small enough to run hundreds of times in which every declared parameter has something to act on.
namespace ps::scenes {

inline constexpr double kMenagerieSpacing = 0.02;  // m

/// `cells` particles along each axis, with their middle at `center`; held together by `constraint`, if any.
inline Body creature(const char* id, std::array<int, 3> cells, Vector3 center, double temperature,
                     const char* constraint = "") {
  Body body;
  body.id = body.name = id;
  body.material = "water";
  body.shape =
      BoxShape{center, {cells[0] * kMenagerieSpacing, cells[1] * kMenagerieSpacing, cells[2] * kMenagerieSpacing}};
  body.parameters.values["temperature"] = temperature;
  body.parameters.values["jitter"] = 0.1;
  if (*constraint) body.constraints.push_back({constraint, {}, {}});
  return body;
}

inline void addCreatures(Project& project) {
  const auto add = [&](Body body) -> Body& { return project.bodies.emplace_back(std::move(body)); };
  // Ice that melts on the hot floor, slides, and touches a second block.
  Body& ice = add(creature("ice", {4, 4, 4}, {-0.4, 0.04, 0}, 272, "bonds"));
  ice.velocity = {0.5, -0.2, 0};
  ice.parameters.values["heating_power"] = 50.0;
  add(creature("berg", {3, 3, 3}, {-0.32, 0.03, 0.005}, 271, "bonds")).velocity = {-0.3, -0.3, 0};
  // Water on its way to ice, and water that boils.
  Body& slush = add(creature("slush", {3, 3, 3}, {-0.4, 0.03, 0.3}, 273.15));
  slush.parameters.values["phase"] = std::string("liquid");
  slush.parameters.values["heating_power"] = -400.0;
  add(creature("pool", {5, 5, 5}, {0.1, 0.05, 0}, 330)).velocity = {0.3, 0, 0.1};
  Body& kettle = add(creature("kettle", {3, 3, 3}, {0.1, 0.03, 0.3}, 373.1));
  kettle.parameters.values["heating_power"] = 1500.0;
  add(creature("steam", {3, 3, 3}, {0.1, 0.3, 0.3}, 390));
  // Structures of every kind, on a post that is held in place and one that moves.
  Body& post = add(creature("post", {2, 6, 2}, {0.4, 0.06, -0.3}, 260));
  post.parameters.values["fixed"] = true;
  Body& paddle = add(creature("paddle", {1, 4, 4}, {0.02, 0.05, 0.02}, 300));
  paddle.parameters.values["fixed"] = true;
  paddle.parameters.values["motion_stop"] = 10.0;
  paddle.velocity = {0.2, 0, 0};
  add(creature("jelly", {4, 4, 4}, {-0.4, 0.05, -0.3}, 265, "clusters")).velocity = {0, -1, 0};
  add(creature("stone", {3, 3, 3}, {-0.1, 0.04, -0.3}, 265, "rigid")).velocity = {0.4, -1, 0};
  add(creature("flag", {6, 1, 6}, {0.48, 0.12, -0.3}, 265, "cloth")).velocity = {0, 0, 1};
  // Two sorts of matter in one piece, and a block that rests on another.
  Body strip = creature("strip", {1, 1, 1}, {0, 0, 0}, 260, "bonds");
  VoxelShape cells;
  cells.origin = {-0.1, 0.3, 0.6};
  cells.spacing = kMenagerieSpacing;
  cells.palette = {{"water", 260}, {"aluminium", 260}};
  cells.runs = {{0, 0, 0, 4, 0}, {0, 1, 0, 4, 1}};
  strip.shape = cells;
  add(strip);
  add(creature("cap", {2, 2, 2}, {-0.4, 0.1, 0}, 260, "bonds")).velocity = {0.5, 0, 0};
  // Matter that is thick, half molten, and quick to conduct.
  const auto of = [](Body body, const char* material) {
    body.material = material;
    return body;
  };
  add(of(creature("honey", {4, 3, 4}, {0.5, 0.03, 0.5}, 300), "honey")).velocity = {0.5, 0, 0};
  add(of(creature("butter", {4, 3, 4}, {-0.4, 0.03, 0.6}, 295), "butter")).velocity = {0.5, 0, 0};
  add(of(creature("bar", {4, 2, 2}, {0.1, 0.02, -0.6}, 400), "aluminium")).velocity = {1, 0, 0};
  add(creature("line", {8, 1, 1}, {0.5, 0.05, -0.3}, 265, "rope")).velocity = {0, 0, 1};
}

/// Emitter, sink, wind, radiation, and a floor that is hot.
inline Project menagerie() {
  Project project;
  project.solver.thermalModel = kThermalModel;
  project.materials.push_back(water());
  for (const char* id : {"honey", "butter", "aluminium"}) {
    SceneMaterial material;
    material.id = material.base = material.label = id;
    if (material.id == "honey") material.properties.values["viscosity"] = Response(100.0);
    project.materials.push_back(material);
  }
  project.environment = tray(0.8, 1.2);
  project.environment.walls.resize(1);  // matter sees what is around
  ParameterSet& floor = project.environment.walls[0].parameters;
  floor.values["heat"] = std::string("fixed_temperature");
  floor.values["temperature"] = 350.0;
  ParameterSet& air = project.environment.parameters;
  air.values["air_convection"] = 10.0;
  air.values["air_heat_capacity"] = 100.0;
  air.values["wind_speed"] = 3.0;
  air.values["air_drag"] = 0.5;
  air.values["radiation"] = true;
  ParameterSet& solver = project.solver.parameters;
  solver.values["particle_spacing"] = kMenagerieSpacing;
  solver.values["thermal_time_scale"] = 2000.0;
  addCreatures(project);
  Emitter tap;
  tap.id = tap.name = "tap";
  tap.material = "water";
  tap.point = {0.4, 0.5, 0.3};
  tap.parameters.values["speed"] = 3.0;
  project.emitters.push_back(tap);
  Sink drain;
  drain.id = drain.name = "drain";
  drain.minimum = {0.06, 0, -0.05};
  drain.maximum = {0.16, 0.03, 0.05};
  project.sinks.push_back(drain);
  return project;
}

}  // namespace ps::scenes
