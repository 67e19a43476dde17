// SPDX-License-Identifier: Apache-2.0
// Graphs of a project: which suit its probes, what their curves are of, and probes that come while a scene runs.
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "core/simulation/engine.h"
#include "core/simulation/enginethread.h"
#include "core/simulation/graphsource.h"
#include "core/simulation/parametercourse.h"
#include "core/simulation/probeparameters.h"
#include "core/simulation/rules.h"
#include "tests/shared/scenes.h"

#include <QTest>

#include <cmath>

using namespace ps;

namespace {

Probe probeOf(const std::string& id, const std::string& quantity, const std::string& body = {}) {
  Probe probe;
  probe.id = probe.name = id;
  probe.quantity = quantity;
  probe.body = body;
  return probe;
}

std::string chosen(const Project& project) {
  std::string all;
  for (const Graph& graph : graphsFor(project, ParticleFields())) {
    all += graphKindNames()[static_cast<size_t>(graph.kind)];
    for (const std::string& series : graph.series) all += " " + series;
    all += "\n";
  }
  return all;
}

}  // namespace

class TestGraphSource : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    PluginRegistry::Options options;
    options.userDirectory = options.environment = false;
    m_plugins = std::make_unique<PluginRegistry>(options);
  }

  void graphsSuitTheProbes() {
    Project project = scenes::iceOnPlate(3, 370);
    project.probes.clear();
    QCOMPARE(chosen(project), std::string("time frame/temperature\nphases\n"));
    project.probes = {probeOf("splash", "height_max"), probeOf("fast", "speed_max"), probeOf("level", "height")};
    QCOMPARE(chosen(project), std::string("time probe/splash probe/level\ntime probe/fast\n"));
    project.probes.push_back(probeOf("core", "temperature_min"));
    project.probes.push_back(probeOf("mean", "temperature"));  // the first curve is of it already
    project.probes.push_back(probeOf("ice", "solid_mass"));    // the stack shows it
    QCOMPARE(chosen(project),
             std::string("time frame/temperature probe/core\nphases\ntime probe/splash probe/level\n"));
    project.graphs.emplace();
    QCOMPARE(chosen(project), std::string());
  }

  void sourcesReadFrames() {
    Project project;
    project.probes = {probeOf("a", "speed"), probeOf("b", "mass")};
    const ParticleFields fields;
    const GraphSource second(probeSource("b"), project, fields), whole(frameSource("kinetic_energy"), project, fields);
    QVERIFY(second && whole && !GraphSource("probe/c", project, fields) && !GraphSource("frame/c", project, fields) &&
            !GraphSource("b", project, fields));
    QCOMPARE(second.label(), std::string("b"));
    QCOMPARE(second.unit(), std::string("kg"));
    FrameStats stats;
    stats.kineticEnergy = 3;
    stats.probes = {1, 2};
    const auto measured = [&](std::vector<Probe> list) {
      stats.measured = std::make_shared<const std::vector<Probe>>(std::move(list));
    };
    measured(project.probes);
    QCOMPARE(second(stats), 2.0);
    QCOMPARE(whole(stats), 3.0);
    measured({project.probes[1], project.probes[0]});
    QCOMPARE(second(stats), 1.0);
    Probe other = project.probes[1];
    other.name = "renamed";
    measured({project.probes[0], other});
    QCOMPARE(second(stats), 2.0);
    other.body = "ice";  // it measured something else then
    measured({project.probes[0], other});
    QVERIFY(std::isnan(second(stats)));
    stats.probes = {1};
    measured({project.probes[0]});
    QVERIFY(std::isnan(second(stats)));
  }

  void parametersAreSources() {
    Project project = scenes::iceOnPlate(3, 370);
    SceneWall& floor = project.environment.walls.front();
    floor.name = "Plate";
    const ParticleFields fields(*m_plugins);
    const auto source = [&](const std::string& text) {
      return GraphSource("parameter/" + text, project, fields, m_plugins.get());
    };
    const GraphSource plate = source("wall/" + floor.id + "/temperature");
    QVERIFY(plate && plate == source("wall/" + floor.id + "/temperature"));
    QCOMPARE(plate.label(), std::string("Plate: Temperature"));
    QCOMPARE(plate.unit(), std::string("K"));
    QVERIFY(source("scene/gravity") && !(plate == source("scene/gravity")));
    // A choice, a curve, a wall that is not there, and no address.
    for (const std::string& none :
         {"wall/" + floor.id + "/heat", "material/" + project.materials.front().id + "/viscosity",
          std::string("wall/gone/temperature"), std::string("temperature")})
      QVERIFY2(!source(none), none.c_str());
    QVERIFY(std::isnan(plate(FrameStats())));  // of no run
  }

  /// What acted at each frame: the document as it was edited, and keys from their first on.
  void parametersAreWhatActed() {
    auto project = std::make_shared<Project>(scenes::iceOnPlate(3, 370));
    const Address plate{Owner::Wall, project->environment.walls.front().id, "temperature"};
    const Address other{Owner::Wall, plate.id, "roughness"};
    auto later = std::make_shared<Project>(*project);
    later->environment.walls.front().parameters.values["temperature"] = 333.0;
    auto bare = std::make_shared<Project>(*project);
    bare->environment.walls.clear();
    const RunEdits run{project,
                       {{10, std::vector<SetParameter>{{other, 0.5}, {plate, 400.0}}},
                        {20, Command(SetTracks{{{plate.text(), {{0.5, 300}, {1, 500}}}}})},
                        {30, Command(SetParameter{plate, 410.0})},
                        {40, Command(SetTracks{})},
                        {50, Command(UpdateProject{later})},
                        {60, Command(UpdateProject{bare})}}};
    const ParameterCourse course(run, m_plugins.get(), plate);
    const auto at = [&](uint64_t frame, double time) {
      FrameStats stats;
      stats.frame = frame;
      stats.time = time;
      return course.at(stats);
    };
    QCOMPARE(at(0, 0), 370.0);
    QCOMPARE(at(9, 0.15), 370.0);
    QCOMPARE(at(10, 0.17), 400.0);
    QCOMPARE(at(20, 0.34), 400.0);  // before the first key
    QCOMPARE(at(25, 0.75), 400.0);  // half way between two
    QCOMPARE(at(35, 0.5), 300.0);
    QCOMPARE(at(40, 0.75), 410.0);
    QCOMPARE(at(55, 0.9), 333.0);
    QVERIFY(std::isnan(at(60, 1)));
    QVERIFY(std::isnan(ParameterCourse({}, m_plugins.get(), plate).at(FrameStats())));
  }

  /// Between two frames, without a step and without another bit of the scene.
  void probesComeWhileTheSceneRuns() {
    Project project = scenes::iceOnPlate(3, 370);
    project.probes = {probeOf("count", "count")};
    Engine engine(project, *m_plugins);
    engine.step();
    const double count = engine.stats().probes.at(0);
    Probe water = probeOf("water", "count"), none = water;
    water.material = project.bodies.front().material;
    none.id = "none";
    none.material = "gone";
    engine.apply(SetProbes{{water, none, project.probes.front()}});
    const FrameStats stats = engine.stats();
    QCOMPARE(*stats.measured, (std::vector<Probe>{water, none, project.probes.front()}));
    QCOMPARE(stats.probes, (std::vector<double>{count, 0, count}));
    QCOMPARE(engine.probeNames().front(), std::string("water.count[1]"));
  }

  /// By the engine's thread too, paused, also after going back to a frame at which there was none.
  void theThreadTakesProbes() {
    Project project = scenes::iceOnPlate(3, 370);
    EngineThread thread(*m_plugins, {});
    thread.open(project, false);
    for (int k = 0; k < 4; ++k) thread.stepOnce();
    thread.apply(SetProbes{{probeOf("count", "count")}});
    const auto counted = [&] {
      const SnapshotPtr shown = thread.snapshot();
      return shown && shown->stats.probes.size() == 1 ? shown->stats.probes[0] : 0;
    };
    QTRY_COMPARE_WITH_TIMEOUT(counted(), 27.0, 20000);
    thread.continueFrom(2, false);
    QTRY_VERIFY_WITH_TIMEOUT(thread.snapshot()->stats.frame == 2, 20000);
    thread.stepOnce();
    QTRY_VERIFY_WITH_TIMEOUT(thread.snapshot()->stats.frame == 3, 20000);
    QCOMPARE(counted(), 27.0);
    QVERIFY(thread.events(0).empty());
  }

  void rowsSetWhatAProbeIs() {
    Project project = scenes::iceOnPlate(3, 370);
    project.probes = {probeOf("p", "speed")};
    Probe& probe = project.probes.front();
    const Environment& around = project.environment;
    const auto set = [&](const char* key, const Value& value) { return setProbeValue(probe, key, value, around); };
    for (const api::ParameterDeclaration& d : probeParameters(project, ParticleFields()))
      QVERIFY2(probeValue(probe, d.key, around), d.key);
    QVERIFY(set("quantity", std::string("temperature")) && set("phase", std::string("liquid")));
    QCOMPARE(probe.quantity, std::string("temperature"));
    QCOMPARE(probe.phase, std::string("liquid"));
    QVERIFY(set("phase", std::string(kProbeAll)) && probe.phase.empty());
    QVERIFY(!set("box_max_y", 0.1));  // it has no box
    QVERIFY(set("in_box", true) && set("box_max_y", 0.1));
    QCOMPARE(probe.region->maximum[1], 0.1);
    QCOMPARE(probe.region->minimum[0], around.boundsMinimum[0]);
    QCOMPARE(probe.regionWhen, std::string(Probe::kNow));
    QVERIFY(!set("fixed", 1.0) && !set("no_such_key", true));
    QVERIFY(!problemWith(project, m_plugins.get(), {Owner::Probe, "p", "box_max_y"}, -1e9).empty());
    QCOMPARE(idleOf(project, "box_max_y"), std::string());
    QVERIFY(set("in_box", false) && !probe.region);
    QVERIFY(!idleOf(project, "box_max_y").empty());
    QVERIFY(probeProblems(probe, ParticleFields()).empty());
    probe.quantity = "force_x";
    QCOMPARE(probeProblems(probe, ParticleFields()).front().first, std::string("quantity"));
  }

  void whatIsChosenTakesItsPartnerAlong() {
    Project project = scenes::iceOnPlate(3, 370);
    const std::string wall = project.environment.walls.front().id, body = project.bodies.front().id;
    const auto after = [&](Probe probe, const char* key, const std::string& value) {
      setProbeValue(probe, key, value, project.environment);
      followChoice(probe, key, project);
      return probe;
    };
    Probe matter = probeOf("p", "speed");
    matter.phase = "liquid";
    matter.region = Region{};
    const Probe force = after(matter, "quantity", "force_x");
    QCOMPARE(force.wall, wall);
    QVERIFY(force.phase.empty() && !force.region);
    QVERIFY(probeProblems(force, ParticleFields()).empty());
    QVERIFY(after(force, "quantity", "mass").wall.empty());
    const Probe onBody = after(force, "body", body);
    QVERIFY(onBody.wall.empty() && onBody.quantity == "force_x");
    QVERIFY(after(onBody, "wall", wall).body.empty());
    QVERIFY(after(matter, "phase", kProbeAll).region);
    // Of a wall the force along its normal; where there is no wall, of a body.
    project.environment.walls.front().normal = Vector3(0, 0, -2);
    QCOMPARE(after(matter, "wall", wall).quantity, std::string("force_z"));
    project.environment.walls.clear();
    QCOMPARE(after(matter, "quantity", "torque_y").body, body);
  }

  void whatIsNotThereIsSaid_data() {
    QTest::addColumn<QString>("graph");
    QTest::addColumn<QString>("says");
    QTest::newRow("probe") << R"({"id": "g", "series": ["probe/gone"]})"
                           << "/graphs/0/series/0: there is no 'probe/gone'";
    QTest::newRow("body") << R"({"id": "g", "kind": "profile", "body": "gone"})"
                          << "/graphs/0/body: there is no body";
    QTest::newRow("field") << R"({"id": "g", "kind": "histogram", "field": "no.such"})"
                           << "/graphs/0/field: no installed plugin has a field for 'no.such'";
  }

  void whatIsNotThereIsSaid() {
    QFETCH(QString, graph);
    QFETCH(QString, says);
    const std::string file = PS_SOURCE_DIR "/projects/dam-break.json";
    const LoadedProject loaded = loadProject(file, *m_plugins, {"graphs=[" + graph.toStdString() + "]"});
    std::string all;
    for (const ProjectMessage& message : loaded.warnings) all += message.text + "\n";
    QVERIFY2(QString::fromStdString(all).contains(says), all.c_str());
    QVERIFY(loaded.project.graphs && loaded.project.graphs->size() == 1);
  }

 private:
  std::string idleOf(const Project& project, const char* key) const {
    return idleReason(project, m_plugins.get(), {Owner::Probe, "p", key});
  }
  std::unique_ptr<PluginRegistry> m_plugins;
};

QTEST_APPLESS_MAIN(TestGraphSource)
#include "tst_graphsource.moc"
