// SPDX-License-Identifier: Apache-2.0
// Scene to engine and back: what a project compiles to, what an edit touches, and what the engine's thread promises.
#include "core/base/error.h"
#include "core/base/log.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/commandqueue.h"
#include "core/simulation/compile.h"
#include "core/simulation/engine.h"
#include "core/simulation/enginethread.h"
#include "core/simulation/finersteps.h"
#include "core/simulation/lattice.h"
#include "core/simulation/measure.h"
#include "core/solver/solver.h"
#include "tests/shared/scenes.h"

#include <QScopeGuard>
#include <QTest>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <thread>

using namespace ps;

class TstSimulation : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void boxFillsItsSize_data();
  void boxFillsItsSize();
  void bornAsDeclared();
  void anEditActsOnTheNextFrame();
  void anEditOfABodysConstraintReachesThatBodyAlone();
  void theOrderOfBodiesTiesNothingLess();
  void anEditOfTheSceneSurvivesReset();
  void gravityAndThermalModelActOnTheNextFrame();
  void motionActsAtOnceWhereItIsPrescribed();
  void aTurningBodyBesideAnotherKeepsItsOwnSpeeds();
  void spacingActsAtTheNextReset();
  void sketchesKeepTheirPlaceAtAnotherSpacing_data();
  void sketchesKeepTheirPlaceAtAnotherSpacing();
  void refusedEditsLeaveTheSceneAsItWas();
  void cellsAvoidLiveParticlesAndComeBackOut();
  void takenMatterComesBackAsItWas();
  void aMissingMaterialStandsStill();
  void probesReadWhatTheyName();
  void aBodyKeepsItsParticles();
  void cellsThatCannotBeMadeLeaveNoTrace();
  void noTwoParticlesInOnePlace();
  void periodicBoxesHoldOneImageOfEach();
  void endlessParticlesAreRefused();
  void stepsAreMadeFiner_data();
  void stepsAreMadeFiner();
  void aFineSpacingTakesMoreSubsteps_data();
  void aFineSpacingTakesMoreSubsteps();
  void runsWithoutAnyPlugin();
  void viscosityIsCompiledAsDeclared();
  void threadPlaysPausesStepsAndResets();
  void threadStopsAtTheEnd();
  void waitingEditsOfOneAddressAreOne();
  void waitingProjectsReplaceWhatTheyOverwrite();
  void aMaterialsEditBakesOneTable();
  void valuesThatDependOnEachOtherComeTogether();
  void aListOfCommandsRepeatsARun();
  void aQueueOfEditsIsOneSnapshot();
  void editsDoNotStarveFrames();
  void threadTellsWhatCannotBeOpened();
  void snapshotsOfTwoRunsNeverCompare();

 private:
  PluginRegistry m_plugins;
};

namespace {

uint32_t count(const Snapshot& snapshot) { return static_cast<uint32_t>(snapshot.position.size()); }

Body sketchedWater() {
  Body body;
  body.id = body.name = "sketch";
  body.material = "water";
  VoxelShape voxels;
  voxels.origin = {0, 0.6, 0};
  voxels.spacing = 0.03;
  voxels.palette.push_back({"water", 293.15});
  body.shape = voxels;
  return body;
}

/// Waits at most ten seconds, far longer than any frame of these scenes takes.
template <class Condition>
bool waitFor(Condition condition) {
  return QTest::qWaitFor(condition, 10000);
}

}  // namespace

void TstSimulation::boxFillsItsSize_data() {
  QTest::addColumn<double>("size");
  QTest::addColumn<int>("expected");
  QTest::newRow("exact") << 0.3 << 1000;
  QTest::newRow("rounds to the nearest layer") << 0.314 << 1000;
  QTest::newRow("never empty") << 0.001 << 1;
}

void TstSimulation::boxFillsItsSize() {
  QFETCH(double, size);
  QFETCH(int, expected);
  const auto positions = boxLattice({{0.1, 0.2, 0.3}, {size, size, size}}, 0.03);
  QCOMPARE(static_cast<int>(positions.size()), expected);
  api::Double3 mean{0, 0, 0};
  for (const auto& p : positions) mean = {mean.x + p.x, mean.y + p.y, mean.z + p.z};
  QVERIFY(std::abs(mean.x / expected - 0.1) < 1e-12 && std::abs(mean.z / expected - 0.3) < 1e-12);
}

void TstSimulation::bornAsDeclared() {
  Engine engine(scenes::iceOnPlate(6, 293.15), m_plugins);
  const SnapshotPtr start = engine.snapshot();
  QCOMPARE(count(*start), 216u);
  QVERIFY(std::all_of(start->motion.begin(), start->motion.end(), [](auto m) { return m == api::Motion::Solid; }));
  QVERIFY(engine.solver().constraintCount() > 216u);
  const double mass = start->stats.phases[0].mass;
  QVERIFY2(std::abs(mass / (216 * 917 * 0.03 * 0.03 * 0.03) - 1) < 0.01, qPrintable(QString::number(mass)));
  QVERIFY(std::abs(start->stats.temperatureMean - 263.15) < 1e-6);
}

void TstSimulation::anEditActsOnTheNextFrame() {
  Engine cold(scenes::iceOnPlate(6, 263.15), m_plugins), warmed(scenes::iceOnPlate(6, 263.15), m_plugins);
  cold.step();
  warmed.step();
  QCOMPARE(cold.solver().stateHash(), warmed.solver().stateHash());
  QVERIFY(warmed.setParameter({Owner::Wall, "floor", "temperature"}, 400.0));
  cold.step();
  warmed.step();
  QVERIFY(warmed.stats().thermalEnergy > cold.stats().thermalEnergy);
  QVERIFY(warmed.stats().heat.walls > 0);
}

