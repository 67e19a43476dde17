// SPDX-License-Identifier: Apache-2.0
// What a hand cuts comes apart and stays apart while it is solid, what it welds holds, and undo has the same ties again
// or takes exactly those away.
#include "core/io/recording.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/projectstate.h"
#include "core/simulation/runrecord.h"
#include "core/solver/solver.h"
#include "core/solver/structure/cuts.h"
#include "tests/physics/onehash.h"
#include "tests/shared/recordedrun.h"
#include "tests/shared/scenes.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace ps;

namespace {

constexpr double kSpacing = 0.02;
constexpr MatterKey kKey = 5;

/// Ice, without heat unless a test warms it.
Body bar(const char* id, const char* structure, const Vector3& centre, const Vector3& cells) {
  Body body = scenes::block(id, 1, kSpacing, centre, 263.15);
  body.shape = BoxShape{centre, kSpacing * cells};
  body.constraints = {{structure, {}, {}}};
  return body;
}

Project sceneOf(std::vector<Body> bodies, bool weightless = false) {
  Project project;
  project.materials.push_back(scenes::water());
  project.environment = scenes::tray(0.6, 1.2);
  if (weightless) project.environment.gravity = {0, 0, 0};
  project.solver.thermalModel = scenes::kThermalModel;
  project.solver.parameters.values["particle_spacing"] = kSpacing;
  project.bodies = std::move(bodies);
  return project;
}

/// Along x, 12 particles long; on the floor, or in the air.
Project oneBar(const char* structure, double height = 0.02, bool weightless = false) {
  const bool rope = std::string(structure) == "rope", cloth = std::string(structure) == "cloth";
  const Vector3 cells = rope ? Vector3(12, 1, 1) : cloth ? Vector3(12, 1, 6) : Vector3(12, 4, 4);
  return sceneOf({bar("bar", structure, {0, height + 0.5 * kSpacing * cells[1], 0}, cells)}, weightless);
}

api::Touch blade(const api::Double3& centre, double radius = 0.2, const api::Double3& normal = {1, 0, 0}) {
  api::Touch touch;
  touch.kind = api::TouchKind::Cut;
  touch.centre = centre;
  touch.radius = radius;
  touch.normal = normal;
  return touch;
}

api::Touch weld(const api::Double3& centre, double radius) {
  api::Touch touch = blade(centre, radius, {0, 0, 0});
  touch.kind = api::TouchKind::Weld;
  return touch;
}

TouchMatter once(const api::Touch& touch, MatterKey key = kKey) { return {{touch}, 1, {}, {}, key}; }

void run(Engine& engine, int frames) {
  for (int frame = 0; frame < frames; ++frame) {
    const StepReport report = engine.step();
    QCOMPARE(QString::fromStdString(report.message), QString());
  }
}

/// Sizes of what hangs together, the largest first; single grains are left out.
std::vector<size_t> piecesOf(const Engine& engine) {
  std::map<uint32_t, size_t> sizes;
  for (const uint32_t piece : engine.solver().pieces()) {
    if (piece != Solver::kNoPiece) ++sizes[piece];
  }
  std::vector<size_t> list;
  for (const auto& [piece, size] : sizes) list.push_back(size);
  std::sort(list.rbegin(), list.rend());
  return list;
}

/// Mean of a coordinate over a body, or over those of it beyond x = 0.
double heightOf(const Engine& engine, uint32_t body, double side = 0) {
  const ParticleStore& store = engine.particles();
  double sum = 0, count = 0;
  for (size_t i = 0; i < store.size(); ++i) {
    if (store.body()[i] != body || side * store.position()[i].x < 0) continue;
    sum += store.position()[i].y;
    ++count;
  }
  return sum / count;
}

Vector3 momentumOf(const Engine& engine) {
  Vector3 sum(0, 0, 0);
  const ParticleStore& store = engine.particles();
  for (size_t i = 0; i < store.size(); ++i) sum += double{store.mass()[i]} * vectorOf(store.velocity()[i]);
  return sum;
}

}  // namespace

