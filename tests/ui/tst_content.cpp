// SPDX-License-Identifier: Apache-2.0
// What comes into a scene and leaves it, without a window: bodies with their matter, materials, structure.
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/scene/pose.h"
#include "core/simulation/compile.h"
#include "core/simulation/engine.h"
#include "core/simulation/enginethread.h"
#include "core/simulation/graphsource.h"
#include "tests/shared/enginehands.h"
#include "tests/shared/scenes.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/wallside.h"
#include "ui/session/documentfiles.h"
#include "ui/session/excerpt.h"
#include "ui/session/scenelink.h"
#include "ui/session/transitions.h"
#include "ui/session/worker.h"

#include <QtCore/QTemporaryDir>
#include <QtTest/QTest>

#include <cmath>
#include <functional>
#include <future>
#include <map>
#include <memory>

using namespace ps;
using tests::onEngine;

namespace {

/// Heights by ids: the same matter in the same places.
std::map<uint32_t, float> matterNow(EngineThread& engine) {
  return onEngine<std::map<uint32_t, float>>(engine, [](Engine& e) {
    const ParticleStore& store = e.solver().particles();
    std::map<uint32_t, float> matter;
    for (size_t i = 0; i < store.size(); ++i) matter[store.id()[i]] = static_cast<float>(store.position()[i].y);
    return matter;
  });
}

size_t countNow(EngineThread& engine) { return matterNow(engine).size(); }

/// Frame and number of constraints.
std::pair<uint64_t, size_t> clockAndStructure(EngineThread& engine) {
  return onEngine<std::pair<uint64_t, size_t>>(
      engine, [](Engine& e) { return std::pair(e.solver().frame(), e.solver().constraintCount()); });
}

void step(EngineThread& engine, int frames) {
  onEngine<int>(engine, [frames](Engine& e) {
    for (int k = 0; k < frames; ++k) e.step();
    return 0;
  });
}

}  // namespace

