// SPDX-License-Identifier: Apache-2.0
// Matter made of another material by hand: in its place and as warm as it is, with books that close, and taken back by
// particle, to the bit where nothing has gone on meanwhile.
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/io/recording.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/enginethread.h"
#include "core/simulation/projectstate.h"
#include "core/simulation/runrecord.h"
#include "core/solver/solver.h"
#include "tests/physics/onehash.h"
#include "tests/shared/enginehands.h"
#include "tests/shared/recordedrun.h"
#include "tests/shared/scenes.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

using namespace ps;

namespace {

constexpr double kSpacing = 0.03;
constexpr MatterKey kKey = 5;

SceneMaterial material(const char* id) {
  SceneMaterial material;
  material.id = material.base = material.label = id;
  return material;
}

/// Ice on the floor and water beside, in a tray that lets no heat through, with a solid and a liquid to paint with.
Project iceAndWater() {
  Project project = scenes::iceOnPlate(6, 300, 100);
  project.environment = scenes::tray(0.6, 1.2);
  project.bodies.push_back(scenes::block("pool", 6, kSpacing, {0.3, 0.09, 0}, 293.15));
  for (const char* id : {"iron", "ethanol"}) project.materials.push_back(material(id));
  return project;
}

/// Cells of the lattice that the ice was born on, `side` of them from its lowest corner on.
VoxelShape lattice(const Vector3& corner) {
  VoxelShape shape;
  shape.origin = corner;
  shape.spacing = kSpacing;
  return shape;
}
const Vector3 kIce{-0.075, 0.015, -0.075}, kPool{0.225, 0.015, -0.075};

CellIndices cube(int side, int x = 0, int y = 0, int z = 0) {
  CellIndices cells;
  for (int k = 0; k < side * side * side; ++k)
    cells.push_back({x + k % side, y + k / side % side, z + k / side / side});
  return cells;
}

PaintCells paint(const char* id, const CellIndices& cells, const Vector3& corner = kIce, MatterKey key = kKey) {
  return {lattice(corner), cells, id, {}, key};
}

void run(Engine& engine, int frames) {
  for (int frame = 0; frame < frames; ++frame) {
    const StepReport report = engine.step();
    QCOMPARE(QString::fromStdString(report.message), QString());
  }
}

/// What is compared of a particle, by its id.
struct One {
  uint32_t material;
  float mass, volume;
  double temperature;
  bool operator==(const One&) const = default;
};
std::map<uint32_t, One> all(const Engine& engine) {
  std::map<uint32_t, One> list;
  const ParticleStore& store = engine.particles();
  for (size_t i = 0; i < store.size(); ++i)
    list[store.id()[i]] = {store.material()[i], store.mass()[i], store.position()[i].w, store.temperature()[i]};
  return list;
}
size_t count(const Engine& engine, uint32_t material) {
  const uint32_t* first = engine.particles().material();
  return static_cast<size_t>(std::count(first, first + engine.particles().size(), material));
}

/// J that nobody has booked: sums of some hundred doubles, rounded.
double open(const Engine& engine) { return engine.solver().thermalEnergy() - engine.solver().heatLedger().net(); }
bool near(double a, double b, double scale) { return std::abs(a - b) <= 1e-11 * std::abs(scale) + 1e-9; }

}  // namespace

class TestPaint : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup() {
    setThreadCount(0);
    setInstructionSet("");
  }
  void matterStaysAsWarmAndFillsAsMuchRoom();
  void undoIsExactWhereNothingWentOn_data();
  void undoIsExactWhereNothingWentOn();
  void undoTakesBackWhereMatterIsByNow();
  void whatCannotBeSolidMelts();
  void whatIsSolidHoldsTogether();
  void aRigidBodyStaysInItsPlace();
  void whatStaysAsItIs();
  void aReturnToAStateKnowsWhatWasPainted();
  void aResetKnowsWhatWasPainted();
  void aRunIsMadeAgainFromBeforeAnUndo();
  void manyEditsLeaveNothingBehind();
  void theSameBitsEverywhere_data() { onehash::addRows(); }
  void theSameBitsEverywhere();
  void recordedFramesAreMadeAgain();

 private:
  PluginRegistry m_plugins;
};

