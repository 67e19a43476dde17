// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/statestream.h"
#include "core/geometry/meshrepair.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/scene/solidform.h"
#include "core/simulation/engine.h"
#include "core/solver/solver.h"

#include <QString>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

/// Water in fixed vessels whose walls are thin, or of one side alone.
namespace vessels {

using nlohmann::json;

inline constexpr double kSpacing = 0.01, kGravity = 9.81, kPi = std::numbers::pi;
inline constexpr double kRadius = 0.08, kThin = 0.003;  ///< m, of vessels and their walls: a third of a spacing
/// Of water at 20 °C as the installed material has it, within the rounding of its tables.
inline constexpr double kWater = 998.2;

inline json sceneOf(const json& bodies) {
  json scene = json::parse(R"({
    "format": "phasesketch", "version": 1, "materials": [{"id": "water", "base": "water"}],
    "environment": {"bounds": {"minimum": [-1, -1, -1], "maximum": [1, 1, 1]}},
    "solver": {"thermal": {"model": "enthalpy"}}, "duration": 10
  })");
  scene["bodies"] = bodies;
  scene["solver"]["particle_spacing"] = kSpacing;
  scene["environment"]["gravity"] = {0, -kGravity, 0};
  return scene;
}

inline json bodyOf(const char* id, const json& solid) {
  return {{"id", id}, {"material", "water"}, {"temperature", 293.15}, {"shape", {{"solid", solid}}}};
}

inline json solidOf(const char* kind, const ps::Vector3& size, const ps::Vector3& middle,
                    const char* fill = "relaxed") {
  return {{"kind", kind},
          {"fill", fill},
          {"size_x", size[0]},
          {"size_y", size[1]},
          {"size_z", size[2]},
          {"position_x", middle[0]},
          {"position_y", middle[1]},
          {"position_z", middle[2]}};
}

inline json fixedOf(const json& solid) {
  json body = bodyOf("vessel", solid);
  body["fixed"] = true;
  return body;
}

/// A thing turned about the y axis: an outline of points at (distance from the axis, height), joined in this order.
inline ps::SceneMesh turned(const std::vector<std::pair<double, double>>& outline, bool closed) {
  constexpr uint32_t kAround = 64;
  ps::SceneMesh mesh;
  mesh.id = mesh.name = "vessel";
  for (const auto& [out, up] : outline) {
    for (uint32_t k = 0; k < kAround; ++k) {
      const double angle = 2 * kPi * k / kAround;
      mesh.points.push_back({static_cast<float>(out * std::cos(angle)), static_cast<float>(up),
                             static_cast<float>(out * std::sin(angle))});
    }
  }
  const auto rings = static_cast<uint32_t>(outline.size());
  for (uint32_t ring = 0; ring + (closed ? 0 : 1) < rings; ++ring) {
    for (uint32_t k = 0; k < kAround; ++k) {
      const uint32_t next = (k + 1) % kAround, above = (ring + 1) % rings * kAround;
      mesh.triangles.push_back({ring * kAround + k, above + k, above + next});
      mesh.triangles.push_back({ring * kAround + k, above + next, ring * kAround + next});
    }
  }
  ps::repair(mesh);
  return mesh;
}

/// Inner and outer side of half a sphere that is open above, or one side alone.
inline ps::SceneMesh bowl(bool closed) {
  std::vector<std::pair<double, double>> outline;
  constexpr int kSteps = 24;
  for (int k = 0; k <= kSteps; ++k) {
    const double angle = kPi / 2 * k / kSteps;
    outline.emplace_back(std::max(1e-9, kRadius * std::sin(angle)), -kRadius * std::cos(angle));
  }
  for (int k = kSteps; closed && k >= 0; --k) {
    const double angle = kPi / 2 * k / kSteps, outer = kRadius + kThin;
    outline.emplace_back(std::max(1e-9, outer * std::sin(angle)), -outer * std::cos(angle));
  }
  return turned(outline, closed);
}

/// Closed all round: nothing but its surface keeps what is in it.
inline ps::SceneMesh ball() {
  std::vector<std::pair<double, double>> outline;
  constexpr int kSteps = 48;
  for (int k = 0; k <= kSteps; ++k) {
    const double angle = kPi * k / kSteps;
    outline.emplace_back(std::max(1e-9, kRadius * std::sin(angle)), -kRadius * std::cos(angle));
  }
  return turned(outline, false);
}

/// A pot with a flat bottom, closed all round.
inline ps::SceneMesh cup() {
  const double outer = kRadius + kThin, high = 0.16;
  return turned({{1e-9, 0}, {kRadius, 0}, {kRadius, high}, {outer, high}, {outer, -kThin}, {1e-9, -kThin}}, true);
}

