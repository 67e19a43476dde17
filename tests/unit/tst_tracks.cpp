// SPDX-License-Identifier: Apache-2.0
// A scene that goes by tracks: at the exact frame, the same from any state, and never at the document's cost.
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/statestream.h"
#include "core/experiments/soak.h"
#include "core/plugin_host/registry.h"
#include "core/scene/track.h"
#include "core/simulation/commandqueue.h"
#include "core/simulation/declared.h"
#include "core/simulation/engine.h"
#include "core/simulation/enginethread.h"
#include "core/simulation/projectstate.h"
#include "core/simulation/tracks.h"
#include "core/solver/solver.h"
#include "tests/shared/scenes.h"

#include <QTest>

#include <cmath>
#include <future>

using namespace ps;

namespace {

const Address kGravity{Owner::Scene, "", "gravity"};
const Address kFloor{Owner::Wall, "floor", "temperature"};

void run(Engine& engine, int frames) {
  for (int frame = 0; frame < frames; ++frame) engine.step();
}

uint64_t hashAfter(const Project& project, PluginRegistry& plugins, int frames) {
  Engine engine(project, plugins);
  run(engine, frames);
  return engine.stateHash();
}

double numberAt(const Project& project, const Address& address) {
  return responseOf(storedValue(project, address).value()).at(293.15);
}

Track track(const std::string& parameter, std::vector<TrackKey> keys) { return {parameter, std::move(keys), {}}; }
Track track(const Address& address, std::vector<TrackKey> keys) { return track(address.text(), std::move(keys)); }

std::optional<double> trackValueAt(const Track& each, double time) {
  return trackValue(each.keys, time, keySlack(1.0 / 60));
}

/// Ice on a plate, under a tap, beside a paddle; gravity leans.
Project scene() {
  Project project = scenes::iceOnPlate(4, 370);
  project.environment.gravity = {1, -9.5, 0.5};
  project.materials[0].properties.values["viscosity"] = Response(0.5);
  Response curve;
  curve.kind = Response::Kind::Curve;
  curve.points = {{273.15, 0.56}, {323.15, 0.64}, {373.15, 0.68}};
  project.materials[0].properties.values["conductivity_liquid"] = curve;
  Emitter tap;
  tap.id = tap.name = "tap";
  tap.material = "water";
  tap.point = {0, 0.5, 0};
  tap.parameters.values["diameter"] = 0.09;
  project.emitters.push_back(tap);
  Body paddle = scenes::block("paddle", 2, 0.03, {0, 0.3, 0}, 293.15);
  paddle.parameters.values["fixed"] = true;
  paddle.parameters.values["motion_stop"] = 1e6;
  project.bodies.push_back(paddle);
  return project;
}

/// One of each kind of what may have keys, all on their way at half a second.
std::vector<Track> everything() {
  return {track(kFloor, {{0.2, 370, ToNext::Smooth}, {1, 300, ToNext::Smooth}, {2, 400}}),
          track(kGravity, {{0, 9.81, ToNext::Linear}, {0.3, 0, ToNext::Linear}, {2, 20}}),
          track("emitter/tap/speed", {{0, 1, ToNext::Linear}, {2, 3}}),
          track("emitter/tap/diameter", {{0, 0.09, ToNext::Step}, {0.5, 0.12, ToNext::Step}, {0.8, 0.06}}),
          track("material/water/viscosity", {{0, 0.5, ToNext::Smooth}, {2, 50}}),
          track("material/water/conductivity_liquid[0]", {{0, 0.56, ToNext::Linear}, {2, 2}}),
          track("material/water/conductivity_liquid[2]", {{0.1, 0.68, ToNext::Smooth}, {2, 3}}),
          track("body/paddle/velocity_x", {{0, 0, ToNext::Smooth}, {1, 0.2, ToNext::Smooth}, {2, -0.2}}),
          track("body/ice/heating_power", {{0.1, 0, ToNext::Linear}, {2, 2000}}),
          track("wall/floor/no_slip", {{0.25, 0, ToNext::Step}, {0.6, 1}}),
          track("environment/ambient_pressure", {{0.1, 101325, ToNext::Linear}, {2, 90000}}),
          track("constraint/ice/bonds/stiffness_softening", {{0.1, 1, ToNext::Linear}, {2, 20}}),
          track("solver/substeps", {{0.4, 3, ToNext::Linear}, {1, 8}})};
}

}  // namespace