class TestContent : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    PluginRegistry::Options options;
    options.extraPaths = {m_fixtures.path().toStdString()};
    for (const char* name : {"fixture_neighbour.so", "fixture_source.so"})
      QVERIFY(QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + "/" + name, m_fixtures.filePath(name)));
    m_plugins = std::make_unique<PluginRegistry>(options);
  }
  void init() {
    m_document = std::make_unique<Document>();
    m_document->setPlugins(m_plugins.get());
    m_engine = std::make_unique<EngineThread>(*m_plugins, [] {});
    m_link = std::make_unique<SceneLink>(*m_document, *m_engine);
    Project project = scenes::iceOnPlate(5, 370);
    project.bodies.push_back(scenes::block("second", 2, 0.03, {0, 0.5, 0}, 263.15));
    m_document->open(project, {}, false, false);
  }
  void cleanup() {
    m_link.reset();
    m_engine.reset();
    m_document.reset();
  }

  /// What legends mark is of the first material that there is any of.
  void changesOfPhaseAreOfWhatIsThere() {
    constexpr double kIce = 273.15, kTin = 505.08;  // K
    Transitions transitions(*m_document);
    Body ingot = scenes::block("ingot", 2, 0.03, {0.3, 0.5, 0}, 293.15);
    ingot.material = m_document->addMaterial("tin");
    ingot.constraints.clear();
    const std::string id = m_document->addBody(ingot);
    QVERIFY(std::abs(transitions.melts() - kIce) < 0.1);
    for (const char* body : {"ice", "second"}) QCOMPARE(m_document->removeBody(body), QString());
    QVERIFY2(std::abs(transitions.melts() - kTin) < 0.5, qPrintable(QString::number(transitions.melts())));
    QCOMPARE(m_document->removeBody(id), QString());
    QVERIFY(std::abs(transitions.melts() - kIce) < 0.1);  // of what is drawn with first
    m_document->undoStack().undo();
    QVERIFY(std::abs(transitions.melts() - kTin) < 0.5);
    m_document->undoStack().undo();
    QVERIFY(std::abs(transitions.melts() - kIce) < 0.1);
  }

  void aDeletedBodyComesBackWhole_data() {
    QTest::addColumn<int>("frames");
    QTest::addColumn<bool>("reset");
    QTest::newRow("at once") << 0 << false;
    QTest::newRow("after it has moved") << 5 << false;
    QTest::newRow("after a reset without it") << 5 << true;
  }
  void aDeletedBodyComesBackWhole() {
    QFETCH(int, frames);
    QFETCH(bool, reset);
    step(*m_engine, frames);
    const std::string before = text();
    const auto matter = matterNow(*m_engine);
    const auto structure = clockAndStructure(*m_engine).second;
    QCOMPARE(m_document->removeBody("ice"), QString());
    QVERIFY(!m_document->body("ice"));
    QCOMPARE(countNow(*m_engine), size_t{8});
    if (reset) {
      m_link->reset();
      QCOMPARE(countNow(*m_engine), size_t{8});
    }
    m_document->undoStack().undo();
    QCOMPARE(text(), before);
    QCOMPARE(m_document->project().bodies.front().id, std::string("ice"));
    QCOMPARE(countNow(*m_engine), matter.size());
    QCOMPARE(clockAndStructure(*m_engine).second, structure);
    if (!reset) QVERIFY(matterNow(*m_engine) == matter);
    m_document->undoStack().redo();
    QCOMPARE(countNow(*m_engine), size_t{8});
  }

  /// A tap is found by its name, its sliders act while it runs, and what it pours stays in the scene's materials.
  void aTapIsTurnedLive() {
    Project project = scenes::iceOnPlate(3, 293.15);
    Emitter tap;
    tap.id = "tap";
    tap.name = "Cold tap";
    tap.material = "water";
    tap.point = {0, 0.8, 0};
    project.emitters.push_back(tap);
    project.bodies.clear();
    m_document->open(project, {}, false, false);
    const Address speed{Owner::Emitter, "tap", "speed"};
    const std::vector<Address> all = allAddresses(m_document->project(), m_plugins.get());
    QVERIFY(std::find(all.begin(), all.end(), speed) != all.end());
    QCOMPARE(awayLabel(m_document->project(), speed, QStringLiteral("Speed")), QStringLiteral("Cold tap speed"));
    QVERIFY(m_document->whyMaterialStays("water").contains(QStringLiteral("Cold tap")));
    m_document->setParameter(speed, 0.0);
    step(*m_engine, 20);
    QCOMPARE(countNow(*m_engine), size_t{0});  // shut from the start
    m_document->undoStack().undo();
    step(*m_engine, 20);
    QVERIFY(countNow(*m_engine) > 0);
  }

  /// What a tap has poured goes with it, undone or deleted, and comes back with it.
  void anUndoneTapLeavesNoMatter() {
    Project project = scenes::iceOnPlate(3, 293.15);
    m_document->open(project, {}, false, false);
    const auto bodies = countNow(*m_engine);
    Emitter tap;
    tap.material = "water";
    tap.point = {0, 0.8, 0};
    const Port port = m_document->addEmitter(tap);
    step(*m_engine, 30);
    const auto ofTap = [&] {
      return onEngine<size_t>(*m_engine, [&](Engine& e) {
        const ParticleStore& store = e.solver().particles();
        size_t count = 0;
        for (size_t i = 0; i < store.size(); ++i) count += e.bodyIds().at(store.body()[i]) == port.id;
        return count;
      });
    };
    const auto poured = onEngine<uint64_t>(*m_engine, [](Engine& e) { return e.stats().flow.poured.count; });
    QVERIFY(poured > 0 && ofTap() >= poured);
    m_document->undoStack().undo();
    QCOMPARE(ofTap(), size_t{0});
    QCOMPARE(countNow(*m_engine), bodies);
    m_document->undoStack().redo();
    QCOMPARE(ofTap(), static_cast<size_t>(poured));
    step(*m_engine, 10);
    QVERIFY(ofTap() > poured);
    m_document->removePort(port);
    QCOMPARE(ofTap(), size_t{0});
    QCOMPARE(countNow(*m_engine), bodies);
    m_document->undoStack().undo();
    QVERIFY(ofTap() >= poured);
  }

  /// What animates it and what measures it alone goes with a body, in one step; probes of more stay. Undone, each is in
  /// its place among the others, and in the graphs that showed it.
  void aDeletedBodyTakesAlongWhatIsItsOwn() {
    for (const auto& [name, body] :
         {std::pair("of ice", "ice"), {"of second", "second"}, {"of all", ""}, {"of ice too", "ice"}}) {
      Probe probe;
      probe.id = probe.name = name;
      probe.quantity = "temperature";
      probe.body = body;
      m_document->addProbe(probe);
    }
    for (const char* probe : {"of ice", "of all", "of ice too"}) m_document->plot({}, probeSource(probe));
    const Address power{Owner::Body, "ice", "heating_power"}, floor{Owner::Wall, "floor", "temperature"};
    const Address surface{Owner::Body, "ice", "surface_area"};
    QCOMPARE(m_document->putKey(power, 0, 100), QString());
    QCOMPARE(m_document->putKey(floor, 0, 350), QString());
    QCOMPARE(m_document->putKey(surface, 0, 0.01), QString());
    const std::string before = text();
    const int steps = m_document->undoStack().count();
    QCOMPARE(m_document->removeBody("ice"), QString());
    QCOMPARE(m_document->undoStack().count(), steps + 1);
    QCOMPARE(m_document->project().tracks.size(), size_t{1});
    QVERIFY(m_document->track(floor));
    for (const Probe& probe : m_document->project().probes) QVERIFY(probe.body != "ice");
    QVERIFY(!m_document->probe("of ice") && m_document->probe("of second") && m_document->probe("of all"));
    m_document->undoStack().undo();
    QCOMPARE(text(), before);
    m_document->undoStack().redo();
    QVERIFY(!m_document->track(power) && !m_document->probe("of ice"));
  }

  /// So do walls, taps, drains and materials, each in one step; what is of others stays.
  void whateverIsDeletedTakesAlongWhatIsItsOwn() {
    QCOMPARE(m_document->addMaterial("wax"), std::string("wax"));
    m_document->removeProbe("ice core");
    Emitter pouring;
    pouring.material = "water";
    pouring.point = {0, 0.8, 0};
    const Port tap = m_document->addEmitter(pouring), drain = m_document->addSink({});
    const auto probe = [&](const char* id, const char* quantity, std::string Probe::*of, const std::string& thing) {
      Probe made;
      made.id = made.name = id;
      made.quantity = quantity;
      made.*of = thing;
      m_document->addProbe(made);
    };
    probe("of the body", "temperature", &Probe::body, "ice");
    probe("of the tap", "temperature", &Probe::body, tap.id);
    probe("of the wall", "force_y", &Probe::wall, "floor");
    probe("of the material", "temperature", &Probe::material, "wax");
    const Address power{Owner::Body, "ice", "heating_power"}, floor{Owner::Wall, "floor", "temperature"};
    const Address speed{Owner::Emitter, tap.id, "speed"}, open{Owner::Sink, drain.id, "open"};
    const Address conducts{Owner::Material, "wax", "conductivity_solid"};
    for (const auto& [parameter, value] : {std::pair(power, 100.0), std::pair(floor, 350.0), std::pair(speed, 0.5),
                                           std::pair(open, 1.0), std::pair(conducts, 0.5)})
      QCOMPARE(m_document->putKey(parameter, 0, value), QString());
    const auto goes = [&](const Address& parameter, const char* itsProbe, const auto& removal) {
      const std::string before = text();
      const int steps = m_document->undoStack().count();
      const size_t keys = m_document->project().tracks.size(), probes = m_document->project().probes.size();
      removal();
      QCOMPARE(m_document->undoStack().count(), steps + 1);
      QVERIFY2(!m_document->track(parameter), parameter.text().c_str());
      QCOMPARE(m_document->project().tracks.size(), keys - 1);
      QCOMPARE(m_document->project().probes.size(), probes - (*itsProbe ? 1 : 0));
      QVERIFY(!m_document->probe(itsProbe));
      m_document->undoStack().undo();
      QCOMPARE(text(), before);
      m_document->undoStack().redo();
      QVERIFY(!m_document->track(parameter) && !m_document->probe(itsProbe));
    };
    goes(floor, "of the wall", [&] { m_document->removeWall("floor"); });
    goes(speed, "of the tap", [&] { m_document->removePort(tap); });
    goes(open, "", [&] { m_document->removePort(drain); });
    goes(conducts, "of the material", [&] { QCOMPARE(m_document->removeMaterial("wax"), QString()); });
    goes(power, "of the body", [&] { QCOMPARE(m_document->removeBody("ice"), QString()); });
    QVERIFY(m_document->project().tracks.empty() && m_document->project().probes.empty());
  }

  /// A file with a probe on a body that is gone still opens.
  void aFileWithoutTheBodyOfAProbeOpens() {
    Project without = m_document->project();
    std::erase_if(without.bodies, [](const Body& body) { return body.id == "ice"; });
    const LoadedProject loaded = parseProject(writeProject(without), "scene.json", *m_plugins);
    QCOMPARE(loaded.project.bodies.size(), size_t{1});
    QCOMPARE(loaded.warnings.size(), size_t{1});
    QVERIFY(loaded.warnings[0].text.find("measures nothing") != std::string::npos);
  }

  void aLockedBodyStays() {
    m_document->setLocked({{Owner::Body, "ice", ""}}, true);
    const int steps = m_document->undoStack().count();
    QVERIFY(m_document->removeBody("ice").contains(QStringLiteral("is locked")));
    QVERIFY(m_document->body("ice"));
    QCOMPARE(m_document->undoStack().count(), steps);
  }

  /// The strokes of a sketched body know their particles again after it went, a reset, and it came back.
  void strokesOfADeletedBodyCanStillBeUndone() {
    const size_t before = countNow(*m_engine);
    paint();
    QCOMPARE(countNow(*m_engine), before + 27);
    m_document->removeBody("drops");
    m_link->reset();
    QCOMPARE(countNow(*m_engine), before);
    m_document->undoStack().undo();
    QCOMPARE(countNow(*m_engine), before + 27);
    m_document->undoStack().undo();
    QCOMPARE(countNow(*m_engine), before);
    QVERIFY(!m_document->body("drops"));
  }

  void whatIsInsertedHasIdsOfItsOwn() {
    const size_t before = countNow(*m_engine);
    const auto insert = [&](const char* id) {
      Project things = excerptOf(m_document->project(), {{OutlineKind::Body, id}});
      for (Body& body : things.bodies) body = moved(body, {Quaternion::Identity(), {0, 0.12, 0}});
      return m_document->insertThings(things, QStringLiteral("copy"));
    };
    const Placement come = insert("second");
    QCOMPARE(come.bodies.at(0).id, std::string("second-2"));
    QCOMPARE(countNow(*m_engine), before + 8);
    QCOMPARE(m_document->project().bodies.at(2).id, std::string("second-2"));
    m_document->undoStack().undo();
    QCOMPARE(countNow(*m_engine), before);
    // Matter of the copy may come back by redo: another one is not mistaken for it.
    QCOMPARE(insert("second").bodies.at(0).id, std::string("second-3"));
    m_document->undoStack().undo();
    paint();
    insert("drops");
    QCOMPARE(countNow(*m_engine), before + 54);
    m_link->reset();
    QCOMPARE(countNow(*m_engine), before + 54);
  }

  /// What a stroke has made is taken by its undo, though its body has been moved and made anew since.
  void aStrokeIsUndoneAfterItsBodyWasMoved() {
    const size_t before = countNow(*m_engine);
    paint();
    QCOMPARE(countNow(*m_engine), before + 27);
    const RigidMove move = possibleMove(*m_document->body("drops"), {Quaternion::Identity(), {0, 0.1, 0}});
    Placement there;
    there.bodies.push_back(moved(*m_document->body("drops"), move));
    m_document->place(there, QStringLiteral("moving"));
    m_link->reset();
    QCOMPARE(countNow(*m_engine), before + 27);
    m_document->undoStack().undo();
    m_document->undoStack().undo();
    QCOMPARE(countNow(*m_engine), before);
  }

  void aMaterialComesAndGoesWhileItRuns() {
    step(*m_engine, 3);
    const std::string before = text();
    const std::string wax = m_document->addMaterial("wax");
    QCOMPARE(wax, std::string("wax"));
    QCOMPARE(m_document->project().materials.back().label, m_plugins->material("wax")->label);
    QVERIFY(text().find("\"base\": \"wax\"") != std::string::npos);
    QCOMPARE(m_document->addMaterial("wax"), wax);  // it is there
    QCOMPARE(m_document->undoStack().count(), 1);
    paint("wax");
    QCOMPARE(countNow(*m_engine), size_t{125 + 8 + 27});
    QVERIFY(m_document->whyMaterialStays(wax).contains(QStringLiteral("drops")));
    QVERIFY(!m_document->removeMaterial(wax).isEmpty());
    QCOMPARE(m_document->undoStack().count(), 2);
    m_document->undoStack().undo();
    m_document->undoStack().undo();
    QCOMPARE(text(), before);
    QCOMPARE(countNow(*m_engine), size_t{125 + 8});
    QCOMPARE(clockAndStructure(*m_engine).first, uint64_t{3});  // the run goes on
    m_document->undoStack().redo();
    m_document->undoStack().redo();
    QCOMPARE(countNow(*m_engine), size_t{125 + 8 + 27});
    m_link->reset();
    QCOMPARE(countNow(*m_engine), size_t{125 + 8 + 27});
  }

  /// Matter keeps its substance when a material before it leaves the scene, now and after a reset.
  void anUnusedMaterialLeaves() {
    Project project = m_document->project();
    SceneMaterial wax;
    wax.id = wax.base = "wax";
    project.materials.insert(project.materials.begin(), wax);
    m_document->open(project, {}, false, false);
    const auto ofWater = [this] {
      return onEngine<bool>(*m_engine, [](Engine& e) {
        const ParticleStore& store = e.solver().particles();
        for (size_t i = 0; i < store.size(); ++i) {
          if (e.project().materials.at(store.material()[i]).id != "water") return false;
        }
        return store.size() > 0;
      });
    };
    QVERIFY(ofWater());
    QCOMPARE(m_document->removeMaterial("wax"), QString());
    QVERIFY(ofWater());
    QCOMPARE(m_document->setParameter({Owner::Scene, "", "gravity"}, 5.0), QString());
    m_link->reset();
    QVERIFY(ofWater());
    QCOMPARE(onEngine<size_t>(*m_engine, [](Engine& e) { return e.project().materials.size(); }), size_t{1});
    m_document->undoStack().undo();
    m_document->undoStack().undo();
    QCOMPARE(m_document->project().materials.front().id, std::string("wax"));
    QVERIFY(ofWater());
    QVERIFY(m_document->whyMaterialStays("water").contains(QStringLiteral("ice")));
  }

  /// A file may leave a name out, but a sentence about it may not.
  void whatHasNoNameIsCalledByItsId() {
    Project project = scenes::iceOnPlate(2, 370);
    project.bodies.front().name.clear();
    m_document->open(project, {}, false, false);
    QCOMPARE(m_document->whyMaterialStays("water"), QStringLiteral("“ice” is of it"));
  }

  void wallsComeAndGoWhileItRuns() {
    const auto wallsNow = [&] {
      return onEngine<size_t>(*m_engine, [](Engine& e) { return e.project().environment.walls.size(); });
    };
    Project open = m_document->project();
    std::erase_if(open.environment.walls, [](const SceneWall& wall) { return wall.normal[0] != 0; });
    m_document->open(open, {}, false, false);
    step(*m_engine, 3);
    const std::string before = text();
    const size_t walls = wallsNow();
    QCOMPARE(m_document->addWalls(kUprightSides), QString());
    QCOMPARE(m_document->undoStack().count(), 1);
    constexpr size_t kAdded = 2;  // front and back stand
    QCOMPARE(wallsNow(), walls + kAdded);
    const SceneWall* left = m_document->wall("left");
    QVERIFY(left && left->point[0] > m_document->project().environment.boundsMinimum[0]);
    QCOMPARE(left->normal, (Vector3{1, 0, 0}));
    QVERIFY(!hasTemperature(*left));
    QVERIFY(m_document->addWalls({"left"}).contains(QStringLiteral("Left side")));  // it stands there already
    QCOMPARE(m_document->undoStack().count(), 1);
    QCOMPARE(parseProject(text(), "scene.json", *m_plugins).project.environment.walls.size(), walls + kAdded);
    m_document->removeWall("left");
    QCOMPARE(wallsNow(), walls + kAdded - 1);
    m_document->undoStack().undo();
    m_document->undoStack().undo();
    QCOMPARE(text(), before);
    QCOMPARE(wallsNow(), walls);
    QCOMPARE(clockAndStructure(*m_engine).first, uint64_t{3});  // the run goes on
  }

  void noWallCrossesWhatRepeats() {
    Project project = m_document->project();
    project.environment.periodic[0] = true;
    std::erase_if(project.environment.walls, [](const SceneWall& wall) { return wall.normal[0] != 0; });
    m_document->open(project, {}, false, false);
    QVERIFY(m_document->addWalls({"left"}).contains(QStringLiteral("along x")));
    QVERIFY(!m_document->wall("left"));
  }

  /// Nothing that is drawn in it runs off.
  void aNewSceneIsATray() {
    Worker worker;
    DocumentFiles files(*m_document, worker);
    files.newProject();
    const Environment& environment = m_document->project().environment;
    QCOMPARE(environment.walls.size(), size_t{5});
    for (const SceneWall& wall : environment.walls) QVERIFY(!hasTemperature(wall));
    QVERIFY(!m_document->addWalls(kUprightSides).isEmpty());
    QVERIFY(!m_document->addWalls({"floor"}).isEmpty());
    QCOMPARE(m_document->addWalls({"lid"}), QString());
  }

  void materialOfABodyIsChosen() {
    const Address made{Owner::Body, "second", kBodyMaterialKey};
    const std::string before = text(), old = std::get<std::string>(m_document->value(made));
    QCOMPARE(old, m_document->body("second")->material);
    QVERIFY(m_document->value(made) == m_document->defaultValue(made));      // never shown as changed
    QVERIFY(!m_document->setParameter(made, std::string("tin")).isEmpty());  // not of this scene
    QCOMPARE(m_document->addMaterial("tin"), std::string("tin"));
    QCOMPARE(m_document->setParameter(made, std::string("tin")), QString());
    const Project saved = parseProject(text(), "scene.json", *m_plugins).project;
    QCOMPARE(saved.bodies[1].material, std::string("tin"));
    QCOMPARE(saved.bodies[0].material, old);
    m_link->reset();
    QVERIFY(!m_document->removeMaterial("tin").isEmpty());
    m_document->undoStack().undo();
    m_document->undoStack().undo();
    QCOMPARE(text(), before);
  }

  void adhesionIsChosen() {
    const std::string id = m_document->project().materials[0].id, before = text();
    QVERIFY(!m_document->declaration({Owner::Material, id, kAdheresKey + id}));  // matter of one kind always joins
    QCOMPARE(m_document->addMaterial("tin"), std::string("tin"));
    const std::string added = text();
    const Address holds{Owner::Material, id, std::string(kAdheresKey) + "tin"};
    QCOMPARE(QString::fromUtf8(m_document->declaration(holds)->label), QStringLiteral("Holds on to Tin"));
    QVERIFY(m_document->value(holds) == Value(false));
    QCOMPARE(m_document->setParameter(holds, true), QString());
    QVERIFY(m_document->value(holds) == Value(true));
    QVERIFY(m_document->value({Owner::Material, "tin", kAdheresKey + id}) == Value(false));
    QCOMPARE(*parseProject(text(), "scene.json", *m_plugins).project.materials[0].adheresTo,
             std::vector<std::string>{"tin"});
    QCOMPARE(m_document->setParameter(holds, false), QString());  // as it was installed: nothing to save
    QCOMPARE(text(), added);
    m_document->undoStack().undo();
    QVERIFY(m_document->value(holds) == Value(true));
    m_document->undoStack().undo();
    m_document->undoStack().undo();
    QCOMPARE(text(), before);
  }

  /// A name in a scene's list is first of all that of a material of the scene; of two that are the same installed one
  /// each has its own toggle.
  void adhesionTellsMaterialsOfOneKindApart() {
    Project project = m_document->project();
    const std::string id = project.materials[0].id;
    project.materials.push_back({"tin", "", "tin", {}, {}, {}, {}, {}});
    project.materials.push_back({"pewter", "", "tin", {}, {}, {}, {}, {}});
    project.materials[0].adheresTo = {"clay"};  // not of this scene
    m_document->open(project, {});
    const Address tin{Owner::Material, id, std::string(kAdheresKey) + "tin"},
        pewter{Owner::Material, id, std::string(kAdheresKey) + "pewter"};
    const std::string before = text();
    const auto set = [&](const Address& address, bool on) { return m_document->setParameter(address, on); };
    QCOMPARE(set(tin, true), QString());
    QVERIFY(m_document->value(tin) == Value(true) && m_document->value(pewter) == Value(false));
    QCOMPARE(set(pewter, true), QString());
    QCOMPARE(set(tin, false), QString());
    QVERIFY(m_document->value(tin) == Value(false) && m_document->value(pewter) == Value(true));
    const std::vector<Material> compiled = compileMaterials(m_document->project(), *m_plugins);
    QCOMPARE(compiled[0].adheresTo, std::vector<std::string>{"pewter"});
    QCOMPARE(set(pewter, false), QString());
    QCOMPARE(text(), before);  // clay is still named
    QVERIFY(!set({Owner::Material, "lost", std::string(kAdheresKey) + "tin"}, true).isEmpty());
  }

  /// Constraints between neighbours come beside what holds a body together, as toggles of the body.
  void neighbourConstraintsAreAdded() {
    const Address toggle{Owner::Body, "second", std::string(kNeighbourKey) + "fixture.neighbour"};
    const std::string before = text();
    QCOMPARE(QString::fromUtf8(m_document->declaration(toggle)->label), QStringLiteral("Idle neighbours"));
    QVERIFY(m_document->value(toggle) == Value(false));
    QCOMPARE(m_document->setParameter(toggle, true), QString());
    QVERIFY(m_document->value(toggle) == Value(true));
    const Body saved = parseProject(text(), "scene.json", *m_plugins).project.bodies[1];
    QCOMPARE(saved.constraints.size(), size_t{2});
    QCOMPARE(saved.constraints[0].plugin, std::string("bonds"));
    QCOMPARE(saved.constraints[1].plugin, std::string("fixture.neighbour"));
    QCOMPARE(structureOf(saved, m_plugins.get()), std::string("bonds"));
    QCOMPARE(m_document->setParameter(toggle, false), QString());
    QCOMPARE(m_document->body("second")->constraints.size(), size_t{1});
    m_document->undoStack().undo();
    m_document->undoStack().undo();
    QCOMPARE(text(), before);
    const Address lost{Owner::Body, "second", std::string(kNeighbourKey) + "org.example.lost"};
    QVERIFY(!m_document->setParameter(lost, true).isEmpty());
  }

  /// Heat sources are toggles of the scene; what they declare is a slider once they are used.
  void heatSourcesAreAdded() {
    const Address toggle{Owner::Scene, "", std::string(kHeatSourceKey) + "fixture.source"};
    const Address power{Owner::HeatSource, "fixture.source", "power"};
    const std::string before = text();
    QVERIFY(m_document->value(toggle) == Value(false));
    QVERIFY(!m_document->setParameter(power, 3.0).isEmpty());
    QCOMPARE(m_document->setParameter(toggle, true), QString());
    QCOMPARE(m_document->setParameter(power, 3.0), QString());
    const SolverOptions saved = parseProject(text(), "scene.json", *m_plugins).project.solver;
    QCOMPARE(saved.heatSources.size(), size_t{1});
    QCOMPARE(saved.heatSources[0].plugin, std::string("fixture.source"));
    QVERIFY(saved.heatSources[0].parameters.values.at("power") == Value(3.0));
    m_document->undoStack().undo();
    m_document->undoStack().undo();
    QCOMPARE(text(), before);
  }

  void structureIsChosen() {
    const Address structure{Owner::Body, "second", kStructureKey};
    QCOMPARE(std::get<std::string>(m_document->value(structure)), std::string("bonds"));
    QVERIFY(QString::fromUtf8(m_document->declaration(structure)->choices).contains(QStringLiteral("rigid")));
    const std::string before = text();
    const auto bonds = clockAndStructure(*m_engine).second;
    QVERIFY(!m_document->setParameter(structure, std::string("glue")).isEmpty());
    QCOMPARE(m_document->setParameter(structure, std::string("rigid")), QString());
    QCOMPARE(m_document->body("second")->constraints.size(), size_t{1});
    QCOMPARE(m_document->body("second")->constraints[0].plugin, std::string("rigid"));
    QCOMPARE(parseProject(text(), "scene.json", *m_plugins).project.bodies[1].constraints[0].plugin,
             std::string("rigid"));
    QCOMPARE(clockAndStructure(*m_engine).second, bonds);
    m_link->reset();
    const auto rigid = clockAndStructure(*m_engine).second;
    QVERIFY(rigid < bonds);  // one group in place of the bonds of eight particles
    QCOMPARE(m_document->setParameter(structure, std::string(kNoStructure)), QString());
    QVERIFY(m_document->body("second")->constraints.empty());
    m_link->reset();
    QCOMPARE(clockAndStructure(*m_engine).second, rigid - 1);
    m_document->undoStack().undo();
    m_document->undoStack().undo();
    QCOMPARE(text(), before);
  }

 private:
  std::string text() const { return writeProject(m_document->project()); }

  /// A stroke of 27 cells far above the blocks.
  void paint(const std::string& material = "water") {
    auto stroke = std::make_shared<StrokeRecord>();
    stroke->lattice.origin = {0.015, 0.015, 0.015};
    stroke->lattice.spacing = 0.03;
    for (int k = 0; k < 27; ++k) stroke->cells.push_back({k % 3 - 1, 26 + k / 3 % 3, k / 9 - 1});
    stroke->body = "drops";
    Body drops;
    drops.id = drops.name = "drops";
    drops.material = material;
    VoxelShape voxels = stroke->lattice;
    voxels.palette.push_back({material, 293.15, {}});
    drops.shape = voxels;
    const auto body = std::make_shared<const Body>(drops);
    m_link->paint(*stroke, body, stroke->cells);
    stroke->edits.push_back(paintEdit(m_document->project(), *body, stroke->cells, 0, {}));
    m_document->addStroke(stroke);
  }

  QTemporaryDir m_fixtures;
  std::unique_ptr<PluginRegistry> m_plugins;
  std::unique_ptr<Document> m_document;
  std::unique_ptr<EngineThread> m_engine;
  std::unique_ptr<SceneLink> m_link;
};

QTEST_GUILESS_MAIN(TestContent)
#include "tst_content.moc"