void TestPaint::matterStaysAsWarmAndFillsAsMuchRoom() {
  Engine engine(iceAndWater(), m_plugins);
  run(engine, 3);
  const auto before = all(engine);
  const double openBefore = open(engine), energy = engine.solver().thermalEnergy();
  engine.apply(paint("iron", cube(3)));
  QCOMPARE(count(engine, 1), size_t{27});
  const auto after = all(engine);
  for (const auto& [id, now] : after) {
    const One was = before.at(id);
    if (now.material == 0) {
      QVERIFY(now == was);
      continue;
    }
    QVERIFY(std::abs(now.temperature - was.temperature) < 1e-6);  // from its energy: a rounding of 1e5 J in doubles
    QVERIFY(std::abs(now.volume / was.volume - 1) < 1e-6);        // of single precision
    QVERIFY(now.mass > 8 * was.mass && now.mass < 9 * was.mass);  // 7870 against 917 kg/m³
  }
  QVERIFY(std::abs(engine.solver().thermalEnergy() - energy) > 1);
  QVERIFY(near(open(engine), openBefore, energy));
  run(engine, 5);
}

void TestPaint::undoIsExactWhereNothingWentOn_data() {
  QTest::addColumn<int>("frames");
  QTest::newRow("at the start") << 0;
  QTest::newRow("in a run") << 10;
}
void TestPaint::undoIsExactWhereNothingWentOn() {
  QFETCH(int, frames);
  Engine engine(iceAndWater(), m_plugins);
  run(engine, frames);
  std::vector<uint64_t> hashes{engine.stateHash()};
  const std::vector<Command> strokes[] = {{paint("iron", cube(3)), paint("iron", cube(3, 2, 0, 0))},
                                          {paint("ethanol", cube(4, 1, 1, 1), kIce, 6)},
                                          {paint("iron", cube(3), kPool, 7)}};
  for (const auto& stroke : strokes) {
    for (const Command& command : stroke) engine.apply(command);
    hashes.push_back(engine.stateHash());
  }
  for (int turn = 0; turn < 2; ++turn) {
    for (const MatterKey key : {7, 6, 5}) {
      engine.apply(UndoTouch{key});
      hashes.pop_back();
      QCOMPARE(engine.stateHash(), hashes.back());
    }
    for (const MatterKey key : {5, 6, 7}) {
      engine.apply(RedoTouch{key});
      hashes.push_back(engine.stateHash());
    }
  }
  for (const MatterKey key : {7, 6, 5}) engine.apply(UndoTouch{key});
  QCOMPARE(engine.stateHash(), hashes.front());
  run(engine, 2);
}

/// What flows has gone elsewhere, and some of it has been taken away: each that is left has its own mass and material
/// again, and its temperature of by then.
void TestPaint::undoTakesBackWhereMatterIsByNow() {
  Engine engine(iceAndWater(), m_plugins);
  run(engine, 2);
  const auto before = all(engine);
  const double openBefore = open(engine);
  engine.apply(paint("ethanol", cube(6), kPool));
  QVERIFY(count(engine, 2) > 200);
  run(engine, 30);
  engine.apply(TakeCells{lattice(kPool), cube(2), {}, 9});
  const auto meanwhile = all(engine);
  QVERIFY(meanwhile.size() < before.size());
  engine.apply(UndoTouch{kKey});
  QCOMPARE(count(engine, 2), size_t{0});
  for (const auto& [id, now] : all(engine)) {
    QCOMPARE(now.material, before.at(id).material);
    QCOMPARE(now.mass, before.at(id).mass);
    QVERIFY(std::abs(now.temperature - meanwhile.at(id).temperature) < 1e-6);
  }
  QVERIFY(near(open(engine), openBefore, engine.solver().thermalEnergy()));
  run(engine, 5);
  engine.apply(RedoTouch{kKey});
  QVERIFY(count(engine, 2) > 200 - 8);
  run(engine, 5);
}