class TestTracks : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup() {
    setThreadCount(0);
    setInstructionSet("");
  }

  void aKeyActsAtItsVeryFrame() {
    Project project = scene();
    project.tracks = {track(kGravity, {{0.5, 3, ToNext::Step}})};
    Engine engine(project, m_plugins);
    const double own = numberAt(project, kGravity);
    run(engine, 29);
    QCOMPARE(numberAt(engine.project(), kGravity), own);
    run(engine, 1);
    QVERIFY(std::abs(numberAt(engine.project(), kGravity) - 3) < 1e-12);
    // The frames before it know nothing of it, the next one does.
    QCOMPARE(engine.stateHash(), hashAfter(scene(), m_plugins, 30));
    run(engine, 1);
    QVERIFY(engine.stateHash() != hashAfter(scene(), m_plugins, 31));
  }

  void aConstantTrackChangesNotABit() {
    Project project = scene();
    for (const Track& each : everything()) {
      const Address address = *Address::parse(each.parameter);
      const auto stored = storedValue(project, address);
      if (!stored || std::holds_alternative<bool>(*stored)) continue;
      project.tracks.push_back(track(address, {{0, numberAt(project, address), ToNext::Smooth},
                                               {0.4, numberAt(project, address), ToNext::Linear},
                                               {1, numberAt(project, address)}}));
    }
    QVERIFY(project.tracks.size() > 4);
    Engine engine(project, m_plugins);
    const uint64_t baked = engine.bakedTables();
    run(engine, 60);
    QCOMPARE(engine.bakedTables(), baked);
    QCOMPARE(engine.stateHash(), hashAfter(scene(), m_plugins, 60));
  }

  void aKeyThatMovesLeavesTheFramesBeforeIt() {
    Project one = scene(), other = scene();
    one.tracks = other.tracks = {track(kFloor, {{0, 370, ToNext::Step}, {0.5, 300, ToNext::Linear}, {2, 500}})};
    other.tracks[0].keys[1].value = 450;
    QCOMPARE(hashAfter(one, m_plugins, 30), hashAfter(other, m_plugins, 30));
    QVERIFY(hashAfter(one, m_plugins, 40) != hashAfter(other, m_plugins, 40));
  }

  void everyKindOfParameterGoesByItsTrack() {
    Project project = scene();
    project.tracks = everything();
    Engine engine(project, m_plugins);
    run(engine, 45);
    QVERIFY(engine.limits().empty() || !engine.limits().back().what.starts_with("wall/"));
    const double time = engine.solver().time();
    for (const Track& each : project.tracks) {
      if (TrackTarget::parse(each.parameter)->point) continue;
      const Address address = *Address::parse(each.parameter);
      const std::optional<double> said = trackValueAt(each, time);
      QVERIFY(said);
      const bool whole = address.key == "substeps";
      const double now = std::visit(
          [](const auto& v) -> double {
            if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::string>)
              return -1;
            else
              return responseOf(Value(v)).at(293.15);
          },
          storedValue(engine.project(), address).value());
      QVERIFY2(std::abs(now - (whole ? std::floor(*said + 0.5) : *said)) < 1e-12 * std::max(1.0, std::abs(*said)),
               each.parameter.c_str());
    }
    // Gravity came from 0 and leans as it did.
    const Vector3 before = project.environment.gravity.normalized(),
                  now = engine.project().environment.gravity.normalized();
    QVERIFY((before - now).norm() < 1e-12);
  }

  void pointsOfACurveGoEachTheirWay() {
    Project project = scene();
    project.tracks = {track("material/water/conductivity_liquid[2]", {{0.1, 0.7, ToNext::Linear}, {1.1, 1.7}}),
                      track("material/water/conductivity_liquid[0]", {{0.2, 0.5, ToNext::Step}})};
    Engine engine(project, m_plugins);
    const auto curve = [](const Project& p) {
      return std::get<Response>(p.materials[0].properties.values.at("conductivity_liquid"));
    };
    run(engine, 9);  // the second has not begun
    QCOMPARE(curve(engine.project()).points[0].y, 0.56);
    QVERIFY(std::abs(curve(engine.project()).points[2].y - 0.75) < 1e-9);
    run(engine, 21);
    QCOMPARE(curve(engine.project()).points[0].y, 0.5);
    QCOMPARE(curve(engine.project()).points[1].y, 0.64);
    QVERIFY(std::abs(curve(engine.project()).points[2].y - 1.1) < 1e-9);
    QVERIFY(curve(engine.document()) == curve(project));
    engine.setTracks({project.tracks[1]});
    QCOMPARE(curve(engine.project()).points[2].y, 0.68);
    QCOMPARE(curve(engine.project()).points[0].y, 0.5);
    engine.setTracks({});
    QVERIFY(curve(engine.project()) == curve(project));
    // Of an installed curve too, of which the project says nothing.
    project = scenes::iceOnPlate(4, 370);
    project.materials.push_back({"co2", "", "co2", {}, {}, {}, {}, {}});
    project.tracks = {track("material/co2/density_liquid[1]", {{0, 1000}})};
    Engine installed(project, m_plugins);
    const auto& now = installed.project().materials[1].properties.values;
    QCOMPARE(std::get<Response>(now.at("density_liquid")).points[1].y, 1000.0);
    QVERIFY(!installed.document().materials[1].properties.values.contains("density_liquid"));
  }

  /// Also in the middle of a piece, and on any number of threads.
  void aStateGoesOnAsIfItHadNeverStopped() {
    Project project = scene();
    project.tracks = everything();
    Engine engine(project, m_plugins);
    uint64_t hash[4]{};
    std::shared_ptr<const ProjectState> state[4];
    for (int part = 0; part < 4; ++part) {
      run(engine, 17);
      StateBuffer buffer;
      saveTo(buffer, engine);
      hash[part] = engine.stateHash();
      state[part] = projectState(buffer.bytes(), project.bodies);
    }
    for (int part = 0; part < 3; ++part) {
      setThreadCount(1 + part);
      Project there = project;
      there.state = state[part];
      Engine again(there, m_plugins);
      QVERIFY2(again.remarks().empty(), again.remarks().empty() ? "" : again.remarks()[0].c_str());
      QCOMPARE(again.stateHash(), hash[part]);
      run(again, 17);
      QCOMPARE(again.stateHash(), hash[part + 1]);
      again.apply(ReturnToState{state[0]});
      QCOMPARE(again.stateHash(), hash[0]);
      run(again, 17);
      QCOMPARE(again.stateHash(), hash[1]);
      again.reset();
      run(again, 17);
      QCOMPARE(again.stateHash(), hash[0]);
    }
  }

  /// Lists of neighbours are made again when a state is read: they must reach as far as the track says.
  void aStateGoesOnWithTheReachOfItsTrack() {
    Project project = scene();
    project.emitters.clear();  // while matter comes, lists are made anew in each frame
    project.tracks = {track("solver/support_ratio", {{0, 2.2}})};
    Engine engine(project, m_plugins);
    run(engine, 17);
    StateBuffer buffer;
    saveTo(buffer, engine);
    Project there = project;
    there.state = projectState(buffer.bytes(), project.bodies);
    Engine again(there, m_plugins);
    QVERIFY(again.remarks().empty());
    QCOMPARE(again.stateHash(), engine.stateHash());
    run(again, 5);
    run(engine, 5);
    QCOMPARE(again.stateHash(), engine.stateHash());
  }

  void theDocumentsValueStaysAndHoldsWithoutTheTrack() {
    Project project = scene();
    project.tracks = everything();
    Engine engine(project, m_plugins);
    run(engine, 40);
    const auto same = [](const Project& a, const Project& b) {
      return a.environment.walls[0].parameters == b.environment.walls[0].parameters &&
             a.environment.gravity == b.environment.gravity && a.environment.parameters == b.environment.parameters &&
             a.solver.parameters == b.solver.parameters && a.emitters[0].parameters == b.emitters[0].parameters &&
             a.materials[0].properties == b.materials[0].properties && a.bodies[1].velocity == b.bodies[1].velocity &&
             a.bodies[0].parameters == b.bodies[0].parameters &&
             a.bodies[0].constraints[0].parameters == b.bodies[0].constraints[0].parameters;
    };
    QVERIFY(same(engine.document(), project));
    QVERIFY(!same(engine.project(), project));
    engine.apply(SetTracks{});
    QVERIFY(same(engine.project(), project));
    run(engine, 1);
    QVERIFY(same(engine.project(), project));
    // Back again, from the next frame on.
    engine.apply(SetTracks{project.tracks});
    const double now = numberAt(engine.project(), kFloor);
    QCOMPARE(now, *trackValueAt(project.tracks[0], engine.solver().time()));
  }

  void whatIsDraggedMeanwhileIsTheDocuments() {
    Project project = scene();
    project.tracks = {track(kFloor, {{0.1, 350, ToNext::Linear}, {2, 450}})};
    Engine engine(project, m_plugins);
    engine.setParameter(kFloor, 380.0);  // before the first key it acts
    QCOMPARE(numberAt(engine.project(), kFloor), 380.0);
    run(engine, 30);
    const double said = numberAt(engine.project(), kFloor);
    QVERIFY(engine.setParameter(kFloor, 500.0));
    QCOMPARE(numberAt(engine.project(), kFloor), said);
    QCOMPARE(numberAt(engine.document(), kFloor), 500.0);
    engine.setParameter(kGravity, 4.0);  // of another one, as ever
    QVERIFY(std::abs(numberAt(engine.project(), kGravity) - 4) < 1e-12);
    run(engine, 1);
    QVERIFY(numberAt(engine.project(), kFloor) > said);
    engine.setTracks({});
    QCOMPARE(numberAt(engine.project(), kFloor), 500.0);
  }

  void anEditOfTheTracksIsTheSameAsHavingThem() {
    Project with = scene(), without = scene();
    with.tracks = {track(kFloor, {{0.25, 370, ToNext::Linear}, {1, 500}})};
    Engine engine(without, m_plugins);
    run(engine, 10);
    engine.apply(SetTracks{with.tracks});
    run(engine, 20);
    QCOMPARE(engine.stateHash(), hashAfter(with, m_plugins, 30));
    Engine updated(without, m_plugins);
    run(updated, 10);
    updated.update(with);
    run(updated, 20);
    QCOMPARE(numberAt(updated.project(), kFloor), numberAt(engine.project(), kFloor));
    QCOMPARE(numberAt(updated.document(), kFloor), 370.0);
  }

  /// A solidus above the liquidus cannot be; what else is animated goes on.
  void whereAValueCannotBeTheDocumentsHolds() {
    Project project = scene();
    project.tracks = {track("material/water/solidus", {{0, 270, ToNext::Step}, {0.2, 400, ToNext::Step}, {0.4, 270}}),
                      track(kFloor, {{0, 370, ToNext::Linear}, {1, 400}})};
    Engine engine(project, m_plugins);
    run(engine, 15);
    const Address solidus{Owner::Material, "water", "solidus"};
    const double own = responseOf(valueAt(project, &m_plugins, solidus)).constant;
    QVERIFY(own > 272);
    QCOMPARE(responseOf(valueAt(engine.project(), &m_plugins, solidus)).constant, own);
    QVERIFY(numberAt(engine.project(), kFloor) > 375);
    // It hangs on nothing that came before.
    StateBuffer buffer;
    saveTo(buffer, engine);
    Project there = project;
    there.state = projectState(buffer.bytes(), project.bodies);
    Engine again(there, m_plugins);
    QCOMPARE(again.stateHash(), engine.stateHash());
    // Nor does it keep other edits away.
    Project edited = project;
    edited.bodies[1].name = "Blade";
    engine.update(edited);
    again.update(edited);
    run(again, 15);
    const std::vector<Limit> limits = engine.limits();
    const auto limit =
        std::find_if(limits.begin(), limits.end(), [](const Limit& l) { return l.what == "material/water/solidus"; });
    QVERIFY(limit != limits.end());
    QCOMPARE(limit->asked, 400.0);
    QCOMPARE(limit->delivered, own);
    QVERIFY2(!limit->why.empty(), limit->why.c_str());
    run(engine, 15);
    QCOMPARE(numberAt(engine.project(), solidus), 270.0);
    QCOMPARE(again.stateHash(), engine.stateHash());
    for (const Limit& left : engine.limits()) QVERIFY(left.what != "material/water/solidus");
  }

  void whatHasNoPlaceWaitsForIt() {
    Project project = scene();
    project.tracks = {track("body/paddle/velocity_x", {{0, 0.1}}), track("wall/nowhere/temperature", {{0, 300}}),
                      track("body/ice/velocity_x", {{0, 3}}),      track("solver/particle_spacing", {{0, 0.05}}),
                      track("heat_source/none/power", {{0, 3}}),   track("nonsense", {{0, 3}})};
    Engine engine(project, m_plugins);
    run(engine, 5);
    QCOMPARE(engine.project().bodies[0].velocity[0], 0.0);
    QCOMPARE(engine.project().bodies[1].velocity[0], 0.1);
    Project less = project;
    less.bodies.pop_back();
    engine.update(less);
    run(engine, 5);
    engine.update(project);
    QCOMPARE(engine.project().bodies[1].velocity[0], 0.1);
    QCOMPARE(engine.document().bodies[1].velocity[0], 0.0);
    run(engine, 5);
  }

  /// A stroke brings the whole body along, with the document's values.
  void whatIsSketchedLeavesTheTracksInForce() {
    Project project = scene();
    Body sketch = scenes::block("sketch", 1, 0.03, {}, 293.15);
    VoxelShape voxels;
    voxels.origin = {0, 0.7, 0};
    voxels.spacing = 0.03;
    voxels.palette.push_back({"water", 293.15});
    voxels.runs.push_back({0, 0, 0, 1, 0});
    sketch.shape = voxels;
    sketch.parameters.values["heating_power"] = 1.0;
    project.bodies.push_back(sketch);
    project.tracks = {track("body/sketch/heating_power", {{0, 50}})};
    Engine engine(project, m_plugins);
    run(engine, 2);
    std::get<VoxelShape>(sketch.shape).runs[0].length = 2;
    sketch.parameters.values["heating_power"] = 2.0;
    QCOMPARE(engine.addCells(sketch, {{1, 0, 0}}, 0).size(), size_t{1});
    const Address power{Owner::Body, "sketch", "heating_power"};
    QCOMPARE(numberAt(engine.project(), power), 50.0);
    QCOMPARE(numberAt(engine.document(), power), 2.0);
    engine.setTracks({});
    QCOMPARE(numberAt(engine.project(), power), 2.0);
  }

  void refusedEditsLeaveTheTracksInForce() {
    Project project = scene();
    project.tracks = everything();
    Engine engine(project, m_plugins);
    run(engine, 30);
    // A solidus above the liquidus.
    QVERIFY_EXCEPTION_THROWN(engine.setParameter({Owner::Material, "water", "solidus"}, 900.0), Error);
    QCOMPARE(numberAt(engine.project(), kFloor), *trackValueAt(project.tracks[0], engine.solver().time()));
    QCOMPARE(numberAt(engine.document(), kFloor), 370.0);
    run(engine, 15);
    QCOMPARE(engine.stateHash(), hashAfter(project, m_plugins, 45));
  }

  /// As the editor runs it.
  void theThreadGoesByThemToTheSameBits() {
    Project project = scene();
    project.tracks = everything();
    EngineThread thread(m_plugins, [] {});
    thread.open(project, false);
    for (int frame = 0; frame < 45; ++frame) thread.stepOnce();
    std::promise<uint64_t> hash;
    thread.ask([&](const Engine& engine) { hash.set_value(engine.stateHash()); });
    QCOMPARE(hash.get_future().get(), hashAfter(project, m_plugins, 45));
  }

  void waitingListsOfTracksAreOne() {
    CommandQueue queue;
    queue.push(Command(SetTracks{{track(kFloor, {{0, 300}})}}));
    queue.push(Command(SetTracks{{track(kFloor, {{0, 310}})}}));
    queue.push(Command(SetParameter{kGravity, 1.0}));
    queue.push(Command(SetTracks{{track(kFloor, {{0, 320}})}}));
    const auto value = [](const QueueEntry& entry) {
      return std::get<SetTracks>(std::get<Command>(entry)).tracks[0].keys[0].value;
    };
    QCOMPARE(value(*queue.pop()), 310.0);
    QVERIFY(std::holds_alternative<ParameterBatch>(*queue.pop()));
    queue.push(Command(UpdateProject{std::make_shared<const Project>()}));  // has its own
    QVERIFY(std::holds_alternative<UpdateProject>(std::get<Command>(*queue.pop())));
    QVERIFY(queue.empty());
  }

  void itIsSaidWhatCanHaveNoKeys() {
    const Project project = scene();
    const auto why = [&](const char* address) {
      return QString::fromStdString(whyNoKeys(project, &m_plugins, *TrackTarget::parse(address)));
    };
    for (const Track& each : everything()) QCOMPARE(why(each.parameter.c_str()), QString());
    QVERIFY(why("wall/nowhere/temperature").contains("has no parameter"));
    QVERIFY(why("wall/floor/nonsense").contains("has no parameter"));
    QVERIFY(why("wall/floor/heat").contains("is a choice"));
    QVERIFY(why("solver/particle_spacing").contains("acts at the start"));
    QVERIFY(why("body/ice/velocity_x").contains("not held in place"));
    QVERIFY(why("scene/thermal_model").contains("choice"));
    QVERIFY(why("material/water/conductivity_liquid").contains("is a curve"));
    QVERIFY(why("material/water/conductivity_liquid[2]").isEmpty());
    QVERIFY(why("material/water/conductivity_liquid[3]").contains("has no point 3; it has 3"));
    QVERIFY(why("material/water/viscosity[0]").contains("is no curve"));
    for (const char* text : {"material/water/viscosity[]", "material/water/viscosity[1x]",
                             "material/water/viscosity[-1]", "]", "scene/gravity[99999999999999999999]"})
      QVERIFY2(!TrackTarget::parse(text), text);
  }

 private:
  PluginRegistry m_plugins;
};

QTEST_GUILESS_MAIN(TestTracks)
#include "tst_tracks.moc"