inline ps::Project load(const json& scene, const ps::PluginRegistry& plugins) {
  return ps::parseProject(scene.dump(), "scene", plugins).project;
}
inline bool isRound(const QString& vessel) { return vessel.endsWith("bowl") || vessel == "sheet" || vessel == "ball"; }
/// A vessel whose inner side has kRadius, standing on y = 0; a bowl's middle is at the origin.
inline ps::Project filled(const QString& vessel, const ps::PluginRegistry& plugins, const char* liquid = "water") {
  const bool round = isRound(vessel);
  json solid = solidOf("tube", {2 * (kRadius + kThin), 0.2, 2 * (kRadius + kThin)}, {0, 0.1, 0});
  if (vessel == "solid bowl")
    solid = solidOf("bowl", {2 * (kRadius + kThin), kRadius + kThin, 2 * (kRadius + kThin)},
                    {0, -(kRadius + kThin) / 2, 0});
  solid["wall"] = kThin;
  const json water = round ? solidOf("ellipsoid", {0.13, 0.08, 0.13}, {0, -0.02, 0})
                           : solidOf("cylinder", {2 * kRadius, 0.1, 2 * kRadius}, {0, 0.05, 0});
  json scene = sceneOf(json::array({fixedOf(solid), bodyOf("water", water)}));
  scene["materials"][0]["base"] = liquid;
  if (vessel == "tube")
    scene["environment"]["walls"] = json::array({{{"id", "floor"}, {"point", {0, 0, 0}}, {"normal", {0, 1, 0}}}});
  scene["probes"] = json::array({{{"id", "force"}, {"quantity", "force_y"}, {"body", "vessel"}}});
  ps::Project project = load(scene, plugins);
  if (vessel == "tube" || vessel == "solid bowl") return project;
  auto mesh = std::make_shared<const ps::SceneMesh>(vessel == "cup"    ? cup()
                                                    : vessel == "ball" ? ball()
                                                                       : bowl(vessel == "bowl"));
  const ps::MeshBounds bounds = ps::boundsOf(*mesh);
  const ps::Vector3 size = bounds.maximum - bounds.minimum, middle = (bounds.maximum + bounds.minimum) / 2;
  auto& shape = std::get<ps::SolidShape>(project.bodies[0].shape);
  for (size_t a = 0; a < 3; ++a) {
    shape.parameters.values[std::string("size_") + "xyz"[a]] = size[a];
    shape.parameters.values[std::string("position_") + "xyz"[a]] = middle[a];
  }
  shape.parameters.values["kind"] = std::string("mesh");
  if (vessel == "ball") shape.parameters.values["inside"] = std::string("hollow");
  shape.parameters.values.erase("wall");
  shape.meshId = mesh->id;
  shape.mesh = mesh;
  return project;
}
/// All of it at one velocity, and its vessel turning about the vertical axis too.
inline ps::Project onItsWay(ps::Project project, const ps::Vector3& velocity, double spin) {
  for (ps::Body& body : project.bodies) body.velocity = velocity;
  project.bodies[0].spin = {0, spin, 0};
  return project;
}
inline void run(ps::Engine& engine, double seconds) {
  for (int frame = 0; frame < 60 * seconds; ++frame) engine.step();
}
/// Whether it comes to the same, to the bit, when it goes on once more from its state of now.
inline bool goesOnFromItsState(ps::Engine& engine, double seconds) {
  ps::StateBuffer state;
  ps::StateWriter writer(state);
  engine.save(writer);
  writer.finish();
  run(engine, seconds);
  const uint64_t hash = engine.stateHash();
  engine.restore(ps::StateReader(state.bytes()));
  run(engine, seconds);
  return engine.stateHash() == hash;
}
/// N, upwards, on the vessel.
inline double meanForce(ps::Engine& engine, double seconds) {
  double sum = 0;
  int frames = 0;
  for (; frames < 60 * seconds; ++frames) {
    engine.step();
    sum += engine.stats().probes.at(0);
  }
  return sum / frames;
}
/// m, height of the middle of so much water in the half sphere: pi h2 (3 R - h)/3 of it.
inline double capCentre(double volume) {
  double low = 0, high = kRadius;
  for (int k = 0; k < 60; ++k) {
    const double h = (low + high) / 2;
    (kPi * h * h * (3 * kRadius - h) / 3 < volume ? low : high) = h;
  }
  const double h = low, r = kRadius, below = 3 * (2 * r - h) * (2 * r - h) / (4 * (3 * r - h));
  return -below;
}
inline double massOf(const ps::Engine& engine) {
  const ps::ParticleStore& store = engine.solver().particles();
  double sum = 0;
  for (size_t i = 0; i < store.size(); ++i) sum += store.velocity()[i].w > 0 ? double{store.mass()[i]} : 0;
  return sum;
}

}  // namespace vessels
