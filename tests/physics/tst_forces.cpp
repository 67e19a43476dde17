// SPDX-License-Identifier: Apache-2.0
// Forces, torques and pressures that probes read, against what statics, Stevin, Archimedes and Couette say.
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/solver/solver.h"

#include <QTest>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

using nlohmann::json;

namespace {

constexpr double kSpacing = 0.02, kGravity = 9.81;

json wall(const char* id, const json& point, const json& normal) {
  return {{"id", id}, {"name", id}, {"point", point}, {"normal", normal}};
}

/// A box open at the top, from -w/2 to w/2, of matter that keeps its heat.
json tank(double width) {
  const double w = 0.5 * width;
  json scene = {{"format", "phasesketch"}, {"version", 1}, {"bodies", json::array()}, {"probes", json::array()}};
  scene["materials"] = {{{"id", "water"}, {"base", "water"}}};
  scene["environment"] = {
      {"bounds", {{"minimum", {-1, -1, -1}}, {"maximum", {1, 3, 1}}}},
      {"air_convection", 0},
      {"walls",
       {wall("floor", {0, 0, 0}, {0, 1, 0}), wall("left", {-w, 0, 0}, {1, 0, 0}), wall("right", {w, 0, 0}, {-1, 0, 0}),
        wall("back", {0, 0, -w}, {0, 0, 1}), wall("front", {0, 0, w}, {0, 0, -1})}}};
  scene["solver"] = {{"particle_spacing", kSpacing}, {"thermal", {{"model", "enthalpy"}}}};
  return scene;
}

/// Water, or ice that a plugin holds together.
json block(const char* id, const json& center, const json& size, const char* plugin = nullptr) {
  json body = {{"id", id}, {"material", "water"}, {"shape", {{"box", {{"center", center}, {"size", size}}}}}};
  body["temperature"] = plugin ? 263.15 : 293.15;
  if (plugin) body["constraints"] = {{{"plugin", plugin}}};
  return body;
}

/// `of` is "body" or "wall".
json probe(const char* of, const std::string& id, const std::string& quantity) {
  return {{"id", id + "-" + quantity}, {"name", id}, {"quantity", quantity}, {of, id}};
}

void push(json& scene, const char* list, json item) { scene[list].push_back(std::move(item)); }

}  // namespace

class TestForces : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aBlockWeighsOnWhatItStandsOn_data();
  void aBlockWeighsOnWhatItStandsOn();
  void whatFallsFeelsNoForce();
  void whatHangsOnItselfIsNotPulled();
  void liquidPressesOnFloorAndSides();
  void pressureGrowsWithDepth();
  void whatIsUnderWaterIsLifted();
  void aPlateIsDraggedByTheLiquid();
  void watchingChangesNoBit();

 private:
  ps::Engine engine(const json& scene) {
    return ps::Engine(ps::parseProject(scene.dump(), "scene", m_plugins).project, m_plugins);
  }
  /// Means of all probes over the frames from one time to another, s; by title.
  std::map<std::string, double> means(const json& scene, double from, double to) {
    ps::Engine running = engine(scene);
    std::map<std::string, double> sums;
    int count = 0;
    while (running.stats().time < to - 1e-9) {
      const ps::StepReport report = running.step();
      if (report.flags != 0) qWarning("%s", report.message.c_str());
      const ps::FrameStats stats = running.stats();
      if (stats.time < from) continue;
      ++count;
      for (size_t k = 0; k < stats.probes.size(); ++k) sums[running.probeNames()[k]] += stats.probes[k];
    }
    for (auto& [name, sum] : sums) {
      sum /= count;
      qInfo("%s: %g", name.c_str(), sum);
    }
    return sums;
  }
  ps::PluginRegistry m_plugins;
};

#define VERIFY_NEAR(value, expected, relative)                              \
  QVERIFY2(std::abs((value) - (expected)) <= (relative)*std::abs(expected), \
           qPrintable(QString("%1, not %2").arg(value).arg(expected)))

void TestForces::aBlockWeighsOnWhatItStandsOn_data() {
  QTest::addColumn<QString>("plugin");
  QTest::addColumn<bool>("onFixed");
  QTest::newRow("rigid, on a wall") << "rigid" << false;
  QTest::newRow("bonded, on a wall") << "bonds" << false;
  QTest::newRow("rigid, on a fixed plate") << "rigid" << true;
  QTest::newRow("bonded, on a fixed plate") << "bonds" << true;
}

