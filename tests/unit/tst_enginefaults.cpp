// SPDX-License-Identifier: Apache-2.0
// What an engine and its thread do when something fails: a plugin, an edit, a step. The fixtures are sound when they
// are loaded and fail later.
#include "core/base/error.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/enginethread.h"
#include "core/solver/solver.h"
#include "tests/shared/scenes.h"

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>
#include <atomic>

using namespace ps;
using Kind = EngineEvent::Kind;

namespace {

constexpr StepFlags kPluginFault = static_cast<StepFlags>(StepFlag::PluginFault);
const Address kDensity{Owner::Material, "lab", "density"};

/// Waits at most ten seconds, far longer than any frame of these scenes takes.
template <class Condition>
bool waitFor(Condition condition) {
  return QTest::qWaitFor(condition, 10000);
}

/// Liquid of the fixture's material, whose law fails for a density above 1500 kg/m3.
Project labScene() {
  Project project = scenes::iceOnPlate(4, 293.15);
  SceneMaterial lab;
  lab.id = "lab";
  lab.base = "fixture.material";
  lab.parameters.values["density"] = 1400.0;
  project.materials.push_back(lab);
  Body body = scenes::block("drop", 3, 0.03, {0, 0.4, 0}, 293.15);
  body.material = "lab";
  project.bodies.push_back(body);
  return project;
}

double massOf(Engine& engine, const std::string& body) {
  const auto& ids = engine.bodyIds();
  const auto index = static_cast<uint32_t>(std::find(ids.begin(), ids.end(), body) - ids.begin());
  const ParticleStore& store = engine.solver().particles();
  double mass = 0;
  for (size_t i = 0; i < store.size(); ++i) mass += store.body()[i] == index ? store.mass()[i] : 0;
  return mass;
}

const PluginInfo* infoOf(const PluginRegistry& registry, const std::string& id) {
  const auto& all = registry.plugins();
  const auto found = std::find_if(all.begin(), all.end(), [&](const PluginInfo& info) { return info.id == id; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<EngineEvent> ofKind(const EngineThread& thread, Kind kind) {
  std::vector<EngineEvent> events = thread.events(0);
  std::erase_if(events, [&](const EngineEvent& event) { return event.kind != kind; });
  return events;
}

}  // namespace

class TstEngineFaults : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void aPluginThatThrowsPausesAndIsNamed();
  void aPluginThatDoesNotComeBackIsNamed();
  void aLawThatThrowsLeavesTheMatterAsItIs();
  void aLawThatThrowsPausesTheScene();
  void aRefusedEditIsToldWhileTheSceneGoesOn();
  void oldEventsAreForgotten();
  void whateverIsThrownTheThreadGoesOn();
  void aStepThatThrowsPausesTheScene();
  void aFlagInEveryFrameIsToldOnce();

 private:
  /// The program's plugins and one fixture, under the name that makes it fail as it should.
  PluginRegistry::Options with(const QString& fixture, const QString& name) {
    const QString folder = m_scratch.filePath(QString::fromLatin1(QTest::currentTestFunction()));
    QDir().mkpath(folder);
    QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + "/" + fixture + ".so", folder + "/" + name + ".so");
    PluginRegistry::Options options;
    options.extraPaths = {folder.toStdString()};
    return options;
  }
  QTemporaryDir m_scratch;
  PluginRegistry m_plugins;
};

void TstEngineFaults::initTestCase() {
  QVERIFY(m_scratch.isValid());
  QVERIFY2(QFile::exists(qEnvironmentVariable("PS_FIXTURE_DIR") + "/fixture_material.so"),
           "PS_FIXTURE_DIR must name the fixtures");
}

void TstEngineFaults::aPluginThatThrowsPausesAndIsNamed() {
  PluginRegistry plugins(with("fixture_constraint", "throwing_topology"));
  QVERIFY(plugins.constraint("fixture.constraint"));
  Project project = scenes::iceOnPlate(4, 293.15);
  project.bodies[0].constraints.push_back({"fixture.constraint", {}, {}});
  EngineThread thread(plugins, {});
  thread.open(project, true);
  QVERIFY(waitFor([&] { return !thread.events(0).empty(); }));
  const EngineEvent event = thread.events(0).front();
  QVERIFY(event.kind == Kind::Step && event.flags == kPluginFault);
  QVERIFY2(event.message.find("fixture.constraint") != std::string::npos, event.message.c_str());
  QVERIFY(!thread.playing());
  const PluginInfo* info = infoOf(plugins, "fixture.constraint");
  QVERIFY(info && info->state == PluginInfo::State::Refused);
  QVERIFY2(info->problem.find("no more bonds") != std::string::npos, info->problem.c_str());
  // It goes on without it, for good, and what was told is over when it has done so for a while.
  thread.play();
  QVERIFY(waitFor([&] { return thread.snapshot()->stats.frame > 70; }));
  const auto events = thread.events(1);
  QCOMPARE(events.size(), size_t{1});
  QVERIFY(events[0].kind == Kind::Settled);
  thread.reset();
  thread.play();
  QVERIFY(waitFor([&] { return thread.snapshot()->stats.frame < 70; }));
  QVERIFY(waitFor([&] { return thread.snapshot()->stats.frame > 5; }));
  QVERIFY(thread.events(2).empty());
}

/// Ten seconds are what a plugin may take.
void TstEngineFaults::aPluginThatDoesNotComeBackIsNamed() {
  qputenv("XDG_STATE_HOME", m_scratch.filePath("state").toUtf8());
  const PluginRegistry::Options options = with("fixture_constraint", "endless_step");
  const auto stateNow = [&] {
    const PluginRegistry registry(options);
    const PluginInfo* info = infoOf(registry, "fixture.constraint");
    return info ? info->state : PluginInfo::State::Refused;
  };
  PluginRegistry plugins(options);
  QVERIFY(plugins.constraint("fixture.constraint"));
  Project project = scenes::iceOnPlate(4, 293.15);
  project.bodies[0].constraints.push_back({"fixture.constraint", {}, {}});
  EngineThread thread(plugins, {});
  thread.open(project, true);
  const bool late = QTest::qWaitFor([&] { return !thread.events(0).empty(); }, 30000);
  const EngineEvent event = late ? thread.events(0).back() : EngineEvent{};
  const auto meanwhile = stateNow();
  qputenv("PS_LET_GO", "1");  // before anything can fail: the thread would never end
  QVERIFY(late && event.kind == Kind::Late);
  QCOMPARE(event.message, std::string("fixture.constraint"));
  QVERIFY(meanwhile == PluginInfo::State::Quarantined);
  QVERIFY(waitFor([&] { return !ofKind(thread, Kind::Settled).empty(); }));
  QVERIFY(waitFor([&] { return thread.snapshot()->stats.frame > 3; }));
  QVERIFY(stateNow() == PluginInfo::State::Loaded);
  qunsetenv("XDG_STATE_HOME");
}

void TstEngineFaults::aLawThatThrowsLeavesTheMatterAsItIs() {
  PluginRegistry plugins(with("fixture_material", "late"));
  QVERIFY(plugins.materialPlugin("fixture.material"));
  Engine engine(labScene(), plugins), untouched(labScene(), plugins);
  const double mass = massOf(engine, "drop");
  // 1400 kg/m3 less 0.1 kg/(m3 K) times 293.15 K; interpolated between samples to far less than 1e-6, mass is a float.
  QVERIFY2(std::abs(mass / (27 * 0.03 * 0.03 * 0.03 * (1400 - 29.315)) - 1) < 1e-6, std::to_string(mass).c_str());
  QVERIFY_THROWS_EXCEPTION(PluginError, engine.setParameter(kDensity, 1800.0));
  QVERIFY(!plugins.material("fixture.material"));
  for (int i = 0; i < 3; ++i) {
    QCOMPARE(engine.step().flags, 0u);
    untouched.step();
  }
  QCOMPARE(engine.solver().stateHash(), untouched.solver().stateHash());
  // The scene's own changes act, other parameters of the plugin cannot.
  QVERIFY(engine.setParameter({Owner::Material, "lab", "viscosity"}, Response(0.5)));
  QVERIFY(engine.setParameter(kDensity, 1400.0));
  QVERIFY_THROWS_EXCEPTION(PluginError, engine.setParameter(kDensity, 1300.0));
  engine.reset();
  QCOMPARE(massOf(engine, "drop"), mass);
}

void TstEngineFaults::aLawThatThrowsPausesTheScene() {
  PluginRegistry plugins(with("fixture_material", "late"));
  EngineThread thread(plugins, {});
  thread.open(labScene(), true);
  thread.setParameter(kDensity, 1800.0);
  QVERIFY(waitFor([&] { return !thread.events(0).empty(); }));
  const EngineEvent event = thread.events(0).front();
  QVERIFY(event.kind == Kind::Refused && event.flags == kPluginFault);
  QVERIFY2(event.message.find("too dense") != std::string::npos, event.message.c_str());
  QVERIFY(!thread.playing());
}

void TstEngineFaults::aRefusedEditIsToldWhileTheSceneGoesOn() {
  EngineThread thread(m_plugins, {});
  thread.open(scenes::iceOnPlate(4, 293.15), true);
  const Address solidus{Owner::Material, "water", "solidus"};
  thread.setParameter(solidus, 5000.0);
  QVERIFY(waitFor([&] { return !thread.events(0).empty(); }));
  const uint64_t frame = thread.snapshot()->stats.frame;
  QVERIFY(waitFor([&] { return thread.snapshot()->stats.frame > frame + 70; }));  // longer than flags are kept
  QVERIFY(thread.playing());
  QCOMPARE(thread.events(0).size(), size_t{1});
  const EngineEvent event = thread.events(0).front();
  QVERIFY(event.kind == Kind::Refused && event.flags == 0);
  QVERIFY2(event.message.find("solidus") != std::string::npos, event.message.c_str());
  thread.setParameter({Owner::Solver, "", "damping"}, 0.1);
  QVERIFY(waitFor([&] { return !thread.events(event.number + 1).empty(); }));
  QVERIFY(thread.events(event.number + 1).front().kind == Kind::Settled);
}

void TstEngineFaults::oldEventsAreForgotten() {
  EngineThread thread(m_plugins, {});
  thread.open(scenes::iceOnPlate(3, 293.15), false);
  for (int i = 0; i < 300; ++i) {
    thread.ask([i](const Engine&) { throw InputError("number " + std::to_string(i)); });
  }
  QVERIFY(waitFor([&] { return thread.events(299).size() == 1; }));
  const auto events = thread.events(0);
  QVERIFY(events.size() < 300 && events.size() > 100);
  QCOMPARE(events.back().message, std::string("number 299"));
  QCOMPARE(events.front().number, 300 - events.size());
}

void TstEngineFaults::whateverIsThrownTheThreadGoesOn() {
  EngineThread thread(m_plugins, {});
  thread.open(scenes::iceOnPlate(3, 293.15), false);
  thread.ask([](const Engine&) { throw 7; });
  thread.ask([](const Engine&) { throw std::bad_alloc(); });
  QVERIFY(waitFor([&] { return ofKind(thread, Kind::Refused).size() == 2; }));
  QVERIFY(ofKind(thread, Kind::Refused)[1].message.find("memory") != std::string::npos);
  thread.stepOnce();
  QVERIFY(waitFor([&] { return thread.snapshot()->stats.frame == 1; }));
}

void TstEngineFaults::aStepThatThrowsPausesTheScene() {
  std::atomic<bool> armed{false};
  EngineThread thread(m_plugins, [&] {
    if (armed.exchange(false)) throw std::runtime_error("nobody listens");
  });
  thread.open(scenes::iceOnPlate(3, 293.15), true);
  QVERIFY(waitFor([&] { return thread.snapshot() && thread.snapshot()->stats.frame > 3; }));
  armed = true;
  QVERIFY(waitFor([&] { return !thread.events(0).empty(); }));
  QVERIFY(!thread.playing());
  const EngineEvent event = thread.events(0).front();
  QVERIFY(event.kind == Kind::Stopped);
  QCOMPARE(event.message, std::string("nobody listens"));
  const uint64_t frame = thread.snapshot()->stats.frame;
  thread.play();
  QVERIFY(waitFor([&] { return thread.snapshot()->stats.frame > frame + 70; }));
  QVERIFY(thread.events(1).front().kind == Kind::Settled);
}

void TstEngineFaults::aFlagInEveryFrameIsToldOnce() {
  Project project = scenes::iceOnPlate(3, 293.15);
  project.environment.walls.clear();
  project.environment.boundsMinimum[1] = 0.02;  // it falls on the bounds, again in every frame
  EngineThread thread(m_plugins, {});
  thread.open(project, true);
  QVERIFY(waitFor([&] { return thread.snapshot() && thread.snapshot()->stats.frame > 130; }));
  const auto steps = ofKind(thread, Kind::Step);
  QCOMPARE(steps.size(), size_t{1});
  QCOMPARE(steps[0].flags, static_cast<StepFlags>(StepFlag::LostParticle));
  thread.setParameter({Owner::Solver, "", "damping"}, 0.1);  // does not mend it
  thread.pause();
  thread.apply(ForgetMatter{});
  thread.reset();
  QVERIFY(waitFor([&] { return thread.snapshot()->stats.frame == 0; }));
  QVERIFY(waitFor([&] { return !ofKind(thread, Kind::Settled).empty(); }));
  QCOMPARE(ofKind(thread, Kind::Settled).size(), size_t{1});
}

QTEST_GUILESS_MAIN(TstEngineFaults)
#include "tst_enginefaults.moc"
