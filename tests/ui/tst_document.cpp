// SPDX-License-Identifier: Apache-2.0
// The document without a window: commands, events, strokes through the engine, files.
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/enginethread.h"
#include "tests/shared/enginehands.h"
#include "tests/shared/scenes.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/session/documentfiles.h"
#include "ui/session/scenelink.h"
#include "ui/session/worker.h"

#include <QtCore/QTemporaryDir>
#include <QtTest/QSignalSpy>
#include <QtTest/QTest>

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>
#include <set>

using namespace ps;
using tests::onEngine;

namespace {

const Address kFloor{Owner::Wall, "floor", "temperature"};
const Address kScale{Owner::Solver, "", "thermal_time_scale"};

Project smallScene() { return scenes::iceOnPlate(5, 370); }

std::set<uint32_t> idsNow(EngineThread& engine) {
  return onEngine<std::set<uint32_t>>(engine, [](Engine& e) {
    const ParticleStore& store = e.solver().particles();
    return std::set<uint32_t>(store.id(), store.id() + store.size());
  });
}

/// A document with the small scene, and what opens and saves it.
struct Desk {
  explicit Desk(const PluginRegistry& plugins) {
    document.setPlugins(&plugins);
    document.open(smallScene(), {});
  }
  Document document;
  Worker worker;
  DocumentFiles files{document, worker};
};

std::vector<std::array<int, 3>> cube(int side, int x, int y, int z) {
  std::vector<std::array<int, 3>> cells;
  cells.reserve(static_cast<size_t>(side * side * side));
  for (int k = 0; k < side * side * side; ++k)
    cells.push_back({x + k % side, y + k / side % side, z + k / side / side});
  return cells;
}

}  // namespace