/// Off the middle, so that its weight has a moment about the origin.
void TestForces::aBlockWeighsOnWhatItStandsOn() {
  QFETCH(QString, plugin);
  QFETCH(bool, onFixed);
  json scene = tank(0.6);
  const char *of = onFixed ? "body" : "wall", *below = onFixed ? "plate" : "floor";
  const double bottom = onFixed ? 0.04 : 0, x = 0.1;
  if (onFixed) {
    json plate = block("plate", {0, 0.02, 0}, {0.4, 0.04, 0.2}, "bonds");
    plate["fixed"] = true;
    push(scene, "bodies", plate);
  }
  push(scene, "bodies", block("block", {x, bottom + 0.04, 0}, {0.08, 0.08, 0.08}, qPrintable(plugin)));
  for (const char* quantity : {"force_x", "force_y", "torque_z"}) push(scene, "probes", probe(of, below, quantity));
  for (const char* quantity : {"mass", "force_y", "position_x"})
    push(scene, "probes", probe("body", "block", quantity));
  const std::map<std::string, double> read = means(scene, 2, 4);
  const std::string name = below;
  const double weight = read.at("block.mass[kg]") * kGravity;
  VERIFY_NEAR(read.at(name + ".force_y[N]"), -weight, 0.005);  // momentum of a rest that rocks, over a second
  VERIFY_NEAR(read.at("block.force_y[N]"), weight, 0.005);
  // Where it has come to lie: spheres find the dimples between others.
  VERIFY_NEAR(read.at(name + ".torque_z[N·m]"), -weight * read.at("block.position_x[m]"), 0.02);
  QVERIFY(std::abs(read.at(name + ".force_x[N]")) < 0.005 * weight);
}

void TestForces::whatFallsFeelsNoForce() {
  json scene = tank(0.6);
  json stone = block("stone", {0, 2, 0}, {0.08, 0.08, 0.08}, "rigid");
  stone["spin"] = {1, 2, 3};
  push(scene, "bodies", stone);
  for (const char* quantity : {"force_x", "force_y", "force_z", "torque_x"})
    push(scene, "probes", probe("body", "stone", quantity));
  const double weight = std::pow(0.08, 3) * 917 * kGravity;
  for (const auto& [name, value] : means(scene, 0, 0.3))  // rounding of a float's velocity over a frame
    QVERIFY2(std::abs(value) < 1e-4 * weight, name.c_str());
}

/// The pins of a beam carry it, which is nothing that others do to it.
void TestForces::whatHangsOnItselfIsNotPulled() {
  json scene = tank(0.6);
  json beam = block("beam", {0, 0.5, 0}, {0.2, 0.04, 0.04}, "bonds");
  beam["pins"] = {{{"minimum", {-1, 0, -1}}, {"maximum", {-0.08, 1, 1}}}};
  push(scene, "bodies", beam);
  for (const char* quantity : {"force_y", "mass"}) push(scene, "probes", probe("body", "beam", quantity));
  const std::map<std::string, double> read = means(scene, 0.2, 1.2);
  QVERIFY(std::abs(read.at("beam.force_y[N]")) < 0.005 * read.at("beam.mass[kg]") * kGravity);
}

/// The mean pressure on a side is half of that at the bottom.
void TestForces::liquidPressesOnFloorAndSides() {
  const double width = 0.2;
  json scene = tank(width);
  push(scene, "bodies", block("liquid", {0, 0.1, 0}, {width, 0.2, width}));
  push(scene, "probes", probe("wall", "floor", "force_y"));
  push(scene, "probes", probe("wall", "left", "force_x"));
  push(scene, "probes", probe("wall", "right", "force_x"));
  push(scene, "probes", probe("wall", "right", "torque_z"));
  push(scene, "probes", probe("body", "liquid", "mass"));
  push(scene, "probes", probe("body", "liquid", "force_y"));
  const std::map<std::string, double> read = means(scene, 3, 4);
  const double weight = read.at("liquid.mass[kg]") * kGravity, depth = 0.2;
  const double side = 0.5 * weight * depth / width;
  VERIFY_NEAR(read.at("floor.force_y[N]"), -weight, 0.005);
  VERIFY_NEAR(read.at("liquid.force_y[N]"), weight, 0.005);
  VERIFY_NEAR(read.at("right.force_x[N]"), side, 0.08);
  VERIFY_NEAR(read.at("left.force_x[N]"), -side, 0.08);
  VERIFY_NEAR(read.at("right.torque_z[N·m]"), -side * depth / 3, 0.12);
}