void TstSimulation::anEditOfABodysConstraintReachesThatBodyAlone() {
  Project project = scenes::iceOnPlate(3, 293.15);
  project.environment = scenes::tray(1, 2);
  for (const char* id : {"left", "right"}) {
    Body block = scenes::block(id, 3, 0.03, {id[0] == 'l' ? -0.5 : 0.5, 0.4, 0}, 263.15);
    block.constraints[0].parameters.values["damping"] = id[0] == 'l' ? 0.0 : 0.01;
    project.bodies.push_back(block);
  }
  for (SceneMaterial& m : project.materials) m.properties.values["youngs_modulus"] = 2e4;
  const auto heights = [](Engine& engine, uint32_t body) {
    std::vector<float> y;
    const ParticleStore& p = engine.solver().particles();
    for (uint32_t id = 0; id < p.size(); ++id) {
      if (p.body()[p.indexOf(id)] == body) y.push_back(p.position()[p.indexOf(id)].y);
    }
    return y;
  };
  Engine left(project, m_plugins), both(project, m_plugins);
  for (int f = 0; f < 30; ++f) {
    if (f == 5) QVERIFY(left.setParameter(*Address::parse("constraint/left/bonds/damping"), Value(0.02)));
    QCOMPARE(left.step().flags, 0u);
    QCOMPARE(both.step().flags, 0u);
  }
  QVERIFY(heights(left, 1) != heights(both, 1));
  QVERIFY(heights(left, 2) == heights(both, 2));  // bit for bit
}

/// A rope before its post in the list is tied to it all the same.
void TstSimulation::theOrderOfBodiesTiesNothingLess() {
  for (const bool postFirst : {true, false}) {
    Project project = scenes::iceOnPlate(3, 263.15);
    project.bodies.clear();
    project.materials[0].properties.values["sinters"] = false;  // or the two would freeze together
    const double dx = 0.02;
    Body post = scenes::block("post", 3, dx, {-0.04, 0.5, 0}, 263.15), rope = post;
    post.parameters.values["fixed"] = true;
    post.constraints.clear();
    rope.id = rope.name = "rope";
    rope.shape = BoxShape{{0.09, 0.5, 0}, {0.2, dx, dx}, {}};
    rope.parameters.values["fixed"] = false;
    rope.constraints = {{"rope", {}, {}}};
    rope.constraints[0].parameters.values["tied_to_fixed"] = true;
    project.bodies = postFirst ? std::vector<Body>{post, rope} : std::vector<Body>{rope, post};
    project.solver.parameters.values["particle_spacing"] = dx;
    Engine engine(project, m_plugins);
    QCOMPARE(engine.bodyIds()[0], project.bodies[0].id);
    for (int f = 0; f < 40; ++f) QCOMPARE(engine.step().flags, 0u);
    double top = 0;
    const ParticleStore& p = engine.solver().particles();
    for (size_t i = 0; i < p.size(); ++i) {
      if (engine.bodyIds()[p.body()[i]] == "rope") top = std::max(top, double{p.position()[i].y});
    }
    QVERIFY2(top > 0.45, qPrintable(QString::number(top)));  // untied it lies on the plate
  }
}

void TstSimulation::anEditOfTheSceneSurvivesReset() {
  Engine engine(scenes::iceOnPlate(5, 293.15), m_plugins);
  QVERIFY(!engine.setParameter({Owner::Body, "ice", "temperature"}, 253.15));
  QVERIFY(std::abs(engine.stats().temperatureMean - 263.15) < 1e-6);
  engine.reset();
  QVERIFY(std::abs(engine.stats().temperatureMean - 253.15) < 1e-6);
}

void TstSimulation::motionActsAtOnceWhereItIsPrescribed() {
  Project project = scenes::iceOnPlate(4, 260);
  project.environment.gravity = {0, 0, 0};
  project.environment.walls.clear();
  Body& body = project.bodies[0];
  body.parameters.values["fixed"] = true;
  const std::string id = body.id;
  Engine engine(project, m_plugins);
  const auto height = [&] { return engine.solver().particles().position()[0].y; };
  const float before = height();
  QVERIFY(engine.setParameter({Owner::Body, id, "velocity_y"}, 0.6));
  engine.step();
  QVERIFY(std::abs(height() - before - 0.01f) < 1e-6f);  // 0.6 m/s for 1/60 s
  body.parameters.values["fixed"] = false;
  Engine loose(project, m_plugins);
  QVERIFY(!loose.setParameter({Owner::Body, id, "velocity_y"}, 0.6));
  loose.step();
  QVERIFY(std::abs(loose.solver().particles().velocity()[0].y) < 1e-3f);
  loose.reset();
  loose.step();
  QVERIFY(std::abs(loose.solver().particles().velocity()[0].y - 0.6f) < 1e-3f);
}

void TstSimulation::aTurningBodyBesideAnotherKeepsItsOwnSpeeds() {
  Project project = scenes::iceOnPlate(4, 260);
  Engine engine(project, m_plugins);
  Body body = project.bodies[0];
  body.id = "turning";
  auto& box = std::get<BoxShape>(body.shape);
  box.center[0] += box.size[0] / 2;  // half of it is taken
  body.spin = {0, 0, 2};
  const std::vector<uint32_t> ids = engine.addBody(body);
  QVERIFY(ids.size() > 16 && ids.size() < 64);
  const ParticleStore& store = engine.solver().particles();
  for (const uint32_t id : ids) {
    const size_t i = store.indexOf(id);
    const api::Float4 p = store.position()[i], v = store.velocity()[i];
    QVERIFY(std::abs(v.x + 2 * (p.y - box.center[1])) < 1e-6 && std::abs(v.y - 2 * (p.x - box.center[0])) < 1e-6);
  }
}

