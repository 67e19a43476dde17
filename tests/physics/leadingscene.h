// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/pose.h"
#include "core/simulation/engine.h"
#include "core/solver/solver.h"
#include "tests/shared/scenes.h"

#include <QTest>

#include <algorithm>
#include <map>
#include <memory>

/// Small scenes in which a hand leads a tool.
namespace leading {

using namespace ps;

inline constexpr double kSpacing = 0.02, kDt = 1.0 / 60;
/// m, rounding of places of about 1 m in single precision.
inline constexpr double kSingle = 3e-7;

inline Body solid(const char* id, const char* kind, const Vector3& size, const Vector3& place, double temperature) {
  Body body;
  body.id = body.name = id;
  body.material = "water";
  body.parameters.values["temperature"] = temperature;
  SolidShape shape;
  shape.parameters.values["kind"] = std::string(kind);
  for (int a = 0; a < 3; ++a) {
    shape.parameters.values[std::string("size_") + "xyz"[a]] = size[a];
    shape.parameters.values[std::string("position_") + "xyz"[a]] = place[a];
  }
  body.shape = shape;
  return body;
}

/// An upright plate, or one that lies, in place of a tool.
inline Body tool(const Vector3& size, const Vector3& place, double temperature = 260) {
  Body body = solid("tool", "block", size, place, temperature);
  body.parameters.values["fixed"] = true;
  return body;
}

inline Project scene(double halfWidth, double height) {
  Project project;
  project.materials.push_back(scenes::water());
  project.environment = scenes::tray(halfWidth, height);
  project.solver.thermalModel = scenes::kThermalModel;
  project.solver.parameters.values["particle_spacing"] = kSpacing;
  return project;
}

/// A hand leads a tool on from where the document has it by now.
inline void lead(Engine& engine, const RigidMove& move, const std::string& id = "tool") {
  const auto& bodies = engine.project().bodies;
  const auto body = std::find_if(bodies.begin(), bodies.end(), [&](const Body& one) { return one.id == id; });
  engine.apply(MoveBody{std::make_shared<const Body>(moved(*body, move)), move, true});
}
inline void lead(Engine& engine, const Vector3& way) { lead(engine, RigidMove{Quaternion::Identity(), way}); }

struct Seen {
  std::map<uint32_t, Vector3> places;
  double fastest = 0;
  Vector3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
};
inline Seen seen(const Engine& engine, const std::string& body) {
  const ParticleStore& store = engine.particles();
  Seen all;
  for (size_t i = 0; i < store.size(); ++i) {
    if (engine.bodyIds()[store.body()[i]] != body) continue;
    const Vector3 place = vectorOf(store.position()[i]);
    all.places[store.id()[i]] = place;
    all.fastest = std::max(all.fastest, vectorOf(store.velocity()[i]).norm());
    all.low = all.low.cwiseMin(place), all.high = all.high.cwiseMax(place);
  }
  return all;
}

inline double farthest(const Seen& some, const Seen& others) {
  double most = some.places.size() == others.places.size() ? 0 : 1e9;
  for (const auto& [id, place] : some.places) most = std::max(most, (others.places.at(id) - place).norm());
  return most;
}

inline void play(Engine& engine, int frames) {
  for (int frame = 0; frame < frames; ++frame) {
    const StepReport report = engine.step();
    QVERIFY2(report.flags == 0 && report.faults.empty(), report.message.c_str());
  }
}

}  // namespace leading