/// Ethanol of −10 °C is liquid: it runs out of the ice.
void TestPaint::whatCannotBeSolidMelts() {
  Engine engine(iceAndWater(), m_plugins);
  engine.apply(paint("ethanol", cube(6)));
  const ParticleStore& store = engine.particles();
  size_t liquid = 0;
  for (size_t i = 0; i < store.size(); ++i)
    liquid += store.material()[i] == 2 && store.motion()[i] == api::Motion::Liquid ? 1 : 0;
  QCOMPARE(liquid, size_t{216});
  const size_t ties = engine.solver().constraintCount();
  QVERIFY(ties > 200);
  run(engine, 40);
  QCOMPARE(engine.solver().constraintCount(), size_t{0});
  double height = 0;
  for (size_t i = 0; i < store.size(); ++i)
    if (store.material()[i] == 2) height += store.position()[i].y / 216;
  QVERIFY2(height < 0.075, qPrintable(QString::number(height)));  // it stood at 0.09
}

/// Iron of 20 °C is solid: what was water freezes to a lump, and what was ice keeps its ties.
void TestPaint::whatIsSolidHoldsTogether() {
  Engine engine(iceAndWater(), m_plugins);
  run(engine, 2);
  const size_t ties = engine.solver().constraintCount();
  engine.apply(paint("iron", cube(3)));
  run(engine, 2);
  QCOMPARE(engine.solver().constraintCount(), ties);
  engine.apply(paint("iron", cube(6), kPool, 6));
  run(engine, 3);
  QVERIFY(engine.solver().constraintCount() > ties + 216);
  run(engine, 10);
}

/// One half of iron: its centre of mass is elsewhere, but nothing of it leaps there.
void TestPaint::aRigidBodyStaysInItsPlace() {
  Project project = iceAndWater();
  project.environment.gravity = {0, 0, 0};
  project.bodies.resize(1);
  project.bodies[0].constraints = {{"rigid", {}, {}}};
  Engine engine(project, m_plugins);
  run(engine, 2);
  std::map<uint32_t, Vector3> before;
  const ParticleStore& store = engine.particles();
  for (size_t i = 0; i < store.size(); ++i) before[store.id()[i]] = vectorOf(store.position()[i]);
  engine.apply(paint("iron", cube(3)));
  run(engine, 2);
  engine.apply(UndoTouch{kKey});
  run(engine, 2);
  for (size_t i = 0; i < store.size(); ++i)
    QVERIFY((vectorOf(store.position()[i]) - before.at(store.id()[i])).norm() < 1e-4 * kSpacing);
}

void TestPaint::whatStaysAsItIs() {
  Project project = iceAndWater();
  project.bodies[0].constraints.clear();
  project.bodies[0].parameters.values["fixed"] = true;
  Engine engine(project, m_plugins);
  const uint64_t hash = engine.stateHash();
  QVERIFY_THROWS_EXCEPTION(InputError, engine.apply(paint("gold", cube(3))));
  engine.apply(paint("water", cube(3)));                                    // what it is already
  engine.apply(PaintCells{lattice(kIce), cube(6), "iron", {"ice"}, kKey});  // a locked body
  engine.apply(UndoTouch{kKey});
  engine.apply(RedoTouch{kKey});
  QCOMPARE(engine.stateHash(), hash);
  engine.apply(paint("ethanol", cube(6)));
  const ParticleStore& store = engine.particles();
  for (size_t i = 0; i < store.size(); ++i)
    QCOMPARE(store.velocity()[i].w == 0, store.material()[i] == 2);  // fixed as before
  run(engine, 3);
  engine.apply(paint("iron", cube(2), kPool, 7));
  QCOMPARE(engine.snapshot()->erasedOrPainted, std::vector<MatterKey>({7}));  // the scene had begun
  engine.apply(UndoTouch{7});
  QVERIFY(engine.snapshot()->erasedOrPainted.empty());
}