void TstSimulation::gravityAndThermalModelActOnTheNextFrame() {
  Project project = scenes::iceOnPlate(5, 370);
  std::get<BoxShape>(project.bodies[0].shape).center[1] += 1;
  Engine engine(project, m_plugins);
  QVERIFY(engine.setParameter({Owner::Scene, "", "gravity"}, 0.0));
  for (int f = 0; f < 5; ++f) engine.step();
  for (size_t i = 0; i < engine.solver().particles().size(); ++i)
    QCOMPARE(engine.solver().particles().velocity()[i].y, 0.0f);
  QVERIFY(engine.setParameter({Owner::Scene, "", "gravity"}, 2.0));
  engine.step();
  // One frame of free fall: g dt, within what bonds and density may do to it in that time.
  QVERIFY(std::abs(engine.solver().particles().velocity()[0].y + 2.0f / 60) < 0.005f);
  QVERIFY(!engine.solver().thermalEnergies().empty());
  QVERIFY(engine.setParameter({Owner::Scene, "", "thermal_model"}, std::string("none")));
  engine.step();
  QVERIFY(engine.solver().thermalEnergies().empty());
  QVERIFY(engine.setParameter({Owner::Scene, "", "thermal_model"}, std::string("enthalpy")));
  QCOMPARE(engine.step().flags, StepFlags{0});
  QVERIFY(!engine.solver().thermalEnergies().empty());
  QVERIFY(!engine.setParameter({Owner::Scene, "", "colour"}, 1.0));
}

void TstSimulation::spacingActsAtTheNextReset() {
  Engine engine(scenes::iceOnPlate(6, 293.15), m_plugins);
  QVERIFY(!engine.setParameter({Owner::Solver, "", "particle_spacing"}, 0.06));
  QVERIFY(engine.setParameter({Owner::Solver, "", "damping"}, 0.1));
  for (int i = 0; i < 20; ++i) QCOMPARE(engine.step().flags, 0u);
  const FrameStats stats = engine.stats();  // twice the spacing among living particles would blow the block apart
  QVERIFY2(stats.kineticEnergy < 1, qPrintable(QString::number(stats.kineticEnergy)));
  engine.reset();
  QCOMPARE(engine.solver().particles().size(), size_t{27});
}

void TstSimulation::sketchesKeepTheirPlaceAtAnotherSpacing_data() {
  QTest::addColumn<double>("spacing");
  QTest::addColumn<int>("count");
  QTest::newRow("as drawn") << 0.03 << 64;
  QTest::newRow("half") << 0.015 << 512;
  QTest::newRow("two thirds") << 0.02 << 216;
  QTest::newRow("double") << 0.06 << 8;
}

/// Four cells of 30 mm a side from (-15, 585, -15) mm on fill the same cube whatever the particles' size.
void TstSimulation::sketchesKeepTheirPlaceAtAnotherSpacing() {
  QFETCH(double, spacing);
  QFETCH(int, count);
  Project project = scenes::iceOnPlate(5, 293.15);
  Body body = sketchedWater();
  auto& voxels = std::get<VoxelShape>(body.shape);
  std::vector<CellIndex> cells;
  cells.reserve(64);
  for (int k = 0; k < 16; ++k) voxels.runs.push_back({0, k % 4, k / 4, 4, 0});
  for (int k = 0; k < 64; ++k) cells.push_back({k % 4, k / 4 % 4, k / 16});
  project.bodies = {body};
  Engine engine(project, m_plugins);
  QCOMPARE(engine.solver().particles().size(), size_t{64});
  engine.setParameter({Owner::Solver, "", "particle_spacing"}, spacing);
  engine.reset();
  const ParticleStore& store = engine.solver().particles();
  QCOMPARE(static_cast<int>(store.size()), count);
  const Vector3 corner{-0.015, 0.585, -0.015};
  for (size_t i = 0; i < store.size(); ++i) {
    const api::Float4& p = store.position()[i];
    for (const auto& [place, axis] : {std::pair{p.x, 0}, {p.y, 1}, {p.z, 2}}) {
      const double inside = static_cast<double>(place) - corner[static_cast<size_t>(axis)];
      // Half a particle from each face; single precision at half a metre.
      QVERIFY(inside > spacing / 2 - 1e-6 && inside < 0.12 - spacing / 2 + 1e-6);
    }
  }
  QCOMPARE(static_cast<int>(engine.particlesIn(voxels, cells).size()), count);
}

void TstSimulation::refusedEditsLeaveTheSceneAsItWas() {
  Engine engine(scenes::iceOnPlate(5, 293.15), m_plugins), untouched(scenes::iceOnPlate(5, 293.15), m_plugins);
  QVERIFY_THROWS_EXCEPTION(InputError, engine.setParameter({Owner::Material, "water", "solidus"}, 5000.0));
  Project broken = engine.project();
  broken.environment.walls[0].normal = {0, 0, 0};
  QVERIFY_THROWS_EXCEPTION(InputError, engine.update(broken));
  // Bodies act at the next reset: of a material that has left the document, or never was in it, none can be built.
  // Living matter keeps its substance meanwhile.
  const Project whole = engine.project();
  Project unbuildable = whole;
  unbuildable.materials[0].id = "other";
  engine.update(unbuildable);
  QCOMPARE(engine.project().materials[0].id, std::string("water"));
  QVERIFY_THROWS_EXCEPTION(InputError, engine.reset());
  engine.update(whole);
  unbuildable = whole;
  unbuildable.bodies[0].material = "phlogiston";
  engine.update(unbuildable);
  const uint64_t revision = engine.snapshot()->revision;
  QVERIFY_THROWS_EXCEPTION(InputError, engine.reset());
  QCOMPARE(engine.snapshot()->revision, revision);
  engine.step();
  untouched.step();
  QCOMPARE(engine.solver().stateHash(), untouched.solver().stateHash());
}