class TestCutting : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup() {
    setThreadCount(0);
    setInstructionSet("");
  }
  void pairsAreKnownByBothEnds();
  void itComesApartAndStaysApart_data() { addStructures(); }
  void itComesApartAndStaysApart();
  void undoTiesTheSameAgain_data() { addStructures(); }
  void undoTiesTheSameAgain();
  void aBallCutsAllThatReachesIn();
  void aBodyIsCutStepByStep_data() { addStructures(); }
  void aBodyIsCutStepByStep();
  void whatHasGoneApartIsPulledTogether();
  void aCutGivesNoPush();
  void aCutRopeFallsAsTwo();
  void lockedMatterStaysWhole();
  void whatMeltsJoinsAgain();
  void aWeldCarriesWhatHangsOnIt();
  void aWeldClosesACut();
  void bladesThatCannotBeAreRefused();
  void theSameBitsEverywhere_data() { onehash::addRows(); }
  void theSameBitsEverywhere();
  void aStateKnowsWhatWasCut();
  void recordedFramesAreMadeAgain();

 private:
  static void addStructures() {
    QTest::addColumn<QString>("structure");
    for (const char* name : {"bonds", "rigid", "clusters", "cloth", "rope"}) QTest::newRow(name) << QString(name);
  }
  PluginRegistry m_plugins;
};

void TestCutting::pairsAreKnownByBothEnds() {
  ParticleStore store;
  store.add(4);
  for (size_t i = 0; i < 4; ++i) store.motion()[i] = api::Motion::Solid;
  Cuts cuts;
  const Cuts::Pair near = Cuts::pairOf(store.id()[2], store.id()[0]), far = Cuts::pairOf(store.id()[1], store.id()[3]);
  QCOMPARE(cuts.add(std::vector<Cuts::Pair>{near, near}).size(), size_t{1});
  QVERIFY(cuts.add(std::vector<Cuts::Pair>{far, near}) == std::vector<Cuts::Pair>{far});
  const api::CutView* view = cuts.view(store);
  QVERIFY(view->between(0, 2) && view->between(2, 0) && view->between(3, 1) && !view->between(0, 1));
  QVERIFY(cuts.of(store, std::vector<uint32_t>{3}) == std::vector<Cuts::Pair>{far});
  QVERIFY(cuts.among(store, std::vector<uint8_t>{1, 1, 1, 0}) == std::vector<Cuts::Pair>{near});
  store.motion()[2] = api::Motion::Liquid;
  cuts.dropLoose(store);
  QVERIFY(!cuts.view(store)->at(0) && cuts.view(store)->at(1));
  cuts.remove(std::vector<Cuts::Pair>{far});
  QVERIFY(cuts.empty() && !cuts.view(store));
}

/// On the floor, side by side: ice that touches would grow together.
void TestCutting::itComesApartAndStaysApart() {
  QFETCH(QString, structure);
  Engine engine(oneBar(structure.toLatin1()), m_plugins);
  const size_t count = engine.particles().size();
  run(engine, 3);
  QCOMPARE(piecesOf(engine), std::vector<size_t>{count});
  engine.apply(once(blade({0, 0.05, 0})));
  run(engine, 90);
  QCOMPARE(piecesOf(engine), (std::vector<size_t>{count / 2, count / 2}));
}

void TestCutting::undoTiesTheSameAgain() {
  QFETCH(QString, structure);
  Engine engine(oneBar(structure.toLatin1(), 0.3, true), m_plugins);
  const size_t count = engine.particles().size();
  run(engine, 2);
  const size_t ties = engine.solver().constraintCount();
  engine.apply(once(blade({0, 0.32, 0})));
  run(engine, 5);
  const size_t left = engine.solver().constraintCount();
  QVERIFY(structure == "rigid" || structure == "clusters" || left < ties);
  for (int round = 0; round < 2; ++round) {
    engine.apply(UndoTouch{kKey});
    run(engine, 5);
    QCOMPARE(engine.solver().constraintCount(), ties);
    QCOMPARE(piecesOf(engine), std::vector<size_t>{count});
    engine.apply(RedoTouch{kKey});
    run(engine, 5);
    QCOMPARE(engine.solver().constraintCount(), left);
    QCOMPARE(piecesOf(engine), (std::vector<size_t>{count / 2, count / 2}));
  }
}

void TestCutting::aBallCutsAllThatReachesIn() {
  Engine engine(oneBar("bonds", 0.3, true), m_plugins);
  engine.apply(once(blade({0, 0.34, 0}, 0.9 * kSpacing, {0, 0, 0})));
  run(engine, 2);
  // The eight around the middle hold on to nothing, the others to each other.
  QCOMPARE(piecesOf(engine), std::vector<size_t>{engine.particles().size() - 8});
}