class TestDocument : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { m_plugins = std::make_unique<PluginRegistry>(); }

  /// The engine refuses a moment later: other edits, a save and a drag may have come between.
  void aRefusedValueIsNoStepOfTheWay() {
    const Address lid{Owner::Wall, "lid", "temperature"};
    Document document;
    document.setPlugins(m_plugins.get());
    document.open(smallScene(), {});
    QCOMPARE(document.setParameter(kFloor, 350.0), QString());
    QCOMPARE(document.setParameter(kFloor, 360.0), QString());
    QCOMPARE(document.setParameter(lid, 280.0), QString());
    document.undoStack().setClean();
    document.takeBack(kFloor, 360.0, Value(350.0));
    QCOMPARE(std::get<double>(document.value(kFloor)), 350.0);
    QVERIFY(document.isDirty());  // what was saved holds it
    const auto floor = [&] { return std::get<double>(document.value(kFloor)); };
    while (document.undoStack().canUndo()) {
      document.undoStack().undo();
      QVERIFY(floor() != 360.0);
    }
    QCOMPARE(floor(), 370.0);
    while (document.undoStack().canRedo()) {
      document.undoStack().redo();
      QVERIFY(floor() != 360.0);
    }
    QCOMPARE(floor(), 350.0);
    QCOMPARE(std::get<double>(document.value(lid)), 280.0);
    document.takeBack(kFloor, 360.0, Value(340.0));  // it has another value by now
    QCOMPARE(floor(), 350.0);
  }

  /// Back to the default is a value like any other: refused, it leaves the document too. Without a command that stores
  /// it, there is nothing of it to mend.
  void aRefusedDefaultIsTakenBack() {
    const Address substeps{Owner::Solver, "", "substeps"};
    Document document;
    document.setPlugins(m_plugins.get());
    document.open(smallScene(), {});
    QCOMPARE(document.setParameter(substeps, 7.0), QString());
    const Value standard = document.defaultValue(substeps);
    QCOMPARE(document.setParameter(substeps, standard), QString());
    QVERIFY(!storedValue(document.project(), substeps));
    document.takeBack(substeps, standard, Value(7.0));
    QCOMPARE(std::get<double>(document.value(substeps)), 7.0);
    while (document.undoStack().canUndo()) document.undoStack().undo();
    while (document.undoStack().canRedo()) document.undoStack().redo();
    QCOMPARE(std::get<double>(document.value(substeps)), 7.0);  // no step leads to the default any more
    QCOMPARE(document.undoStack().count(), 1);
    // And what goes on may be the default, which the engine stores and a document does not.
    document.takeBack(substeps, 7.0, standard);
    QVERIFY(!storedValue(document.project(), substeps));
  }

  void aDragIsOneStep() {
    Document document;
    document.setPlugins(m_plugins.get());
    document.open(smallScene(), {});
    document.beginGesture();
    for (int k = 0; k < 50; ++k) QCOMPARE(document.setParameter(kFloor, 300.0 + k), QString());
    document.endGesture();
    QCOMPARE(document.undoStack().count(), 1);
    QCOMPARE(std::get<double>(document.value(kFloor)), 349.0);
    document.undoStack().undo();
    QCOMPARE(std::get<double>(document.value(kFloor)), 370.0);
    document.undoStack().redo();
    QCOMPARE(std::get<double>(document.value(kFloor)), 349.0);
  }

  void gesturesDoNotMerge() {
    Document document;
    document.setPlugins(m_plugins.get());
    document.open(smallScene(), {});
    for (const double value : {320.0, 330.0}) {
      document.beginGesture();
      document.setParameter(kFloor, value);
      document.endGesture();
    }
    document.setParameter(kFloor, 340.0);
    document.setParameter(kFloor, 350.0);
    QCOMPARE(document.undoStack().count(), 4);
  }

  void motionOfBodiesIsAnEditLikeOthers() {
    Document document;
    document.setPlugins(m_plugins.get());
    document.open(smallScene(), {});
    const std::string id = document.project().bodies[0].id;
    const Address speed{Owner::Body, id, "velocity_y"}, spin{Owner::Body, id, "spin_z"};
    QCOMPARE(document.setParameter(speed, -2.0), QString());
    QCOMPARE(document.setParameter(spin, 3.0), QString());
    QVERIFY(!document.setParameter(spin, 1e9).isEmpty());
    QVERIFY((document.project().bodies[0].velocity == Vector3{0, -2, 0}));
    QVERIFY((document.project().bodies[0].spin == Vector3{0, 0, 3}));
    QVERIFY(document.project().bodies[0].parameters.values.count("spin_z") == 0);  // the file has it as a vector
    QCOMPARE(document.setParameter(spin, 0.0), QString());
    document.undoStack().undo();
    QVERIFY(document.value(spin) == Value(3.0));
    document.undoStack().undo();
    document.undoStack().undo();
    QVERIFY((document.project().bodies[0].velocity == Vector3{0, 0, 0}));
    QVERIFY(!document.isDirty());
  }

  void gravityAndThermalModelAreEditsLikeOthers() {
    Document document;
    document.setPlugins(m_plugins.get());
    document.open(smallScene(), {});
    const Address gravity{Owner::Scene, "", "gravity"}, model{Owner::Scene, "", "thermal_model"};
    document.beginGesture();
    for (const double g : {5.0, 0.0, 1.62}) QCOMPARE(document.setParameter(gravity, g), QString());
    document.endGesture();
    QCOMPARE(document.undoStack().count(), 1);
    QCOMPARE(document.project().environment.gravity[1], -1.62);
    QVERIFY(!document.setParameter(gravity, -3.0).isEmpty());
    QVERIFY(!document.setParameter(model, std::string("phlogiston")).isEmpty());
    QCOMPARE(document.setParameter(model, std::string("none")), QString());
    QCOMPARE(document.project().solver.thermalModel, std::string());
    document.undoStack().undo();
    QCOMPARE(document.project().solver.thermalModel, std::string("enthalpy"));
    document.undoStack().undo();
    QCOMPARE(document.project().environment.gravity[1], -9.81);
    QVERIFY(!document.isDirty());
  }

  void aDragTakenBackLeavesNothing() {
    Document document;
    document.setPlugins(m_plugins.get());
    document.open(smallScene(), {});
    document.beginGesture();
    document.setParameter(kFloor, 300.0);
    document.setParameter(kFloor, 370.0);
    document.endGesture();
    QCOMPARE(document.undoStack().count(), 0);
    QVERIFY(!document.isDirty());
  }

  void refusals_data() {
    QTest::addColumn<QString>("address");
    QTest::addColumn<double>("value");
    QTest::newRow("below the hard range") << "material/water/density_solid" << -5.0;
    QTest::newRow("not a number") << "wall/floor/temperature" << std::nan("");
    QTest::newRow("contradiction") << "material/water/boiling_temperature" << 200.0;
    QTest::newRow("too many particles") << "solver/particle_spacing" << 0.0005;  // 27 million
    QTest::newRow("no such owner") << "wall/ceiling/temperature" << 300.0;
    QTest::newRow("no such key") << "wall/floor/colour" << 300.0;
  }
  void refusals() {
    QFETCH(QString, address);
    QFETCH(double, value);
    Document document;
    document.setPlugins(m_plugins.get());
    document.open(smallScene(), {});
    const std::string before = writeProject(document.project());
    QVERIFY(!document.setParameter(*Address::parse(address.toStdString()), value).isEmpty());
    QCOMPARE(writeProject(document.project()), before);
    QCOMPARE(document.undoStack().count(), 0);
  }

  void resetRemovesTheValue() {
    Document document;
    document.setPlugins(m_plugins.get());
    document.open(smallScene(), {});
    const Address conductivity{Owner::Material, "water", "conductivity_solid"};
    const Value base = document.defaultValue(conductivity);
    QVERIFY(std::holds_alternative<Response>(base));
    QVERIFY(document.setParameter(conductivity, Response(9.0)).isEmpty());
    QVERIFY(findSet(document.project(), conductivity)->values.count("conductivity_solid") == 1);
    QVERIFY(document.setParameter(conductivity, base).isEmpty());
    QVERIFY(findSet(document.project(), conductivity)->values.empty());
  }

  void eventsAreTyped() {
    Document document;
    document.setPlugins(m_plugins.get());
    std::vector<size_t> kinds;
    connect(&document, &Document::changed, this, [&](const ChangeEvent& event) { kinds.push_back(event.index()); });
    document.open(smallScene(), {});
    QVERIFY(!kinds.empty());
    QCOMPARE(kinds.front(), ChangeEvent(ProjectOpened{}).index());
    kinds.clear();
    document.setParameter(kScale, 10.0);
    QVERIFY(std::find(kinds.begin(), kinds.end(), ChangeEvent(ParameterChanged{}).index()) != kinds.end());
    kinds.clear();
    document.renameBody("ice", QStringLiteral("Berg"));
    QVERIFY(std::find(kinds.begin(), kinds.end(), ChangeEvent(BodyChanged{}).index()) != kinds.end());
    QCOMPARE(document.body("ice")->name, std::string("Berg"));
    document.setBodiesVisible({"ice"}, false);
    QVERIFY(!document.body("ice")->visible);
    document.undoStack().undo();
    document.undoStack().undo();
    QVERIFY(document.body("ice")->visible);
    QCOMPARE(document.body("ice")->name, std::string("ice"));
  }

  void theEngineFollows() {
    Document document;
    document.setPlugins(m_plugins.get());
    EngineThread engine(*m_plugins, {});
    SceneLink link(document, engine);
    document.open(smallScene(), {}, false, false);
    document.setParameter(kFloor, 333.0);
    const auto read = [&] {
      return onEngine<double>(engine, [](Engine& e) {
        return numberOf(e.project().environment.walls[0].parameters, wallParameters(), "temperature");
      });
    };
    QCOMPARE(read(), 333.0);
    document.undoStack().undo();
    QCOMPARE(read(), 370.0);
  }

  /// Undone to "not set", a property is the plugin's again in the engine too, and follows the plugin's own parameters.
  void theEngineForgetsWhatIsNotSet() {
    Document document;
    document.setPlugins(m_plugins.get());
    EngineThread engine(*m_plugins, {});
    SceneLink link(document, engine);
    document.open(smallScene(), {}, false, false);
    const Address density{Owner::Material, "water", "density_liquid"};
    const auto set = [&] {
      return onEngine<size_t>(engine,
                              [&](Engine& e) { return findSet(e.project(), density)->values.count(density.key); });
    };
    QCOMPARE(document.setParameter(density, Response(900.0)), QString());
    QCOMPARE(set(), size_t{1});
    document.undoStack().undo();
    QCOMPARE(set(), size_t{0});
    QCOMPARE(document.setParameter(density, Response(900.0)), QString());
    QCOMPARE(document.setParameter(density, document.defaultValue(density)), QString());
    QCOMPARE(set(), size_t{0});
  }

  void undoRemovesExactlyTheStroke_data() {
    QTest::addColumn<bool>("moved");
    QTest::addColumn<bool>("reset");
    QTest::newRow("at once") << false << false;
    QTest::newRow("after the matter has moved") << true << false;
    QTest::newRow("after a reset") << true << true;
  }
  void undoRemovesExactlyTheStroke() {
    QFETCH(bool, moved);
    QFETCH(bool, reset);
    Document document;
    document.setPlugins(m_plugins.get());
    EngineThread engine(*m_plugins, {});
    SceneLink link(document, engine);
    document.open(smallScene(), {}, false, false);
    const std::set<uint32_t> before = idsNow(engine);
    const auto stroke = paint(document, link);
    const std::set<uint32_t> with = idsNow(engine);
    QCOMPARE(with.size(), before.size() + 27);
    if (moved)
      onEngine<int>(engine, [](Engine& e) {
        for (int k = 0; k < 10; ++k) e.step();
        return 0;
      });
    if (reset) link.reset();
    QCOMPARE(idsNow(engine).size(), with.size());
    document.undoStack().undo();
    const std::set<uint32_t> after = idsNow(engine);
    QCOMPARE(after.size(), before.size());
    if (!reset) QVERIFY(after == before);
    QVERIFY(!document.body("drops"));
    document.undoStack().redo();
    QCOMPARE(idsNow(engine).size(), with.size());
    if (!reset) QVERIFY(idsNow(engine) == with);
    document.undoStack().undo();
    QCOMPARE(idsNow(engine).size(), before.size());
  }

  void aStrokeUndoneBeforeAResetComesBack() {
    Document document;
    document.setPlugins(m_plugins.get());
    EngineThread engine(*m_plugins, {});
    SceneLink link(document, engine);
    document.open(smallScene(), {}, false, false);
    const size_t before = idsNow(engine).size();
    const auto stroke = paint(document, link);
    document.undoStack().undo();
    link.reset();
    QCOMPARE(idsNow(engine).size(), before);
    document.undoStack().redo();
    QCOMPARE(idsNow(engine).size(), before + 27);
    document.undoStack().undo();
    QCOMPARE(idsNow(engine).size(), before);
  }

  void aSceneThatCannotBeBuiltIsBuiltOnceMended() {
    Document document;
    document.setPlugins(m_plugins.get());
    EngineThread engine(*m_plugins, {});
    SceneLink link(document, engine);
    document.open(smallScene(), {});
    QTRY_VERIFY(engine.snapshot() && engine.playing());
    Project project = smallScene();
    const uint64_t revision = engine.snapshot()->revision;
    project.materials[0].properties.values["boiling_temperature"] = 200.0;  // below the melting point
    document.open(project, {});
    QTRY_VERIFY(link.isBroken());
    QVERIFY(!engine.playing());
    QVERIFY(engine.snapshot()->id.empty() && engine.snapshot()->revision != revision);
    QTRY_VERIFY(!engine.events(0).empty() && engine.events(0).back().kind == EngineEvent::Kind::NotOpened);
    QVERIFY(
        QString::fromStdString(engine.events(0).back().message).contains(QStringLiteral("water"), Qt::CaseInsensitive));
    const auto stroke = paint(document, link);  // the document takes it, no engine yet
    QCOMPARE(document.setParameter({Owner::Material, "water", "boiling_temperature"}, 373.15), QString());
    QTRY_VERIFY(!link.isBroken());
    QTRY_VERIFY(engine.playing());  // as it would have opened
    QCOMPARE(idsNow(engine).size(), size_t{125 + 27});
  }

  void undoneErasureComesBackWithItsState() {
    Document document;
    document.setPlugins(m_plugins.get());
    EngineThread engine(*m_plugins, {});
    SceneLink link(document, engine);
    document.open(smallScene(), {}, false, false);
    const auto energy = [&] { return onEngine<double>(engine, [](Engine& e) { return e.solver().thermalEnergy(); }); };
    const auto mass = [&] {
      return onEngine<double>(engine, [](Engine& e) {
        double sum = 0;
        for (size_t i = 0; i < e.solver().particles().size(); ++i)
          sum += static_cast<double>(e.solver().particles().mass()[i]);
        return sum;
      });
    };
    onEngine<int>(engine, [](Engine& e) {
      for (int k = 0; k < 5; ++k) e.step();
      return 0;
    });
    const std::set<uint32_t> whole = idsNow(engine);
    const double heat = energy(), kilograms = mass();
    const auto stroke = std::make_shared<StrokeRecord>();
    stroke->erase = true;
    stroke->lattice = lattice();
    stroke->cells = cube(3, -1, 0, -1);
    link.erase(*stroke, stroke->cells);
    document.addStroke(stroke);
    const size_t left = idsNow(engine).size();
    QVERIFY(left < whole.size());
    document.undoStack().undo();
    QVERIFY(idsNow(engine) == whole);
    // Enthalpies and masses are copied bit by bit; only the order of the sum differs.
    QVERIFY(std::abs(energy() - heat) < 1e-9 * std::abs(heat));
    QVERIFY(std::abs(mass() - kilograms) < 1e-9 * kilograms);
    document.undoStack().redo();
    QCOMPARE(idsNow(engine).size(), left);
  }

  void anErasureUndoneAfterAResetIsFilledAgain_data() {
    QTest::addColumn<double>("x");
    QTest::newRow("cells of the block") << 0.0;
    QTest::newRow("particles on the faces of cells") << 0.015;
  }
  /// Carved at the start, built without, then undone: the gap is filled, whether a box was carved or cells.
  void anErasureUndoneAfterAResetIsFilledAgain() {
    QFETCH(double, x);
    Document document;
    document.setPlugins(m_plugins.get());
    EngineThread engine(*m_plugins, {});
    SceneLink link(document, engine);
    document.open(smallScene(), {}, false, false);
    std::vector<size_t> counts{idsNow(engine).size()};
    for (const int height : {0, 2}) {
      const auto stroke = std::make_shared<StrokeRecord>();
      stroke->erase = true;
      stroke->lattice = lattice();
      stroke->lattice.origin = {x, 0.015, 0};
      stroke->cells = cube(3, -1, height, -1);
      link.erase(*stroke, stroke->cells);
      stroke->edits.push_back(*eraseEdit(*document.body("ice"), 0, stroke->lattice, stroke->cells));
      document.addStroke(stroke);
      counts.push_back(idsNow(engine).size());
    }
    QVERIFY(counts[1] < counts[0] && counts[2] < counts[1]);
    link.reset();
    QCOMPARE(idsNow(engine).size(), counts[2]);
    document.undoStack().undo();
    QCOMPARE(idsNow(engine).size(), counts[1]);
    document.undoStack().undo();
    QCOMPARE(idsNow(engine).size(), counts[0]);
    document.undoStack().redo();
    QCOMPARE(idsNow(engine).size(), counts[1]);
  }

  void savedFilesReadBack() {
    QTemporaryDir directory;
    Desk desk(*m_plugins);
    Document& document = desk.document;
    DocumentFiles& files = desk.files;
    document.setParameter(kFloor, 345.0);
    QVERIFY(document.isDirty());
    const QString path = directory.filePath(QStringLiteral("scene.json"));
    QSignalSpy saved(&files, &DocumentFiles::saved);
    files.save(path);
    QVERIFY(saved.wait());
    QVERIFY(!document.isDirty());
    const std::string text = writeProject(document.project());
    QSignalSpy opened(&files, &DocumentFiles::opened);
    files.open(path);
    QVERIFY(opened.wait());
    QCOMPARE(writeProject(document.project()), text);
    QCOMPARE(document.path(), path);
    QVERIFY(DocumentFiles::recent().contains(path));
  }

  void aSaveDuringWhichSomethingChangedStaysDirty_data() {
    QTest::addColumn<bool>("drag");
    QTest::newRow("another edit") << false;
    QTest::newRow("the same drag") << true;  // merges into the step that was saved: its index stays
  }
  void aSaveDuringWhichSomethingChangedStaysDirty() {
    QFETCH(bool, drag);
    QTemporaryDir directory;
    Desk desk(*m_plugins);
    Document& document = desk.document;
    DocumentFiles& files = desk.files;
    if (drag) document.beginGesture();
    document.setParameter(kFloor, 345.0);
    QSignalSpy saved(&files, &DocumentFiles::saved);
    files.save(directory.filePath(QStringLiteral("scene.json")));
    document.setParameter(kFloor, 346.0);
    QVERIFY(saved.wait());
    QVERIFY(document.isDirty());
    QCOMPARE(document.undoStack().count(), drag ? 1 : 2);
  }

  void aSaveThatEndsLateLeavesTheNextProjectAlone() {
    QTemporaryDir directory;
    Desk desk(*m_plugins);
    Document& document = desk.document;
    DocumentFiles& files = desk.files;
    document.setParameter(kFloor, 345.0);
    QSignalSpy saved(&files, &DocumentFiles::saved);
    files.save(directory.filePath(QStringLiteral("old.json")));
    files.newProject();
    QCOMPARE(document.setParameter(kFloor, 350.0), QString());
    QVERIFY(saved.wait());
    QCOMPARE(saved.front()[1].toBool(), false);
    QCOMPARE(document.path(), QString());
    QVERIFY(document.isDirty());
  }

  void badFilesLeaveTheScene_data() {
    QTest::addColumn<QByteArray>("content");
    QTest::newRow("empty") << QByteArray();
    QTest::newRow("truncated") << QByteArray("{\"format\": \"phasesketch\", \"bodies\": [");
    QTest::newRow("another format") << QByteArray("{\"format\": \"other\", \"version\": 1}");
  }
  void badFilesLeaveTheScene() {
    QFETCH(QByteArray, content);
    QTemporaryDir directory;
    const QString path = directory.filePath(QStringLiteral("bad.json"));
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(content);
    file.close();
    Desk desk(*m_plugins);
    Document& document = desk.document;
    DocumentFiles& files = desk.files;
    const std::string before = writeProject(document.project());
    QSignalSpy failed(&files, &DocumentFiles::openFailed);
    files.open(path);
    QVERIFY(failed.wait());
    QVERIFY(failed.front()[1].toString().contains(QStringLiteral("bad.json")));
    QCOMPARE(writeProject(document.project()), before);
  }

  void everyParameterHasAnAddress() {
    const Project project = smallScene();
    const auto addresses = allAddresses(project, m_plugins.get());
    QVERIFY(addresses.size() > 60);
    for (const Address& address : addresses) {
      QVERIFY2(declarationOf(project, m_plugins.get(), address) != nullptr, address.text().c_str());
      QVERIFY2(problemWith(project, m_plugins.get(), address, valueAt(project, m_plugins.get(), address)).empty(),
               address.text().c_str());
    }
  }

 private:
  static VoxelShape lattice() {
    VoxelShape shape;
    shape.origin = {0.015, 0.015, 0.015};
    shape.spacing = 0.03;
    return shape;
  }
  static Body drops() {
    Body body;
    body.id = body.name = "drops";
    body.material = "water";
    VoxelShape voxels = lattice();
    voxels.palette.push_back({"water", 293.15, {}});
    body.shape = voxels;
    return body;
  }
  /// A stroke of 27 cells well above the block.
  std::shared_ptr<StrokeRecord> paint(Document& document, SceneLink& link) {
    auto stroke = std::make_shared<StrokeRecord>();
    stroke->lattice = lattice();
    stroke->cells = cube(3, -1, 12, -1);
    stroke->body = "drops";
    const auto body = std::make_shared<const Body>(drops());
    link.paint(*stroke, body, stroke->cells);
    stroke->edits.push_back(paintEdit(document.project(), *body, stroke->cells, 0, {}));
    document.addStroke(stroke);
    return stroke;
  }

  std::unique_ptr<PluginRegistry> m_plugins;
};

QTEST_GUILESS_MAIN(TestDocument)
#include "tst_document.moc"