void TstSimulation::cellsAvoidLiveParticlesAndComeBackOut() {
  Engine engine(scenes::iceOnPlate(5, 293.15), m_plugins);
  const size_t before = engine.solver().particles().size();
  const std::vector<CellIndex> cells = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  const auto ids = engine.addCells(sketchedWater(), cells, 0);
  QCOMPARE(ids.size(), size_t{3});  // the same cell twice is one particle
  QVERIFY(engine.addCells(sketchedWater(), cells, 0).empty());
  const auto voxels = std::get<VoxelShape>(sketchedWater().shape);
  QCOMPARE(engine.particlesIn(voxels, cells), ids);
  engine.extractParticles(ids);
  QCOMPARE(engine.solver().particles().size(), before);
  const StepReport report = engine.step();
  QCOMPARE(report.flags, 0u);
}

void TstSimulation::takenMatterComesBackAsItWas() {
  Engine engine(scenes::iceOnPlate(5, 293.15), m_plugins);
  for (int i = 0; i < 5; ++i) engine.step();
  const size_t bonds = engine.solver().constraintCount();
  const double energy = engine.stats().thermalEnergy;
  const std::vector<uint32_t> ids = {3, 60, 61, 124, 9999};  // the last never lived
  const size_t row = engine.solver().particles().indexOf(60);
  const double temperature = engine.solver().particles().temperature()[row];
  const ExtractedMatter taken = engine.extractParticles(ids);
  QCOMPARE(engine.solver().particles().size(), size_t{121});
  QVERIFY(engine.solver().constraintCount() < bonds);
  engine.putBack(taken);
  QCOMPARE(engine.solver().particles().size(), size_t{125});
  QCOMPARE(engine.solver().constraintCount(), bonds);
  QVERIFY(std::abs(engine.stats().thermalEnergy - energy) < 1e-9 * std::abs(energy));  // sums in another order
  const ParticleStore& store = engine.solver().particles();
  QCOMPARE(store.temperature()[store.indexOf(60)], temperature);
  QVERIFY_THROWS_EXCEPTION(Error, engine.putBack(taken));
  for (int i = 0; i < 5; ++i) QCOMPARE(engine.step().flags, 0u);
}

void TstSimulation::aMissingMaterialStandsStill() {
  Project project = scenes::iceOnPlate(5, 293.15);
  project.materials.push_back({"odd", "Odd", "not-installed", {}, {}, {}, {}, {}});
  Body body = scenes::block("odd", 3, 0.03, {0, 0.8, 0}, 293.15);
  body.material = "odd";
  project.bodies.push_back(body);
  Engine engine(project, m_plugins);
  for (int i = 0; i < 10; ++i) QCOMPARE(engine.step().flags, 0u);
  const SnapshotPtr now = engine.snapshot();
  for (size_t i = 0; i < now->id.size(); ++i) {
    if (now->body[i] == 1) QVERIFY(now->motion[i] == api::Motion::Static && now->speed[i] == 0);
  }
}

void TstSimulation::probesReadWhatTheyName() {
  Project project = scenes::iceOnPlate(5, 293.15);
  Probe mass = project.probes[0];
  mass.id = "mass";
  mass.quantity = "solid_mass";
  project.probes.push_back(mass);
  Probe none = project.probes[0];
  none.phase = "gas";
  project.probes.push_back(none);
  for (const char* quantity : {"thermal_energy", "kinetic_energy"}) {
    Probe energy = project.probes[0];
    energy.quantity = quantity;
    project.probes.push_back(energy);
  }
  Engine engine(project, m_plugins);
  engine.step();
  const FrameStats moving = engine.stats();
  QVERIFY(moving.kineticEnergy > 0 && std::abs(moving.probes[4] / moving.kineticEnergy - 1) < 1e-12);
  engine.reset();
  const FrameStats stats = engine.stats();
  QCOMPARE(stats.probes.size(), size_t{5});
  QVERIFY(std::abs(stats.probes[3] / stats.thermalEnergy - 1) < 1e-12);  // all matter is the one body's
  QVERIFY(std::abs(stats.probes[0] - 263.15) < 1e-6);
  QVERIFY(std::abs(stats.probes[1] - stats.phases[0].mass) < 1e-12);
  QVERIFY(std::isnan(stats.probes[2]));  // a mean over no particles is not zero
  QCOMPARE(engine.probeNames()[0], std::string("ice core.temperature[K]"));
}