/// Undo takes back what had been painted when the state was kept, wherever it is there, and nothing that came later.
void TestPaint::aReturnToAStateKnowsWhatWasPainted() {
  Project project = iceAndWater();
  Engine engine(project, m_plugins);
  const std::map<uint32_t, One> before = all(engine);
  engine.apply(paint("iron", cube(3)));
  run(engine, 4);
  StateBuffer stream;
  saveTo(stream, engine);
  const auto state = projectState(stream.bytes(), project.bodies);
  const auto names = engine.names();
  engine.apply(paint("ethanol", cube(5), kPool, 6));
  engine.apply(UndoTouch{kKey});
  run(engine, 3);
  QCOMPARE(engine.snapshot()->erasedOrPainted, std::vector<MatterKey>({6}));  // the other one painted at the start
  engine.apply(ReturnToState{state, names});
  QVERIFY(engine.snapshot()->erasedOrPainted.empty());
  const uint64_t painted = engine.stateHash();
  QCOMPARE(count(engine, 1), size_t{27});
  QCOMPARE(count(engine, 2), size_t{0});
  engine.apply(UndoTouch{6});
  QCOMPARE(engine.stateHash(), painted);
  engine.apply(UndoTouch{kKey});
  QCOMPARE(count(engine, 1), size_t{0});
  for (const auto& [id, one] : all(engine)) QCOMPARE(one.mass, before.at(id).mass);
  engine.apply(RedoTouch{kKey});
  QCOMPARE(count(engine, 1), size_t{27});
  // Without names, nothing is known of it.
  engine.apply(ReturnToState{state});
  engine.apply(UndoTouch{kKey});
  QCOMPARE(engine.stateHash(), painted);
}

/// The document has what was painted at the start: undo makes it of what it was painted from.
void TestPaint::aResetKnowsWhatWasPainted() {
  Engine engine(iceAndWater(), m_plugins);
  engine.apply(Reset{{NameMatter{kKey, "ice", lattice(kIce), cube(2), "iron"},
                      NameMatter{kKey, "ice", lattice(kIce), cube(2, 3, 3, 3), "ethanol"}}});
  const uint64_t hash = engine.stateHash();
  engine.apply(UndoTouch{kKey});
  QCOMPARE(count(engine, 1), size_t{8});
  QCOMPARE(count(engine, 2), size_t{8});
  engine.apply(RedoTouch{kKey});
  QCOMPARE(engine.stateHash(), hash);
  run(engine, 5);
  engine.apply(UndoTouch{kKey});
  QCOMPARE(count(engine, 1), size_t{8});
}

/// Its file knows by edits what the first state of a run knows by name: all frames can be gone on from.
void TestPaint::aRunIsMadeAgainFromBeforeAnUndo() {
  const Project project = iceAndWater();
  EngineThread thread(m_plugins, [] {});
  thread.open(project, false);
  thread.apply(Reset{{NameMatter{kKey, "ice", lattice(kIce), cube(2), "iron"}}});
  std::map<uint64_t, uint64_t> hashes;
  for (uint64_t frame = 0; frame < 6; ++frame) {
    if (frame == 4) thread.apply(UndoTouch{kKey});
    hashes[frame] = tests::onEngine<uint64_t>(thread, [](Engine& engine) { return engine.stateHash(); });
    thread.stepOnce();
    QTRY_COMPARE(thread.snapshot()->stats.frame, frame + 1);
  }
  thread.recording().settle();
  RunRecord again(size_t{1} << 30);
  recordedrun::throughFile(thread.recording(), project, m_plugins, again);
  if (QTest::currentTestFailed()) return;
  for (const uint64_t frame : {0, 2, 3, 5}) {
    const auto point = again.restorePoint(frame);
    QVERIFY2(point, qPrintable(QString::number(frame)));
    const auto engine = replayed(*point, m_plugins);
    QCOMPARE(engine->stateHash(), hashes.at(frame));
    QCOMPARE(count(*engine, 1), frame < 4 ? size_t{0} : size_t{8});
  }
  const auto engine = replayed(thread.recording().restorePoint(2).value(), m_plugins);
  engine->apply(UndoTouch{kKey});
  QCOMPARE(count(*engine, 1), size_t{8});
}

