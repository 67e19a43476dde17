// SPDX-License-Identifier: Apache-2.0
// Scene to engine and back: what a project compiles to, what an edit touches, and what the engine's thread promises.
#include "core/base/error.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/compile.h"
#include "core/simulation/engine.h"
#include "core/simulation/lattice.h"
#include "tests/shared/scenes.h"

#include <QTest>

#include <algorithm>
#include <atomic>
#include <future>

using namespace ps;

class TstSimulation : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void boxFillsItsSize_data();
  void boxFillsItsSize();
  void bornAsDeclared();
  void anEditActsOnTheNextFrame();
  void anEditOfTheSceneSurvivesReset();
  void spacingActsAtTheNextReset();
  void refusedEditsLeaveTheSceneAsItWas();
  void cellsAvoidLiveParticlesAndComeBackOut();
  void takenMatterComesBackAsItWas();
  void aMissingMaterialStandsStill();
  void probesReadWhatTheyName();
  void runsWithoutAnyPlugin();
  void viscosityIsCompiledAsDeclared();
  void threadPlaysPausesStepsAndResets();
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
  QVERIFY(warmed.setParameter({"wall", "floor", "temperature"}, 400.0));
  cold.step();
  warmed.step();
  QVERIFY(warmed.stats().thermalEnergy > cold.stats().thermalEnergy);
  QVERIFY(warmed.stats().heat.walls > 0);
}

void TstSimulation::anEditOfTheSceneSurvivesReset() {
  Engine engine(scenes::iceOnPlate(5, 293.15), m_plugins);
  QVERIFY(!engine.setParameter({"body", "ice", "temperature"}, 253.15));
  QVERIFY(std::abs(engine.stats().temperatureMean - 263.15) < 1e-6);
  engine.reset();
  QVERIFY(std::abs(engine.stats().temperatureMean - 253.15) < 1e-6);
}

void TstSimulation::spacingActsAtTheNextReset() {
  Engine engine(scenes::iceOnPlate(6, 293.15), m_plugins);
  QVERIFY(!engine.setParameter({"solver", "", "particle_spacing"}, 0.06));
  QVERIFY(engine.setParameter({"solver", "", "damping"}, 0.1));
  for (int i = 0; i < 20; ++i) QCOMPARE(engine.step().flags, 0u);
  const FrameStats stats = engine.stats();  // twice the spacing among living particles would blow the block apart
  QVERIFY2(stats.kineticEnergy < 1, qPrintable(QString::number(stats.kineticEnergy)));
  engine.reset();
  QCOMPARE(engine.solver().particles().size(), size_t{27});
}

void TstSimulation::refusedEditsLeaveTheSceneAsItWas() {
  Engine engine(scenes::iceOnPlate(5, 293.15), m_plugins), untouched(scenes::iceOnPlate(5, 293.15), m_plugins);
  QVERIFY_THROWS_EXCEPTION(InputError, engine.setParameter({"material", "water", "solidus"}, 5000.0));
  Project broken = engine.project();
  broken.environment.walls[0].normal = {0, 0, 0};
  QVERIFY_THROWS_EXCEPTION(InputError, engine.update(broken));
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
  engine.removeParticles(ids);
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
  const TakenMatter taken = engine.takeParticles(ids);
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
  project.materials.push_back({"odd", "Odd", "not-installed", {}, {}, {}});
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
  std::promise<std::vector<uint32_t>> born;
  thread.addCells(sketchedWater(), {{0, 0, 0}}, 0, [&](auto ids) { born.set_value(ids); });
  QCOMPARE(born.get_future().get().size(), size_t{1});
  QVERIFY(published > 5);
}

void TstSimulation::threadTellsWhatCannotBeOpened() {
  EngineThread thread(m_plugins, {});
  Project project = scenes::iceOnPlate(5, 293.15);
  thread.open(project, false);
  QVERIFY(waitFor([&] { return thread.snapshot() != nullptr; }));
  const size_t before = thread.snapshot()->id.size();
  project.bodies[0].material = "phlogiston";
  thread.open(project, true);
  QVERIFY(waitFor([&] { return !thread.snapshot()->message.empty(); }));
  QVERIFY(thread.snapshot()->message.find("phlogiston") != std::string::npos);
  QCOMPARE(thread.snapshot()->id.size(), before);  // the scene that was open stays
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