void TstSimulation::aBodyKeepsItsParticles() {
  const auto bodyOf = [](const Engine& engine, uint32_t id) {
    const SnapshotPtr now = engine.snapshot();
    const auto row = static_cast<size_t>(std::find(now->id.begin(), now->id.end(), id) - now->id.begin());
    return (*now->bodyIds)[now->body[row]];
  };
  Project project = scenes::iceOnPlate(4, 293.15);
  Body second = scenes::block("second", 2, 0.03, {0, 0.4, 0}, 293.15);
  project.bodies.push_back(second);
  project.probes[0].body = "second";
  project.probes[0].quantity = "count";
  Engine engine(project, m_plugins);
  const Project before = engine.project();
  engine.addCells(sketchedWater(), {{0, 0, 0}}, 0);
  engine.update(before);  // undone
  Body other = sketchedWater();
  other.id = other.name = "other";
  const auto ids = engine.addCells(other, {{2, 0, 0}}, 0);
  QCOMPARE(ids.size(), size_t{1});
  QCOMPARE(bodyOf(engine, ids[0]), std::string("other"));
  Project withoutFirst = engine.project();
  withoutFirst.bodies.erase(withoutFirst.bodies.begin());
  engine.update(withoutFirst);
  QCOMPARE(engine.stats().probes[0], 8.0);
  QCOMPARE(bodyOf(engine, engine.addCells(other, {{4, 0, 0}}, 0).at(0)), std::string("other"));
  engine.reset();
  QCOMPARE(engine.stats().probes[0], 8.0);
}

void TstSimulation::cellsThatCannotBeMadeLeaveNoTrace() {
  Engine engine(scenes::iceOnPlate(4, 293.15), m_plugins);
  Body odd = sketchedWater();
  std::get<VoxelShape>(odd.shape).palette.push_back({"phlogiston", 293.15});
  QVERIFY_THROWS_EXCEPTION(InputError, engine.addCells(odd, {{0, 0, 0}}, 1));
  QCOMPARE(engine.project().bodies.size(), size_t{1});
  QCOMPARE(engine.bodyIds().size(), size_t{1});
  QCOMPARE(engine.solver().particles().size(), size_t{64});
}

void TstSimulation::noTwoParticlesInOnePlace() {
  std::vector<std::string> told;
  setLogHook([&](LogLevel, std::string_view text) { told.emplace_back(text); });
  const auto quiet = qScopeGuard([] { setLogHook({}); });
  Project project = scenes::iceOnPlate(4, 293.15);
  project.bodies.push_back(project.bodies[0]);
  project.bodies[1].id = project.bodies[1].name = "twin";
  Engine twice(project, m_plugins);
  QCOMPARE(twice.solver().particles().size(), size_t{64});
  QCOMPARE(told.size(), size_t{1});
  QVERIFY2(told[0].find("'twin': left out 64 particles") != std::string::npos, told[0].c_str());
  // Side by side and both rounded up from 5.52 to 6 layers: nearer than the spacing, and two bodies all the same.
  for (size_t b = 0; b < 2; ++b) {
    project.bodies[b].shape = BoxShape{{b == 0 ? -0.0828 : 0.0828, 0.1, 0}, {0.1656, 0.1656, 0.1656}};
  }
  Engine beside(project, m_plugins);
  QCOMPARE(beside.solver().particles().size(), size_t{432});
  QCOMPARE(told.size(), size_t{1});
}

void TstSimulation::periodicBoxesHoldOneImageOfEach() {
  Project project = scenes::iceOnPlate(4, 293.15);
  const double d = numberOf(project.solver.parameters, solverParameters(), "particle_spacing");
  project.environment.walls.clear();
  project.environment.boundsMinimum = {-5 * d, -1, -1};
  project.environment.boundsMaximum = {5 * d, 1, 1};
  project.environment.periodic = {true, false, false};
  project.bodies[0].shape = BoxShape{{4 * d, 0, 0}, {12 * d, 4 * d, 4 * d}};  // two layers longer than the box
  Engine engine(project, m_plugins);
  QCOMPARE(engine.solver().particles().size(), size_t{10 * 4 * 4});
  const SnapshotPtr seen = engine.snapshot();
  for (const api::Float4& p : seen->position) QVERIFY(std::abs(p.x) <= static_cast<float>(5 * d));
  QVERIFY(seen->period.length(0) > 0);
  // Cells that lie beyond the face are taken already; those of the next row are free.
  Body body = sketchedWater();
  auto& voxels = std::get<VoxelShape>(body.shape);
  voxels.spacing = d;
  voxels.origin = {5.5 * d, 1.5 * d, 1.5 * d};
  QCOMPARE(engine.addCells(body, {{0, 0, 0}}, 0).size(), size_t{0});
  QCOMPARE(engine.addCells(body, {{0, 1, 0}}, 0).size(), size_t{1});
  project.environment.boundsMaximum[0] = 0;
  QVERIFY_THROWS_EXCEPTION(InputError, engine.update(project));
  QVERIFY_THROWS_EXCEPTION(InputError, Engine(project, m_plugins));
}

void TstSimulation::endlessParticlesAreRefused() {
  const Address spacing{Owner::Solver, "", "particle_spacing"};
  Engine engine(scenes::iceOnPlate(5, 293.15), m_plugins);
  QVERIFY_THROWS_EXCEPTION(InputError, engine.setParameter(spacing, 0.0005));  // 27 million
  QCOMPARE(numberOf(engine.project().solver.parameters, solverParameters(), "particle_spacing"), 0.03);
  Project project = engine.project();
  findSet(project, spacing)->values[spacing.key] = 0.0005;
  QVERIFY_THROWS_EXCEPTION(InputError, Engine(project, m_plugins));
}

void TstSimulation::stepsAreMadeFiner_data() {
  QTest::addColumn<int>("substeps");
  QTest::addColumn<int>("iterations");
  QTest::addColumn<int>("finer");  // 0: none
  QTest::addColumn<int>("passes");
  QTest::newRow("one step") << 1 << 1 << 4 << 4;
  QTest::newRow("defaults") << 4 << 4 << 16 << 4;
  QTest::newRow("eight, many passes") << 8 << 16 << 16 << 16;
  QTest::newRow("above what a slider has") << 24 << 2 << 48 << 4;
  QTest::newRow("near the most") << 40 << 4 << 64 << 4;
  QTest::newRow("the most") << 64 << 1 << 0 << 0;
}