void TestForces::pressureGrowsWithDepth() {
  const double width = 0.2;
  json scene = tank(width);
  push(scene, "bodies", block("liquid", {0, 0.2, 0}, {width, 0.4, width}));
  const double places[] = {0.05, 0.15, 0.25, 0.35};
  for (const double y : places) {
    json layer = {
        {"id", std::string("y").append(std::to_string(y))}, {"name", std::to_string(y)}, {"quantity", "pressure"}};
    layer["region"] = {{"minimum", {-1, y - 0.03, -1}}, {"maximum", {1, y + 0.03, 1}}};
    layer["region_when"] = "now";
    push(scene, "probes", layer);
  }
  const std::map<std::string, double> read = means(scene, 3, 4);
  const double density = 998.2, bottom = density * kGravity * 0.4;
  for (const double y : places) {
    const double expected = density * kGravity * (0.4 - y), got = read.at(std::to_string(y) + ".pressure[Pa]");
    QVERIFY2(std::abs(got - expected) < 0.05 * bottom, qPrintable(QString("%1, not %2").arg(got).arg(expected)));
  }
}

/// Archimedes; and what lifts it presses on the floor.
void TestForces::whatIsUnderWaterIsLifted() {
  json scene = tank(0.24);
  json stone = block("stone", {0, 0.12, 0}, {0.08, 0.08, 0.08}, "bonds");
  stone["fixed"] = true;
  push(scene, "bodies", stone);
  push(scene, "bodies", block("liquid", {0, 0.14, 0}, {0.24, 0.28, 0.24}));
  push(scene, "probes", probe("body", "stone", "force_y"));
  push(scene, "probes", probe("wall", "floor", "force_y"));
  push(scene, "probes", probe("body", "liquid", "mass"));
  const std::map<std::string, double> read = means(scene, 3, 4);
  const double lift = 998.2 * kGravity * std::pow(0.08, 3), got = read.at("stone.force_y[N]");
  VERIFY_NEAR(got, lift, 0.15);
  VERIFY_NEAR(read.at("floor.force_y[N]"), -got - read.at("liquid.mass[kg]") * kGravity, 0.005);
}

/// Couette: 10 Pa·s between a wall and a plate of fixed particles that moves at 0.1 m/s.
void TestForces::aPlateIsDraggedByTheLiquid() {
  // A gap of a tenth of a spacing: layers that are squeezed cannot slide over each other.
  const double side = 0.16, depth = 0.2, gap = 0.002, viscosity = 10, speed = 0.1;
  json scene = tank(1);
  scene["materials"].push_back({{"id", "syrup"}, {"base", "honey"}, {"properties", {{"viscosity", viscosity}}}});
  scene["environment"]["walls"] = {wall("floor", {0, 0, 0}, {0, 1, 0})};
  scene["environment"]["gravity"] = {0, 0, 0};
  scene["environment"]["bounds"] = {{"minimum", {0, -1, 0}}, {"maximum", {side, 1, side}}};
  scene["environment"]["periodic"] = {true, false, true};
  json liquid = block("liquid", {0.5 * side, 0.5 * depth, 0.5 * side}, {side, depth, side});
  liquid["material"] = "syrup";
  json plate = block("plate", {0.5 * side, depth + gap + 0.03, 0.5 * side}, {side, 0.06, side}, "bonds");
  plate["fixed"] = true;
  plate["velocity"] = {speed, 0, 0};
  push(scene, "bodies", liquid);
  push(scene, "bodies", plate);
  push(scene, "probes", probe("body", "plate", "force_x"));
  push(scene, "probes", probe("wall", "floor", "force_x"));
  const std::map<std::string, double> read = means(scene, 4, 5);
  const double drag = viscosity * speed / (depth + gap + 0.5 * kSpacing) * side * side;
  VERIFY_NEAR(read.at("plate.force_x[N]"), -drag, 0.1);
  VERIFY_NEAR(read.at("floor.force_x[N]"), drag, 0.1);
}

void TestForces::watchingChangesNoBit() {
  json scene = tank(0.2);
  push(scene, "bodies", block("liquid", {0, 0.1, 0}, {0.2, 0.2, 0.2}));
  push(scene, "bodies", block("ice", {0, 0.3, 0}, {0.08, 0.08, 0.08}, "rigid"));
  uint64_t hashes[2];
  for (uint64_t& hash : hashes) {
    ps::Engine running = engine(scene);
    for (int frame = 0; frame < 30; ++frame) running.step();
    hash = running.stateHash();
    push(scene, "probes", probe("wall", "floor", "force_y"));
    push(scene, "probes", probe("body", "ice", "torque_x"));
  }
  QCOMPARE(hashes[0], hashes[1]);
}

QTEST_GUILESS_MAIN(TestForces)
#include "tst_forces.moc"