/// From above, by a blade that reaches through a part of it at a time.
void TestCutting::aBodyIsCutStepByStep() {
  QFETCH(QString, structure);
  Engine engine(oneBar(structure.toLatin1(), 0.3, true), m_plugins);
  const size_t count = engine.particles().size();
  for (int step = 0; step <= 24; ++step) {
    engine.apply(once(blade({0, 0.34, -0.06 + 0.005 * step}, 0.055)));
    run(engine, 1);
    if (step == 4 && structure != "rope") QCOMPARE(piecesOf(engine), std::vector<size_t>{count});
  }
  QCOMPARE(piecesOf(engine), (std::vector<size_t>{count / 2, count / 2}));
  engine.apply(UndoTouch{kKey});
  run(engine, 1);
  QCOMPARE(piecesOf(engine), std::vector<size_t>{count});
}

/// Undo ties what has gone far apart as well, wherever it is: it comes together without harm.
void TestCutting::whatHasGoneApartIsPulledTogether() {
  Engine engine(oneBar("bonds", 0.3, true), m_plugins);
  const size_t ties = engine.solver().constraintCount();
  engine.apply(once(blade({0, 0.34, 0})));
  api::Touch push = blade({0.08, 0.34, 0}, 0.07, {0, 0, 0});
  push.kind = api::TouchKind::Push;
  push.force = 60;
  push.velocity = {2, 0, 0};
  engine.apply(TouchMatter{{}, 1, {push}, {}, 8});
  run(engine, 20);
  engine.apply(TouchMatter{{}, 1, {}, {}, 8});
  const auto spread = [&] {
    const auto [low, high] =
        std::minmax_element(engine.particles().position(), engine.particles().position() + engine.particles().size(),
                            [](const api::Float4& a, const api::Float4& b) { return a.x < b.x; });
    return high->x - low->x;
  };
  QVERIFY2(spread() > 0.3, qPrintable(QString::number(spread())));
  engine.apply(UndoTouch{kKey});
  QCOMPARE(engine.solver().constraintCount(), ties);
  run(engine, 60);
  QCOMPARE(piecesOf(engine).size(), size_t{1});
  QVERIFY2(spread() < 0.26, qPrintable(QString::number(spread())));
}

/// Neither where a bar is at rest nor where it swings; what its ties held goes.
void TestCutting::aCutGivesNoPush() {
  for (const bool stretched : {false, true}) {
    Project project = oneBar("bonds", 0.3, true);
    if (stretched) project.bodies[0].spin = {0, 40, 0};
    Engine engine(project, m_plugins);
    run(engine, 4);
    const Vector3 before = momentumOf(engine);
    const double elastic = engine.solver().elasticEnergy(), thermal = engine.solver().thermalEnergy();
    const HeatLedger ledger = engine.solver().heatLedger();
    engine.apply(once(blade({0, 0.32, 0})));
    run(engine, 1);
    const double mass = 917 * 12 * 16 * std::pow(kSpacing, 3);
    QVERIFY2((momentumOf(engine) - before).norm() < 1e-5 * mass,
             qPrintable(QString::number(momentumOf(engine).norm())));
    if (stretched) QVERIFY(engine.solver().elasticEnergy() < elastic);
    QVERIFY(std::abs(engine.solver().thermalEnergy() - thermal) < 1e-9 * std::abs(thermal));
    QCOMPARE(engine.solver().heatLedger().net(), ledger.net());
  }
}

/// It hangs by its left end: what is beyond the cut falls freely, the rest stays.
void TestCutting::aCutRopeFallsAsTwo() {
  Project project = oneBar("rope", 0.8);
  project.bodies[0].pins.push_back({{-0.13, 0.7, -0.1}, {-0.105, 0.9, 0.1}, {}});
  project.bodies[0].pins.push_back({{-0.015, 0.7, -0.1}, {-0.005, 0.9, 0.1}, {}});
  Engine engine(project, m_plugins);
  engine.apply(once(blade({0, 0.81, 0})));
  run(engine, 1);
  const double start = heightOf(engine, 0, 1);
  run(engine, 12);
  const double fallen = start - heightOf(engine, 0, 1);  // g t^2/2 = 0.2 m, from what it had fallen in one frame
  QVERIFY2(fallen > 0.17 && fallen < 0.26, qPrintable(QString::number(fallen)));
  QVERIFY(heightOf(engine, 0, -1) > 0.8);
  QCOMPARE(piecesOf(engine), (std::vector<size_t>{6, 6}));
}