void TstSimulation::stepsAreMadeFiner() {
  QFETCH(int, substeps);
  QFETCH(int, iterations);
  QFETCH(int, finer);
  QFETCH(int, passes);
  Project project = scenes::iceOnPlate(3, 293.15);
  project.solver.parameters.values["substeps"] = double(substeps);
  project.solver.parameters.values["iterations"] = double(iterations);
  const std::optional<FinerSteps> found = finerSteps(project);
  QCOMPARE(found.has_value(), finer > 0);
  if (found) QVERIFY((*found == FinerSteps{finer, passes}));
  Track track;
  track.parameter = "solver/substeps";
  track.keys = {{0, 4}};
  project.tracks = {track};
  QVERIFY(!finerSteps(project));
}

void TstSimulation::aFineSpacingTakesMoreSubsteps_data() {
  QTest::addColumn<double>("spacing");
  QTest::addColumn<QString>("key");  // with a value beside it; "" none
  QTest::addColumn<double>("gravity");
  QTest::addColumn<int>("substeps");  // 0: nothing to say
  QTest::newRow("default") << 0.02 << QString() << 9.81 << 0;
  QTest::newRow("finer") << 0.01 << QString() << 9.81 << 0;
  QTest::newRow("least of the slider") << 0.005 << QString() << 9.81 << 8;
  QTest::newRow("4 mm") << 0.004 << QString() << 9.81 << 9;
  QTest::newRow("as fine as can be") << 0.0005 << QString() << 9.81 << 26;
  QTest::newRow("without weight") << 0.004 << QString() << 0.0 << 0;
  QTest::newRow("chosen substeps") << 0.004 << QStringLiteral("substeps") << 9.81 << 0;
  QTest::newRow("chosen iterations") << 0.004 << QStringLiteral("iterations") << 9.81 << 0;
  QTest::newRow("chosen frame") << 0.004 << QStringLiteral("dt") << 9.81 << 0;
}

void TstSimulation::aFineSpacingTakesMoreSubsteps() {
  QFETCH(double, spacing);
  QFETCH(QString, key);
  QFETCH(double, gravity);
  QFETCH(int, substeps);
  Project project = scenes::iceOnPlate(3, 293.15);
  project.environment.gravity = {0, -gravity, 0};
  project.solver.parameters.values["particle_spacing"] = spacing;
  if (!key.isEmpty()) project.solver.parameters.values[key.toStdString()] = 2.0;
  QCOMPARE(substepsAtSpacing(project).value_or(0), substeps);
}

void TstSimulation::runsWithoutAnyPlugin() {
  PluginRegistry none({{}, false, false, false});
  QVERIFY(none.plugins().empty());
  Engine engine(scenes::iceOnPlate(5, 293.15), none);
  for (int i = 0; i < 5; ++i) QCOMPARE(engine.step().flags, 0u);
  QCOMPARE(engine.stats().frame, uint64_t{5});
}

void TstSimulation::threadPlaysPausesStepsAndResets() {
  std::atomic<int> published{0};
  EngineThread thread(m_plugins, [&] { ++published; });
  QVERIFY(!thread.snapshot());
  thread.open(scenes::iceOnPlate(5, 293.15), false);
  QVERIFY(waitFor([&] { return thread.snapshot() != nullptr; }));
  QCOMPARE(thread.snapshot()->stats.frame, uint64_t{0});
  thread.stepOnce();
  QVERIFY(waitFor([&] { return thread.snapshot()->stats.frame == 1; }));
  thread.play();
  QVERIFY(waitFor([&] { return thread.snapshot()->stats.frame > 5; }));
  thread.pause();
  QVERIFY(!thread.playing());
  QVERIFY(thread.history(0).size() > 5);
  QVERIFY(thread.previousSnapshot());
  thread.reset();
  QVERIFY(waitFor([&] { return thread.snapshot()->stats.frame == 0; }));
  QCOMPARE(thread.history(0).size(), size_t{1});
  const size_t before = thread.snapshot()->id.size();
  thread.apply(AddCells{std::make_shared<const Body>(sketchedWater()), {{0, 0, 0}}, 0, 1});
  QVERIFY(waitFor([&] { return thread.snapshot()->id.size() == before + 1; }));
  QVERIFY(published > 5);
}

/// Play ends where the scene ends, to the frame, and goes on from there when asked again.
void TstSimulation::threadStopsAtTheEnd() {
  EngineThread thread(m_plugins, {});
  Project project = scenes::iceOnPlate(3, 293.15);
  project.duration = 0.2;  // 12 frames
  thread.open(project, true);
  QVERIFY(waitFor([&] { return thread.snapshot() && !thread.playing(); }));
  thread.apply(ForgetMatter{});
  QVERIFY(waitFor([&] { return thread.snapshot()->stats.frame == 12; }));
  thread.play();
  QVERIFY(waitFor([&] { return thread.snapshot()->stats.frame > 20; }));
  QVERIFY(thread.playing());
  thread.reset();
  QVERIFY(waitFor([&] { return !thread.playing(); }));
  QCOMPARE(thread.snapshot()->stats.frame, uint64_t{12});
}

namespace {
const Address kDamping{Owner::Solver, "", "damping"}, kSubsteps{Owner::Solver, "", "substeps"};
}  // namespace