/// Painting, erasing, drawing, heating, undo and redo of all of them in any order while matter flows: nobody is lost,
/// nobody stays painted, and the books close.
void TestPaint::manyEditsLeaveNothingBehind() {
  Engine engine(iceAndWater(), m_plugins);
  run(engine, 1);  // what comes and goes at the start is in no book
  const auto before = all(engine);
  const double openBefore = open(engine);
  std::mt19937 random(7);
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  struct Done {
    MatterKey key;
    bool erased;
  };
  std::vector<Done> done, undone;
  const auto undo = [&](const Done& edit) {
    edit.erased ? engine.apply(PutBack{edit.key}) : engine.apply(UndoTouch{edit.key});
  };
  const auto redo = [&](const Done& edit) {
    edit.erased ? engine.apply(TakeMatter{edit.key, lattice(kIce), {}}) : engine.apply(RedoTouch{edit.key});
  };
  for (MatterKey edit = 1; edit <= 400; ++edit) {
    const Vector3 corner = pick(2) == 0 ? kIce : kPool;
    const CellIndices cells = cube(2 + pick(3), pick(5), pick(5), pick(5));
    const int what = pick(8);
    if (what < 3) {
      engine.apply(paint(pick(2) == 0 ? "iron" : "ethanol", cells, corner, edit));
    } else if (what < 5) {
      engine.apply(TakeCells{lattice(corner), cells, {}, edit});
    } else if (what == 5 && !done.empty()) {
      undo(done.back());
      undone.push_back(done.back());
      done.pop_back();
      continue;
    } else if (what == 6 && !undone.empty()) {
      redo(undone.back());
      done.push_back(undone.back());
      undone.pop_back();
      continue;
    } else {
      run(engine, 1);
      continue;
    }
    done.push_back({edit, what >= 3});
    undone.clear();
  }
  QVERIFY(done.size() > 50);
  for (; !done.empty(); done.pop_back()) undo(done.back());
  const auto after = all(engine);
  QCOMPARE(after.size(), before.size());
  for (const auto& [id, now] : after) {
    QCOMPARE(now.material, uint32_t{0});
    QCOMPARE(now.mass, before.at(id).mass);
  }
  // Edits book some 1e6 J to and fro, each with a rounding of the whole.
  const double scale = engine.solver().heatLedger().exchanged + engine.solver().thermalEnergy();
  QVERIFY2(near(open(engine), openBefore, 100 * scale), qPrintable(QString::number(open(engine) - openBefore)));
}

namespace {

std::vector<Command> strokesAfter(uint64_t frame) {
  if (frame == 2) return {paint("iron", cube(3)), paint("iron", cube(3, 2, 1, 0))};
  if (frame == 5) return {paint("ethanol", cube(5), kPool, 6)};
  if (frame == 9) return {UndoTouch{5}};
  if (frame == 13) return {RedoTouch{5}, UndoTouch{6}};
  return {};
}

}  // namespace

void TestPaint::theSameBitsEverywhere() {
  onehash::verify([this]() -> uint64_t {
    Engine engine(iceAndWater(), m_plugins);
    for (uint64_t frame = 0; frame < 16; ++frame) {
      for (const Command& command : strokesAfter(frame)) engine.apply(command);
      if (engine.step().flags) return 0;
    }
    return engine.stateHash();
  });
}

/// From the states of a record, and from its file, where edits are written as JSON.
void TestPaint::recordedFramesAreMadeAgain() {
  const Project project = iceAndWater();
  RunRecord record(size_t{1} << 30);
  const std::map<uint64_t, uint64_t> hashes = recordedrun::recordInto(record, project, m_plugins, 17, strokesAfter);
  for (const uint64_t frame : {3, 7, 11, 15, 17})
    QCOMPARE(replayed(record.restorePoint(frame).value(), m_plugins)->stateHash(), hashes.at(frame));
  RunRecord again(size_t{1} << 30);
  recordedrun::throughFile(record, project, m_plugins, again);
  if (QTest::currentTestFailed()) return;
  for (const uint64_t frame : {1, 7, 11, 17})
    QCOMPARE(replayed(again.restorePoint(frame).value(), m_plugins)->stateHash(), hashes.at(frame));
}

QTEST_GUILESS_MAIN(TestPaint)
#include "tst_paint.moc"