void TestCutting::lockedMatterStaysWhole() {
  Engine engine(oneBar("bonds"), m_plugins);
  TouchMatter cut = once(blade({0, 0.05, 0}));
  cut.spared = {"bar"};
  engine.apply(cut);
  run(engine, 2);
  QCOMPARE(piecesOf(engine).size(), size_t{1});
}

/// Molten and frozen again it is one.
void TestCutting::whatMeltsJoinsAgain() {
  Project project = oneBar("bonds", 0.3, true);
  project.solver.parameters.values["thermal_time_scale"] = 100.0;
  Engine engine(project, m_plugins);
  engine.apply(once(blade({0, 0.34, 0})));
  run(engine, 2);
  QCOMPARE(piecesOf(engine).size(), size_t{2});
  api::Touch warmth = weld({0, 0.34, 0}, 0.05);
  warmth.kind = api::TouchKind::Heat;
  warmth.power = 30000;
  warmth.limit = 330;
  engine.apply(TouchMatter{{}, 1, {warmth}, {}, 7});
  run(engine, 20);
  const ParticleStore& store = engine.particles();
  const auto molten = std::count(store.motion(), store.motion() + store.size(), api::Motion::Liquid);
  QVERIFY2(molten > 50, qPrintable(QString::number(molten)));
  warmth.power = -60000;
  warmth.limit = 250;
  warmth.radius = 1;
  engine.apply(TouchMatter{{}, 1, {warmth}, {}, 7});
  run(engine, 90);
  const std::vector<size_t> pieces = piecesOf(engine);
  QVERIFY2(pieces[0] > 9 * engine.particles().size() / 10, qPrintable(QString::number(pieces[0])));
}

/// Two bars, one on the other, of a matter that does not grow together by itself: lifted by the upper one.
void TestCutting::aWeldCarriesWhatHangsOnIt() {
  Project project =
      sceneOf({bar("low", "bonds", {0, 0.04, 0}, {8, 4, 4}), bar("high", "bonds", {0, 0.12, 0}, {8, 4, 4})});
  project.materials[0].properties.values["sinters"] = 0.0;
  Engine engine(project, m_plugins);
  run(engine, 20);
  QCOMPARE(piecesOf(engine).size(), size_t{2});
  const size_t ties = engine.solver().constraintCount();
  engine.apply(once(weld({0, 0.08, 0}, 0.15)));
  run(engine, 1);
  const size_t welded = engine.solver().constraintCount();
  QVERIFY(welded > ties + 32);  // one for each that lies on another
  QCOMPARE(piecesOf(engine).size(), size_t{1});
  run(engine, 10);
  QVERIFY(std::abs(heightOf(engine, 1) - heightOf(engine, 0) - 0.08) < 0.004);  // at rest as it stood
  api::Touch hold = weld({0, 0.12, 0}, 0.05);
  hold.kind = api::TouchKind::Hold;
  hold.force = 400;
  const double low = heightOf(engine, 0);
  for (int frame = 0; frame < 60; ++frame) {
    hold.centre.y = 0.12 + 0.2 * frame / 60;
    engine.apply(TouchMatter{{}, 1, {hold}, {}, 9});
    run(engine, 1);
  }
  run(engine, 30);
  QVERIFY2(heightOf(engine, 0) - low > 0.15, qPrintable(QString::number(heightOf(engine, 0) - low)));
  engine.apply(UndoTouch{kKey});
  QCOMPARE(engine.solver().constraintCount(), ties);
  engine.apply(TouchMatter{{}, 1, {}, {}, 9});  // that hand holds the lower one as well
  engine.apply(TouchMatter{{}, 1, {hold}, {}, 10});
  run(engine, 40);
  QCOMPARE(piecesOf(engine).size(), size_t{2});
  const double apart = heightOf(engine, 1) - heightOf(engine, 0);
  QVERIFY2(heightOf(engine, 0) - low < 0.03 && apart > 0.2,
           qPrintable(QString("%1 %2").arg(heightOf(engine, 0) - low).arg(apart)));
}