/// A newer value replaces a waiting one of its address; what is no value of a parameter keeps its place.
void TstSimulation::waitingEditsOfOneAddressAreOne() {
  CommandQueue queue;
  for (int k = 0; k < 100; ++k) {
    queue.push(Command(SetParameter{kDamping, 0.01 * k}));
    queue.push(Command(SetParameter{kSubsteps, 1.0 + k}));
  }
  queue.push(Command(TakeBody{"ice", 1}));
  queue.push(Command(SetParameter{kDamping, 5.0}));
  const auto first = queue.pop(), second = queue.pop(), third = queue.pop();
  QVERIFY(first && second && third && queue.empty());
  const auto* batch = std::get_if<ParameterBatch>(&*first);
  QVERIFY(batch && batch->size() == 2);
  QVERIFY((*batch)[0].address == kDamping && (*batch)[0].value == Value(0.99));
  QVERIFY((*batch)[1].address == kSubsteps && (*batch)[1].value == Value(100.0));
  QVERIFY(std::holds_alternative<Command>(*second));
  const auto* last = std::get_if<ParameterBatch>(&*third);
  QVERIFY(last && last->size() == 1 && (*last)[0].value == Value(5.0));
}

void TstSimulation::waitingProjectsReplaceWhatTheyOverwrite() {
  const auto update = [] { return Command(UpdateProject{std::make_shared<const Project>()}); };
  CommandQueue queue;
  queue.push(Command(TakeBody{"ice", 1}));
  queue.push(update());
  queue.push(Command(SetParameter{kDamping, 1.0}));
  queue.push(update());
  queue.push(Command(SetParameter{kDamping, 2.0}));
  QVERIFY(std::holds_alternative<TakeBody>(std::get<Command>(*queue.pop())));
  QVERIFY(std::holds_alternative<UpdateProject>(std::get<Command>(*queue.pop())));
  const auto last = queue.pop();
  QVERIFY(std::get<ParameterBatch>(*last)[0].value == Value(2.0));
  QVERIFY(queue.empty());
}

void TstSimulation::aMaterialsEditBakesOneTable() {
  Project project = scenes::iceOnPlate(4, 293.15);
  for (const char* id : {"wax", "tin"}) {
    SceneMaterial material;
    material.id = material.base = id;
    project.materials.push_back(material);
  }
  Engine engine(project, m_plugins);
  QCOMPARE(engine.bakedTables(), uint64_t{3});
  QVERIFY(engine.setParameter({Owner::Material, "water", "viscosity"}, Response(0.002)));
  QCOMPARE(engine.bakedTables(), uint64_t{4});
  QVERIFY(engine.setParameter({Owner::Wall, "floor", "temperature"}, 300.0));
  QVERIFY(engine.setParameter({Owner::Environment, "", "ambient_temperature"}, 300.0));
  engine.update(engine.project());
  engine.reset();
  QCOMPARE(engine.bakedTables(), uint64_t{4});
  QVERIFY(engine.setParameter({Owner::Environment, "", "ambient_pressure"}, 90000.0));
  QCOMPARE(engine.bakedTables(), uint64_t{7});
  // The tables are those of a scene that was built so.
  engine.reset();
  Engine fresh(engine.project(), m_plugins);
  for (int k = 0; k < 3; ++k) engine.step(), fresh.step();
  QCOMPARE(engine.solver().stateHash(), fresh.solver().stateHash());
}

/// One above the other at each moment in between, so that the first alone would be refused.
void TstSimulation::valuesThatDependOnEachOtherComeTogether() {
  Engine engine(scenes::iceOnPlate(4, 293.15), m_plugins);
  const SetParameter both[] = {{{Owner::Material, "water", "solidus"}, 280.0},
                               {{Owner::Material, "water", "liquidus"}, 285.0},
                               {{Owner::Material, "water", "melting_temperature"}, 282.0}};
  QVERIFY_THROWS_EXCEPTION(InputError, engine.setParameter(both[0].address, both[0].value));
  engine.setParameters(both);
  QVERIFY(findSet(engine.project(), both[0].address)->values.at("liquidus") == Value(285.0));
  const SetParameter wrong[] = {{kDamping, 0.5}, {{Owner::Material, "water", "solidus"}, 5000.0}};
  QVERIFY_THROWS_EXCEPTION(InputError, engine.setParameters(wrong));
  QVERIFY(!findSet(engine.project(), kDamping)->values.count("damping"));
}

void TstSimulation::aListOfCommandsRepeatsARun() {
  const auto body = std::make_shared<const Body>(sketchedWater());
  auto changed = std::make_shared<Project>(scenes::iceOnPlate(4, 350));
  changed->environment.gravity = {0, -5, 0};
  const VoxelShape lattice = std::get<VoxelShape>(body->shape);
  const std::vector<std::pair<uint64_t, Command>> log = {
      {1, SetParameter{kDamping, 0.5}},
      {2, AddCells{body, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0, 1}},
      {4, TakeMatter{1}},
      {5, TakeCells{lattice, {{0, -20, 0}, {0, -19, 0}}, {}, 2}},
      {6, UpdateProject{changed}},
      {7, PutBack{1}},
      {8, PutBack{2}},
      {9, TakeBody{"ice", 3}},
      {11, ReturnBody{nullptr, 3}},
      {12, ForgetMatter{{2}}},
      {14, Reset{{NameMatter{4, "ice", lattice, {{0, -20, 0}}}}}},
      {16, TakeMatter{4}},
  };
  const auto run = [&] {
    Engine engine(scenes::iceOnPlate(4, 350), m_plugins);
    auto next = log.begin();
    for (uint64_t frame = 0; frame < 20; ++frame) {
      for (; next != log.end() && next->first == frame; ++next) engine.apply(next->second);
      engine.step();
    }
    return engine.solver().stateHash();
  };
  QCOMPARE(run(), run());
}

