// SPDX-License-Identifier: Apache-2.0
// Liquid in and on fixed bodies whose surfaces are known: thin walls, bowls, meshes, open ones too. Levels and forces
// against the volume and the weight of the water.
#include "onehash.h"

#include "core/base/statestream.h"
#include "core/geometry/meshrepair.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/scene/solidform.h"
#include "core/simulation/engine.h"
#include "core/solver/solver.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string>

using nlohmann::json;

namespace {

constexpr double kSpacing = 0.01, kGravity = 9.81, kPi = std::numbers::pi;
constexpr double kRadius = 0.08, kThin = 0.003;  ///< m, of vessels and their walls: a third of a spacing
/// Of water at 20 °C as the installed material has it, within the rounding of its tables.
constexpr double kWater = 998.2;

json sceneOf(const json& bodies) {
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

json bodyOf(const char* id, const json& solid) {
  return {{"id", id}, {"material", "water"}, {"temperature", 293.15}, {"shape", {{"solid", solid}}}};
}

json solidOf(const char* kind, const ps::Vector3& size, const ps::Vector3& middle, const char* fill = "relaxed") {
  return {{"kind", kind},
          {"fill", fill},
          {"size_x", size[0]},
          {"size_y", size[1]},
          {"size_z", size[2]},
          {"position_x", middle[0]},
          {"position_y", middle[1]},
          {"position_z", middle[2]}};
}

json fixedOf(const json& solid) {
  json body = bodyOf("vessel", solid);
  body["fixed"] = true;
  return body;
}

/// A thing turned about the y axis: an outline of points at (distance from the axis, height), joined in this order.
ps::SceneMesh turned(const std::vector<std::pair<double, double>>& outline, bool closed) {
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
ps::SceneMesh bowl(bool closed) {
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
ps::SceneMesh ball() {
  std::vector<std::pair<double, double>> outline;
  constexpr int kSteps = 48;
  for (int k = 0; k <= kSteps; ++k) {
    const double angle = kPi * k / kSteps;
    outline.emplace_back(std::max(1e-9, kRadius * std::sin(angle)), -kRadius * std::cos(angle));
  }
  return turned(outline, false);
}

/// A pot with a flat bottom, closed all round.
ps::SceneMesh cup() {
  const double outer = kRadius + kThin, high = 0.16;
  return turned({{1e-9, 0}, {kRadius, 0}, {kRadius, high}, {outer, high}, {outer, -kThin}, {1e-9, -kThin}}, true);
}

}  // namespace

class TestFixedShapes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup() {
    ps::setThreadCount(0);
    ps::setInstructionSet({});
  }

  /// Water comes to rest in a vessel whose walls are a third of a spacing thick, or none at all: none of it is
  /// outside, it stands as high as its volume asks, and what it weighs is what the vessel bears. Levels go by the
  /// middle of the water, which lies half as high as its surface in a cylinder, 5/8 of it in a full half sphere.
  void vesselsHoldWater_data() {
    QTest::addColumn<QString>("vessel");
    QTest::newRow("a tube on a floor") << "tube";
    QTest::newRow("a cup") << "cup";
    QTest::newRow("a bowl") << "bowl";
    QTest::newRow("a bowl that is no mesh") << "solid bowl";
    QTest::newRow("a bowl of one side") << "sheet";
    QTest::newRow("a hollow ball") << "ball";
  }
  void vesselsHoldWater() {
    QFETCH(QString, vessel);
    ps::Engine engine(filled(vessel), m_plugins);
    const double mass = massOf(engine);
    run(engine, 2.5);
    const bool round = isRound(vessel);
    const ps::ParticleStore& store = engine.solver().particles();
    size_t count = 0;
    ps::Vector3 centre;
    for (size_t i = 0; i < store.size(); ++i) {
      if (store.velocity()[i].w == 0) continue;
      const ps::Vector3 at = ps::vectorOf(store.position()[i]);
      const double out = round ? at.norm() : std::hypot(at[0], at[2]);
      QVERIFY2(out < kRadius && (round || at[1] > 0), qPrintable(QString("%1 %2").arg(out).arg(at[1])));
      centre += at;
      ++count;
    }
    centre /= static_cast<double>(count);
    const double volume = mass / kWater, wanted = round ? capCentre(volume) : volume / (2 * kPi * kRadius * kRadius);
    const double force = meanForce(engine, 1);
    qInfo("middle at %.5f m, should be %.5f; bears %.4f N of %.4f", centre[1], wanted, -force, mass * kGravity);
    QVERIFY(std::abs(centre[1] - wanted) < 0.2 * kSpacing);
    if (vessel != "tube") QVERIFY(std::abs(force / (mass * kGravity) + 1) < 0.02);
    QVERIFY(massOf(engine) == mass);
  }

  /// A jet at 20 m/s goes through eight spacings in a substep. A plate of a fifth of a spacing lets none of it pass.
  void jetsDoNotPass_data() {
    QTest::addColumn<double>("speed");
    QTest::addColumn<double>("turn");
    for (const double turn : {0.0, 35.0}) {
      for (const double speed : {2.0, 20.0, 100.0}) QTest::addRow("%g m/s at %g degrees", speed, turn) << speed << turn;
    }
  }
  void jetsDoNotPass() {
    QFETCH(double, speed);
    QFETCH(double, turn);
    json plate = solidOf("block", {1.6, 0.002, 1.6}, {0, 0, 0});
    plate["rotation_z"] = turn;
    json water = bodyOf("water", solidOf("cylinder", {0.06, 0.2, 0.06}, {0, 0.25, 0}));
    water["velocity"] = {0, -speed, 0};
    ps::Engine engine(load(sceneOf(json::array({fixedOf(plate), water}))), m_plugins);
    const ps::Vector3 up(-std::sin(turn * kPi / 180), std::cos(turn * kPi / 180), 0);
    double lowest = 1, highest = 0;
    std::set<uint32_t> beyond;
    for (int frame = 0; frame < (speed > 50 ? 8 : 24); ++frame) {
      engine.step();
      const ps::ParticleStore& store = engine.solver().particles();
      for (size_t i = 0; i < store.size(); ++i) {
        const ps::Vector3 at = ps::vectorOf(store.position()[i]);
        const ps::Vector3 along = at - at.dot(up) * up;
        // Whoever has come to the plate's edge may go round it.
        if (along.norm() > 0.75) beyond.insert(store.id()[i]);
        if (store.velocity()[i].w == 0 || beyond.contains(store.id()[i])) continue;
        lowest = std::min(lowest, at.dot(up));
        highest = std::max(highest, along.norm());
      }
    }
    qInfo("nearest %.5f m, spread to %.3f m", lowest, highest);
    QVERIFY(lowest > 0.001 + 0.4 * kSpacing);
    QVERIFY(highest > 0.05);  // it has met it
  }

  /// Where some of the vessel's particles are gone, there is a hole.
  void aHoleIsAHole() {
    ps::Engine engine(filled("cup"), m_plugins);
    run(engine, 0.5);
    std::vector<uint32_t> gone;
    const ps::ParticleStore& store = engine.solver().particles();
    for (size_t i = 0; i < store.size(); ++i) {
      if (store.velocity()[i].w == 0 && store.position()[i].x > 0.02) gone.push_back(store.id()[i]);
    }
    QVERIFY(!gone.empty());
    engine.extractParticles(gone);
    run(engine, 0.5);
    const auto outside = [&] {
      size_t count = 0;
      for (size_t i = 0; i < store.size(); ++i)
        count += store.velocity()[i].w > 0 && store.position()[i].y < -kSpacing ? 1 : 0;
      return count;
    };
    QVERIFY(outside() > 100);
  }

  /// A vessel that is carried to another place takes its surface along, and so does a state.
  void surfacesGoWhereBodiesGo() {
    ps::Engine engine(filled("bowl"), m_plugins);
    run(engine, 0.5);
    const ps::Vector3 way(0.1, 0.2, 0);
    for (const char* id : {"vessel", "water"}) {
      const auto& bodies = engine.project().bodies;
      ps::Body body = *std::find_if(bodies.begin(), bodies.end(), [&](const ps::Body& b) { return b.id == id; });
      auto& values = std::get<ps::SolidShape>(body.shape).parameters.values;
      for (size_t a = 0; a < 3; ++a) {
        const std::string key = std::string("position_") + "xyz"[a];
        values[key] =
            ps::numberOf(std::get<ps::SolidShape>(body.shape).parameters, ps::solidParameters(), key) + way[a];
      }
      engine.moveBody(body, {ps::Quaternion::Identity(), way});
    }
    const ps::ParticleStore& store = engine.solver().particles();
    const auto farthest = [&] {
      double out = 0;
      for (size_t i = 0; i < store.size(); ++i) {
        if (store.velocity()[i].w > 0) out = std::max(out, (ps::vectorOf(store.position()[i]) - way).norm());
      }
      return out;
    };
    run(engine, 0.5);
    QVERIFY2(farthest() < kRadius - 0.4 * kSpacing, qPrintable(QString::number(farthest())));
    ps::StateBuffer state;
    ps::StateWriter writer(state);
    engine.save(writer);
    writer.finish();
    run(engine, 0.1);
    const uint64_t hash = engine.stateHash();
    engine.restore(ps::StateReader(state.bytes()));
    run(engine, 0.1);
    QCOMPARE(engine.stateHash(), hash);
  }

  void vesselsAreTheSameEverywhere_data() { onehash::addRows(); }
  void vesselsAreTheSameEverywhere() {
    onehash::verify([this] {
      ps::Engine engine(filled("bowl"), m_plugins);
      run(engine, 0.2);
      return engine.solver().stateHash();
    });
  }

 private:
  ps::Project load(const json& scene) { return ps::parseProject(scene.dump(), "scene", m_plugins).project; }
  static bool isRound(const QString& vessel) {
    return vessel.endsWith("bowl") || vessel == "sheet" || vessel == "ball";
  }
  /// A vessel whose inner side has kRadius, standing on y = 0; a bowl's middle is at the origin.
  ps::Project filled(const QString& vessel) {
    const bool round = isRound(vessel);
    json solid = solidOf("tube", {2 * (kRadius + kThin), 0.2, 2 * (kRadius + kThin)}, {0, 0.1, 0});
    if (vessel == "solid bowl")
      solid = solidOf("bowl", {2 * (kRadius + kThin), kRadius + kThin, 2 * (kRadius + kThin)},
                      {0, -(kRadius + kThin) / 2, 0});
    solid["wall"] = kThin;
    const json water = round ? solidOf("ellipsoid", {0.13, 0.08, 0.13}, {0, -0.02, 0})
                             : solidOf("cylinder", {2 * kRadius, 0.1, 2 * kRadius}, {0, 0.05, 0});
    json scene = sceneOf(json::array({fixedOf(solid), bodyOf("water", water)}));
    if (vessel == "tube")
      scene["environment"]["walls"] = json::array({{{"id", "floor"}, {"point", {0, 0, 0}}, {"normal", {0, 1, 0}}}});
    scene["probes"] = json::array({{{"id", "force"}, {"quantity", "force_y"}, {"body", "vessel"}}});
    ps::Project project = load(scene);
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
  static void run(ps::Engine& engine, double seconds) {
    for (int frame = 0; frame < 60 * seconds; ++frame) engine.step();
  }
  /// N, upwards, on the vessel.
  static double meanForce(ps::Engine& engine, double seconds) {
    double sum = 0;
    int frames = 0;
    for (; frames < 60 * seconds; ++frames) {
      engine.step();
      sum += engine.stats().probes.at(0);
    }
    return sum / frames;
  }
  /// m, height of the middle of so much water in the half sphere: pi h2 (3 R - h)/3 of it.
  static double capCentre(double volume) {
    double low = 0, high = kRadius;
    for (int k = 0; k < 60; ++k) {
      const double h = (low + high) / 2;
      (kPi * h * h * (3 * kRadius - h) / 3 < volume ? low : high) = h;
    }
    const double h = low, r = kRadius, below = 3 * (2 * r - h) * (2 * r - h) / (4 * (3 * r - h));
    return -below;
  }
  static double massOf(const ps::Engine& engine) {
    const ps::ParticleStore& store = engine.solver().particles();
    double sum = 0;
    for (size_t i = 0; i < store.size(); ++i) sum += store.velocity()[i].w > 0 ? double{store.mass()[i]} : 0;
    return sum;
  }

  ps::PluginRegistry m_plugins;
};

QTEST_GUILESS_MAIN(TestFixedShapes)
#include "tst_fixedshapes.moc"