void TestCutting::aWeldClosesACut() {
  for (const char* structure : {"bonds", "rigid"}) {
    Engine engine(oneBar(structure), m_plugins);
    run(engine, 2);
    engine.apply(once(blade({0, 0.05, 0})));
    run(engine, 30);
    QCOMPARE(piecesOf(engine).size(), size_t{2});
    engine.apply(once(weld({0, 0.05, 0}, 0.1), 6));
    run(engine, 5);
    QCOMPARE(piecesOf(engine).size(), size_t{1});
    engine.apply(UndoTouch{6});
    run(engine, 5);
    QCOMPARE(piecesOf(engine).size(), size_t{2});
    engine.apply(RedoTouch{6});
    run(engine, 5);
    QCOMPARE(piecesOf(engine).size(), size_t{1});
  }
}

void TestCutting::bladesThatCannotBeAreRefused() {
  Engine engine(oneBar("bonds"), m_plugins);
  QVERIFY_EXCEPTION_THROWN(engine.apply(once(blade({0, 0, 0}, 0.1, {2, 0, 0}))), InputError);
  QVERIFY_EXCEPTION_THROWN(engine.apply(once(blade({0, 0, 0}, 0.1, {std::nan(""), 0, 0}))), InputError);
  api::Touch flat = weld({0, 0, 0}, 0.1);
  flat.normal = {0, 1, 0};
  QVERIFY_EXCEPTION_THROWN(engine.apply(once(flat)), InputError);
}

namespace {

/// Bars of all structures in one scene.
Project manyBars() {
  Project project =
      sceneOf({bar("bonded", "bonds", {0, 0.04, -0.3}, {12, 4, 4}), bar("rigid", "rigid", {0, 0.04, -0.15}, {12, 4, 4}),
               bar("soft", "clusters", {0, 0.04, 0}, {12, 4, 4}), bar("cloth", "cloth", {0, 0.2, 0.15}, {12, 1, 6}),
               bar("rope", "rope", {0, 0.2, 0.3}, {12, 1, 1})});
  return project;
}

/// All are cut, one is welded again, some of it is undone and made again.
std::vector<Command> handsAfter(uint64_t frame) {
  if (frame == 2) return {once(blade({0, 0.05, 0}, 0.6), 5)};
  if (frame == 6) return {once(weld({0, 0.04, -0.3}, 0.08), 6)};
  if (frame == 9) return {once(blade({0.05, 0.04, -0.15}, 0.06, {0, 0, 0}), 7)};
  if (frame == 12) return {UndoTouch{5}};
  if (frame == 15) return {UndoTouch{7}, RedoTouch{5}};
  return {};
}

}  // namespace

void TestCutting::theSameBitsEverywhere() {
  onehash::verify([this]() -> uint64_t {
    Engine engine(manyBars(), m_plugins);
    for (uint64_t frame = 0; frame < 22; ++frame) {
      for (const Command& command : handsAfter(frame)) engine.apply(command);
      if (engine.step().flags) return 0;
    }
    return engine.stateHash();
  });
}

/// Saved with the project it goes on as it would have, and what was cut stays apart.
void TestCutting::aStateKnowsWhatWasCut() {
  Project project = manyBars();
  Engine engine(project, m_plugins);
  engine.apply(once(blade({0, 0.05, 0}, 0.6)));
  run(engine, 5);
  StateBuffer stream;
  saveTo(stream, engine);
  project.state = projectState(stream.bytes(), project.bodies);
  Engine again(project, m_plugins);
  QCOMPARE(again.stateHash(), engine.stateHash());
  run(engine, 40);
  run(again, 40);
  QCOMPARE(again.stateHash(), engine.stateHash());
  QCOMPARE(piecesOf(again).size(), size_t{10});
}

void TestCutting::recordedFramesAreMadeAgain() {
  const Project project = manyBars();
  RunRecord record(size_t{1} << 30);
  const std::map<uint64_t, uint64_t> hashes = recordedrun::recordInto(record, project, m_plugins, 20, handsAfter);
  RunRecord again(size_t{1} << 30);
  recordedrun::throughFile(record, project, m_plugins, again);
  if (QTest::currentTestFailed()) return;
  for (const uint64_t frame : {3, 7, 10, 13, 16, 20}) {
    QCOMPARE(replayed(record.restorePoint(frame).value(), m_plugins)->stateHash(), hashes.at(frame));
    QCOMPARE(replayed(again.restorePoint(frame).value(), m_plugins)->stateHash(), hashes.at(frame));
  }
}

QTEST_GUILESS_MAIN(TestCutting)
#include "tst_cutting.moc"