void TstSimulation::aQueueOfEditsIsOneSnapshot() {
  std::atomic<int> published{0};
  EngineThread thread(m_plugins, [&] { ++published; });
  thread.open(scenes::iceOnPlate(4, 293.15), false);
  QVERIFY(waitFor([&] { return thread.snapshot() != nullptr; }));
  std::promise<void> go, waiting;
  thread.ask([&, wait = go.get_future().share()](const Engine&) {
    waiting.set_value();
    wait.wait();
  });
  waiting.get_future().wait();
  const int before = published;
  for (int k = 0; k < 200; ++k) {
    thread.setParameter(kDamping, 0.01 * k);
    thread.setParameter({Owner::Material, "water", "viscosity"}, Response(0.001 + 1e-6 * k));
  }
  go.set_value();
  QVERIFY(waitFor([&] { return published > before; }));
  std::promise<Value> damping;
  thread.ask([&](const Engine& e) { damping.set_value(findSet(e.project(), kDamping)->values.at("damping")); });
  QVERIFY(damping.get_future().get() == Value(1.99));
  QCOMPARE(published - before, 1);
  const EditCost cost = thread.editCost();
  QCOMPARE(cost.commands, uint64_t{400});
  QCOMPARE(cost.applied, uint64_t{1});
  QCOMPARE(cost.baked, uint64_t{1});
}

/// Four seconds of work wait in the queue; frames of 1/60 s go on in between.
void TstSimulation::editsDoNotStarveFrames() {
  std::atomic<int> done{0};
  EngineThread thread(m_plugins, {});
  thread.open(scenes::iceOnPlate(3, 293.15), true);
  QVERIFY(waitFor([&] { return thread.snapshot() && thread.snapshot()->stats.frame > 3; }));
  for (int k = 0; k < 800; ++k) {
    thread.setParameter(kDamping, 0.001 * k);
    thread.ask([&](const Engine&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      ++done;
    });
  }
  const uint64_t frame = thread.snapshot()->stats.frame;
  QVERIFY(waitFor([&] { return done > 200; }));
  QVERIFY(done < 700);
  // One frame's worth of edits, 4 of 5 ms, between two frames: 50 frames beside 200 of them, and half of it is enough.
  const uint64_t frames = thread.snapshot()->stats.frame - frame;
  QVERIFY2(frames > 25, std::to_string(frames).c_str());
}

void TstSimulation::threadTellsWhatCannotBeOpened() {
  EngineThread thread(m_plugins, {});
  Project project = scenes::iceOnPlate(5, 293.15);
  thread.open(project, false);
  QVERIFY(waitFor([&] { return thread.snapshot() != nullptr; }));
  const uint64_t before = thread.snapshot()->revision;
  project.bodies[0].material = "phlogiston";
  thread.open(project, true);
  QVERIFY(waitFor([&] { return !thread.events(0).empty(); }));
  const EngineEvent event = thread.events(0).back();
  QVERIFY(event.kind == EngineEvent::Kind::NotOpened);
  QVERIFY(event.message.find("phlogiston") != std::string::npos);
  // No scene at all, rather than the one before under the new one's name.
  QVERIFY(thread.snapshot()->id.empty() && !thread.snapshot()->bodyIds);
  QVERIFY(thread.snapshot()->revision != before);
  QVERIFY(!thread.playing());
}

void TstSimulation::snapshotsOfTwoRunsNeverCompare() {
  Engine a(scenes::iceOnPlate(4, 293.15), m_plugins), b(scenes::iceOnPlate(4, 293.15), m_plugins);
  QVERIFY(a.snapshot()->revision != b.snapshot()->revision);
  const uint64_t before = a.snapshot()->revision;
  a.reset();
  QVERIFY(a.snapshot()->revision != before);
}

void TstSimulation::viscosityIsCompiledAsDeclared() {
  Project project = scenes::iceOnPlate(2, 293.15);
  const SolverSettings plain = compileSettings(project), defaults;
  QCOMPARE(plain.viscosityModel, defaults.viscosityModel);
  QCOMPARE(plain.viscosityMax, defaults.viscosityMax);
  QCOMPARE(plain.viscosityTolerance, defaults.viscosityTolerance);
  QCOMPARE(plain.viscosityIterations, defaults.viscosityIterations);
  QVERIFY(compileWalls(project)[0].noSlip);
  auto& values = project.solver.parameters.values;
  values["viscosity_max"] = 12.0;
  values["viscosity_tolerance"] = 0.002;
  values["viscosity_iterations"] = 17.0;
  project.environment.walls[0].parameters.values["no_slip"] = false;
  for (const auto& [name, model] : {std::pair{"automatic", ViscosityModel::Automatic},
                                    {"xsph", ViscosityModel::Xsph},
                                    {"implicit", ViscosityModel::Implicit}}) {
    values["viscosity_model"] = std::string(name);
    QCOMPARE(compileSettings(project).viscosityModel, model);
  }
  QCOMPARE(compileSettings(project).viscosityMax, 12.0);
  QCOMPARE(compileSettings(project).viscosityTolerance, 0.002);
  QCOMPARE(compileSettings(project).viscosityIterations, 17);
  QVERIFY(!compileWalls(project)[0].noSlip);
}

QTEST_GUILESS_MAIN(TstSimulation)
#include "tst_simulation.moc"
