// SPDX-License-Identifier: Apache-2.0
// What a hand does to matter: heat is booked, taken back by particle, and made again to the bit; what is pushed or held
// feels no more than the force.
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/io/recording.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/enginethread.h"
#include "core/simulation/projectstate.h"
#include "core/simulation/runrecord.h"
#include "core/simulation/touch.h"
#include "core/solver/solver.h"
#include "tests/physics/onehash.h"
#include "tests/shared/enginehands.h"
#include "tests/shared/recordedrun.h"
#include "tests/shared/scenes.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

using namespace ps;

namespace {

constexpr double kSpacing = 0.03, kScale = 100, kDt = 1.0 / 60;
constexpr MatterKey kKey = 5;

/// Ice on the floor and a second block of it beside, in a tray that lets no heat through.
Project twoBlocks() {
  Project project = scenes::iceOnPlate(6, 300, kScale);
  project.environment = scenes::tray(0.6, 1.2);
  project.bodies.push_back(scenes::block("other", 4, kSpacing, {0.3, 0.06, 0}, 263.15));
  return project;
}

/// All of it, or a ball within the first block.
api::Touch heat(double power, double limit, double radius = 5) {
  api::Touch touch;
  touch.centre = {0, 0.09, 0};
  touch.radius = radius;
  touch.falloff = radius < 1 ? 0.5 : 0;
  touch.power = power;
  touch.limit = limit;
  return touch;
}

api::Touch hold(const api::Double3& centre, double force, double radius) {
  api::Touch touch;
  touch.kind = api::TouchKind::Hold;
  touch.centre = centre;
  touch.radius = radius;
  touch.force = force;
  return touch;
}

TouchMatter still(const api::Touch& touch, MatterKey key = kKey) { return {{}, 1, {touch}, {}, key}; }
TouchMatter letGo(MatterKey key = kKey) { return {{}, 1, {}, {}, key}; }

void run(Engine& engine, int frames) {
  for (int frame = 0; frame < frames; ++frame) {
    const StepReport report = engine.step();
    QCOMPARE(QString::fromStdString(report.message), QString());
  }
}

double energyOf(const Engine& engine, const char* body) {
  const auto& bodies = engine.bodyIds();
  const auto index = static_cast<uint32_t>(std::find(bodies.begin(), bodies.end(), body) - bodies.begin());
  const std::span<const double> energies = engine.solver().thermalEnergies();
  double sum = 0;
  for (size_t i = 0; i < energies.size(); ++i) sum += engine.particles().body()[i] == index ? energies[i] : 0;
  return sum;
}

Vector3 centreOf(const Engine& engine, uint32_t body) {
  Vector3 sum(0, 0, 0);
  double count = 0;
  const ParticleStore& store = engine.particles();
  for (size_t i = 0; i < store.size(); ++i) {
    if (store.body()[i] != body) continue;
    sum += vectorOf(store.position()[i]);
    ++count;
  }
  return sum / count;
}

Vector3 momentumOf(const Engine& engine) {
  Vector3 sum(0, 0, 0);
  const ParticleStore& store = engine.particles();
  for (size_t i = 0; i < store.size(); ++i) sum += store.mass()[i] * vectorOf(store.velocity()[i]);
  return sum;
}

std::pair<double, double> range(const Engine& engine) {
  const double* first = engine.particles().temperature();
  const auto [low, high] = std::minmax_element(first, first + engine.particles().size());
  return {*low, *high};
}

/// Heat is summed over particles and frames: a few hundred roundings of doubles.
bool near(double a, double b, double scale) { return std::abs(a - b) <= 1e-11 * std::abs(scale) + 1e-9; }

}  // namespace

class TestTouch : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup() {
    setThreadCount(0);
    setInstructionSet("");
  }
  void aHandThatStaysGivesItsPower();
  void aPathSharesTheFrame();
  void undoTakesBackFromEachWhatItGot();
  void undoTakesBackAfterAReturnToAState();
  void whatIsGoneGivesNothingBack();
  void limitsHold();
  void nothingIsColderThanCanBe();
  void fixedMatterIsHeatedAndLockedIsSpared();
  void whatCannotBeIsRefused();
  void aHandCarriesAsFarAsItsForceReaches();
  void aHandTakesWhereItClosed();
  void aHandThatIsSeenSeldomThrowsAsFast();
  void aPushIsNoMoreThanItsForce();
  void stirredMatterTurns();
  void aHandFeelsHowHardItWorks();
  void theSameBitsEverywhere_data() { onehash::addRows(); }
  void theSameBitsEverywhere();
  void recordedFramesAreMadeAgain();
  void whoGoesBackHasNoHandInMatter();

 private:
  PluginRegistry m_plugins;
};

void TestTouch::aHandThatStaysGivesItsPower() {
  Engine engine(twoBlocks(), m_plugins);
  const double before = engine.solver().thermalEnergy();
  engine.apply(still(heat(300, 5000, 0.08)));
  run(engine, 12);
  engine.apply(letGo());
  run(engine, 3);
  const double given = 300 * kScale * kDt * 12;
  const HeatLedger& books = engine.solver().heatLedger();
  QVERIFY(near(books.heaters, given, given) && near(books.exchanged, given, given));
  QVERIFY(near(engine.solver().thermalEnergy() - before, given, before));
  QVERIFY(range(engine).second > 264);
}

void TestTouch::aPathSharesTheFrame() {
  Engine engine(twoBlocks(), m_plugins);
  const api::Touch touch = heat(300, 5000, 0.08);
  engine.apply(TouchMatter{{touch, touch, touch}, 3, {touch}, {}, kKey});
  engine.apply(TouchMatter{{touch, touch}, 2, {}, {}, kKey});  // and lets go, before the frame comes
  run(engine, 4);
  QVERIFY(near(engine.solver().heatLedger().heaters, 300 * kScale * kDt, 1));
}

void TestTouch::undoTakesBackFromEachWhatItGot() {
  Engine engine(twoBlocks(), m_plugins);
  const double before = engine.solver().thermalEnergy();
  engine.apply(still(heat(60000, 5000, 0.1)));
  run(engine, 20);
  engine.apply(letGo());
  QVERIFY(range(engine).second > 300);  // it melts
  const double given = engine.solver().heatLedger().heaters;
  std::map<uint32_t, double> got;
  const auto note = [&](double sign) {
    const std::span<const double> energies = engine.solver().thermalEnergies();
    for (size_t i = 0; i < energies.size(); ++i) got[engine.particles().id()[i]] += sign * energies[i];
  };
  note(1);
  engine.apply(UndoTouch{kKey});
  note(-1);
  QVERIFY(near(engine.solver().heatLedger().heaters, 0, given));
  QVERIFY(near(engine.solver().thermalEnergy(), before, given));
  run(engine, 5);
  note(1);
  engine.apply(RedoTouch{kKey});
  note(-1);
  for (const auto& [id, joules] : got) QVERIFY(std::abs(joules) < 1e-6 * given);  // some has been conducted meanwhile
  QVERIFY(near(engine.solver().heatLedger().heaters, given, given));
  engine.apply(UndoTouch{kKey});
  engine.apply(UndoTouch{kKey});  // there is nothing left
  QVERIFY(near(engine.solver().thermalEnergy(), before, given));
  run(engine, 2);
}

/// What it got until the state was kept, not what came later.
void TestTouch::undoTakesBackAfterAReturnToAState() {
  const Project project = twoBlocks();
  Engine engine(project, m_plugins);
  const double before = engine.solver().thermalEnergy();
  engine.apply(still(heat(60000, 5000, 0.1)));
  run(engine, 5);
  const auto names = engine.names();
  StateBuffer stream;
  saveTo(stream, engine);
  const double given = engine.solver().heatLedger().heaters;
  run(engine, 5);
  engine.apply(letGo());
  engine.apply(ReturnToState{projectState(stream.bytes(), project.bodies), names});
  QVERIFY(engine.hands().empty());
  QCOMPARE(engine.solver().heatLedger().heaters, given);
  engine.apply(UndoTouch{kKey});
  QVERIFY(near(engine.solver().thermalEnergy(), before, given));
  engine.apply(RedoTouch{kKey});
  QVERIFY(near(engine.solver().heatLedger().heaters, given, given));
}

void TestTouch::whatIsGoneGivesNothingBack() {
  Engine engine(twoBlocks(), m_plugins);
  const double before = energyOf(engine, "ice");
  engine.apply(still(heat(2000, 5000)));
  run(engine, 5);
  engine.apply(letGo());
  engine.apply(TakeBody{"other", 9});
  engine.apply(UndoTouch{kKey});
  // What the two had exchanged by then stays: they do not touch.
  QVERIFY(near(energyOf(engine, "ice"), before, before));
  engine.apply(PutBack{9});
  QVERIFY(energyOf(engine, "other") > energyOf(engine, "ice") * 64 / 216 + 10);
  engine.apply(RedoTouch{kKey});
  run(engine, 2);
}

void TestTouch::limitsHold() {
  Engine engine(twoBlocks(), m_plugins);
  engine.apply(still(heat(1e9, 270)));
  run(engine, 3);
  QVERIFY(range(engine).second <= 270 + 1e-6 && range(engine).first > 269);
  engine.apply(still(heat(-1e9, 200)));
  run(engine, 20);
  QVERIFY(range(engine).first >= 200 - 1e-6 && range(engine).second < 201);
  // Through both plateaus, though each frame gives no more than would lead to the limit without them.
  engine.apply(still(heat(1e12, 300)));
  run(engine, 60);
  QVERIFY(range(engine).first > 299 && range(engine).second <= 300 + 1e-6);
}

/// Steam, made by a hand; another one cools it as far as can be, and then the first is undone: of what it gave only
/// what is still there can be taken.
void TestTouch::nothingIsColderThanCanBe() {
  Project project = twoBlocks();
  project.bodies.pop_back();
  Engine engine(project, m_plugins);
  engine.apply(still(heat(1e12, 300)));
  run(engine, 60);
  engine.apply(letGo());
  const double given = engine.solver().heatLedger().heaters;
  engine.apply(still(heat(-1e12, 1), 6));
  run(engine, 120);
  engine.apply(letGo(6));
  const double cold = engine.solver().thermalEnergy();
  engine.apply(UndoTouch{kKey});
  QVERIFY(range(engine).first >= 1 - 1e-9 && range(engine).second < 1.5);
  const double taken = cold - engine.solver().thermalEnergy();
  QVERIFY(taken >= 0 && taken < 0.1 * given);
  run(engine, 1);
  engine.apply(RedoTouch{kKey});
  QVERIFY(near(engine.solver().thermalEnergy(), cold, given));
  run(engine, 1);
}

void TestTouch::fixedMatterIsHeatedAndLockedIsSpared() {
  Project project = twoBlocks();
  project.bodies.back().constraints.clear();
  project.bodies.back().parameters.values["fixed"] = true;
  Engine engine(project, m_plugins);
  const double ice = energyOf(engine, "ice"), other = energyOf(engine, "other");
  TouchMatter touch = still(heat(300, 5000));
  touch.spared = {"ice"};
  touch.still.push_back(touch.still[0]);
  touch.still[1].kind = api::TouchKind::Push;
  touch.still[1].force = 1000;
  touch.still[1].velocity = {1, 0, 0};
  engine.apply(touch);
  run(engine, 5);
  QVERIFY(near(energyOf(engine, "ice"), ice, ice));
  QVERIFY(near(energyOf(engine, "other") - other, 300 * kScale * kDt * 5, other));
  // The push would have given 83 kg m/s.
  QVERIFY2(std::abs(momentumOf(engine).x()) < 0.1, qPrintable(QString::number(momentumOf(engine).x())));
}

void TestTouch::whatCannotBeIsRefused() {
  Engine engine(twoBlocks(), m_plugins);
  const uint64_t hash = engine.stateHash();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refuses = [&](const std::function<void(api::Touch&)>& change) {
    api::Touch touch = heat(300, 300);
    change(touch);
    try {
      engine.apply(still(touch));
    } catch (const InputError&) {
      return true;
    }
    return false;
  };
  QVERIFY(refuses([&](api::Touch& t) { t.power = nan; }) && refuses([&](api::Touch& t) { t.centre.y = nan; }));
  QVERIFY(refuses([&](api::Touch& t) { t.radius = 0; }) && refuses([&](api::Touch& t) { t.falloff = 1.5; }));
  QVERIFY(refuses([&](api::Touch& t) { t.limit = 0; }) && refuses([&](api::Touch& t) { t.limit = 2e4; }));
  QVERIFY(refuses([&](api::Touch& t) { t.kind = static_cast<api::TouchKind>(5); }));
  QVERIFY(refuses([&](api::Touch& t) { t.spin = {0, 1e6, 0}; }) && refuses([&](api::Touch& t) { t.force = -1; }));
  QVERIFY(!refuses([](api::Touch& t) { t.power = 0; }));
  engine.apply(UndoTouch{kKey});
  QCOMPARE(engine.stateHash(), hash);
  Project cold = twoBlocks();
  cold.solver.thermalModel.clear();
  Engine without(cold, m_plugins);
  QVERIFY_THROWS_EXCEPTION(InputError, without.apply(still(heat(300, 300))));
  without.apply(still(hold({0, 0.09, 0}, 10, 0.1)));
  run(without, 1);
}

/// A block of 5.3 kg is lifted by 0.3 m in a second, and stays up there, by a grip on a tenth of it too; let go it
/// falls. Half of its weight does not lift it.
void TestTouch::aHandCarriesAsFarAsItsForceReaches() {
  const double weight = 917 * std::pow(6 * kSpacing, 3) * 9.81;
  for (const auto& [share, radius] : {std::pair{4.0, 0.09}, {8.0, 0.05}, {0.5, 0.09}}) {
    Engine engine(twoBlocks(), m_plugins);
    run(engine, 10);
    const Vector3 start = centreOf(engine, 0);
    const auto handAt = [force = share * weight, radius = radius](double y) {
      return hold({0, 0.09 + y, 0}, force, radius);
    };
    engine.apply(still(handAt(0)));
    for (int frame = 1; frame <= 60; ++frame) {
      run(engine, 1);
      engine.apply(still(handAt(0.3 * frame / 60)));
    }
    const double rising = momentumOf(engine).y();
    run(engine, 30);
    const double lifted = centreOf(engine, 0).y() - start.y();
    if (share < 1) {
      QVERIFY2(lifted < 0.01, qPrintable(QString::number(lifted)));
      continue;
    }
    // It hangs by what the ball holds, a part of it: some frames of falling below.
    QVERIFY2(std::abs(lifted - 0.3) < 0.02, qPrintable(QString::number(lifted)));
    QVERIFY2(std::abs(rising / (weight / 9.81) - 0.3) < 0.1, qPrintable(QString::number(rising)));
    engine.apply(letGo());
    run(engine, 6);
    const double fallen = 0.3 - (centreOf(engine, 0).y() - start.y());
    QVERIFY2(fallen > 0.03 && fallen < 0.08, qPrintable(QString::number(fallen)));  // g t^2/2 = 0.05
  }
}

/// However far it has gone by the next frame: a frame may last longer than a hand needs to leave the matter.
void TestTouch::aHandTakesWhereItClosed() {
  const double force = 8 * 917 * std::pow(6 * kSpacing, 3) * 9.81;
  Engine engine(twoBlocks(), m_plugins);
  run(engine, 10);
  const Vector3 start = centreOf(engine, 0);
  engine.apply(still(hold({0, 0.09, 0}, force, 0.09)));
  engine.apply(still(hold({0, 0.39, 0}, force, 0.09)));
  run(engine, 60);
  const double lifted = centreOf(engine, 0).y() - start.y();
  QVERIFY2(std::abs(lifted - 0.3) < 0.02, qPrintable(QString::number(lifted)));
  engine.apply(letGo());
  run(engine, 60);
  QVERIFY(centreOf(engine, 0).y() - start.y() < 0.1);
  engine.apply(still(hold({0, 0.9, 0}, force, 0.09)));  // there is nothing
  engine.apply(still(hold({0, 0.09, 0}, force, 0.09)));
  engine.apply(still(hold({0, 0.39, 0}, force, 0.09)));
  run(engine, 30);
  QVERIFY(centreOf(engine, 0).y() - start.y() < 0.1);
}

/// What is held leaps and waits where its hand comes once in four frames; it flies as fast whenever that lets go, and
/// not at all once it has come to rest. A tenth: a block that has been pulled shakes.
void TestTouch::aHandThatIsSeenSeldomThrowsAsFast() {
  constexpr double kSpeed = 0.5, kMass = 917 * 216 * kSpacing * kSpacing * kSpacing;
  Project project = twoBlocks();
  project.environment.gravity = {0, 0, 0};
  for (const int waited : {0, 1, 2, 3, 20}) {
    Engine engine(project, m_plugins);
    const auto handAt = [](double y) { return hold({0, 0.09 + y, 0}, 500, 0.09); };
    int frames = 0;
    for (int move = 0; move < 15; ++move, frames += 4) {
      engine.apply(still(handAt(kSpeed * kDt * frames)));
      run(engine, move < 14 ? 4 : waited);
    }
    engine.apply(letGo());
    run(engine, 2);
    const double thrown = momentumOf(engine).y() / kMass, wanted = waited < 4 ? kSpeed : 0;
    QVERIFY2(std::abs(thrown - wanted) < 0.1 * kSpeed, qPrintable(QStringLiteral("%1: %2").arg(waited).arg(thrown)));
  }
}

void TestTouch::aPushIsNoMoreThanItsForce() {
  Project project = twoBlocks();
  project.environment.gravity = {0, 0, 0};
  Engine engine(project, m_plugins);
  api::Touch push = hold({0, 0.09, 0}, 20, 0.06);
  push.kind = api::TouchKind::Push;
  push.velocity = {0, 2, 0};
  engine.apply(still(push));
  run(engine, 6);
  engine.apply(letGo());
  const double gained = momentumOf(engine).y();
  QVERIFY2(gained > 0.9 * 20 * kDt * 6 && gained < 1.01 * 20 * kDt * 6, qPrintable(QString::number(gained)));
}

void TestTouch::stirredMatterTurns() {
  Project project = twoBlocks();
  project.environment.gravity = {0, 0, 0};
  project.bodies.pop_back();
  project.bodies[0].constraints.clear();
  project.bodies[0].parameters.values["temperature"] = 300.0;
  Engine engine(project, m_plugins);
  api::Touch stir = hold({0, 0.09, 0}, 100, 0.15);
  stir.kind = api::TouchKind::Push;
  stir.spin = {0, 6, 0};
  engine.apply(still(stir));
  run(engine, 10);
  double turning = 0, inertia = 0;
  const ParticleStore& store = engine.particles();
  for (size_t i = 0; i < store.size(); ++i) {
    const api::Float4 &p = store.position()[i], &v = store.velocity()[i];
    turning += store.mass()[i] * (double{p.z} * v.x - double{p.x} * v.z);
    inertia += store.mass()[i] * (double{p.x} * p.x + double{p.z} * p.z);
  }
  QVERIFY2(turning / inertia > 2 && turning / inertia < 6.1, qPrintable(QString::number(turning / inertia)));
}

namespace {

/// N, of what the hand feels; 0: nothing.
double effortOf(const Engine& engine) {
  const SnapshotPtr snapshot = engine.snapshot();
  const std::vector<ToolContact>& all = snapshot->tools;
  const auto found = std::find_if(all.begin(), all.end(), [](const auto& one) { return one.body == contactOf(kKey); });
  return found == all.end() ? 0 : found->force.norm();
}

}  // namespace

/// While it speeds up what it holds, and not its weight: a tenth of that is left of a block that shakes, twice over. A
/// push of 20 N is felt as 12.6 after a tenth of a second, by the share 1 - 1/e of what is smoothed over as long; the
/// push itself is 90 to 100 % of the force. One that pushes as it goes is at work in some frames only, and feels that
/// until it fades. Where a hand is gone nothing is felt.
void TestTouch::aHandFeelsHowHardItWorks() {
  const double weight = 917 * std::pow(6 * kSpacing, 3) * 9.81;
  Engine lifting(twoBlocks(), m_plugins);
  run(lifting, 10);
  double most = 0;
  for (int frame = 0; frame <= 15; ++frame) {
    lifting.apply(still(hold({0, 0.09 + 0.3 * frame / 15, 0}, 4 * weight, 0.09)));
    run(lifting, 1);
    most = std::max(most, effortOf(lifting));
  }
  QVERIFY2(most > 0.4 * weight && most < 3 * weight, qPrintable(QString::number(most)));
  run(lifting, 60);
  QVERIFY2(effortOf(lifting) < 0.2 * weight, qPrintable(QString::number(effortOf(lifting))));
  lifting.apply(letGo());
  run(lifting, 1);
  QCOMPARE(effortOf(lifting), 0.0);

  Project project = twoBlocks();
  project.environment.gravity = {0, 0, 0};
  Engine pushing(project, m_plugins), stirring(project, m_plugins);
  api::Touch push = hold({0, 0.09, 0}, 20, 0.06), stir = hold({0, 0.09, 0}, 100, 0.15);
  push.kind = stir.kind = api::TouchKind::Push;
  push.velocity = {0, 2, 0};
  stir.spin = {0, 6, 0};
  pushing.apply(still(push));
  run(pushing, 6);
  QVERIFY2(effortOf(pushing) > 10.5 && effortOf(pushing) < 12.8, qPrintable(QString::number(effortOf(pushing))));
  Engine along(project, m_plugins);
  for (int frame = 0; frame < 6; ++frame) {
    along.apply(TouchMatter{{push}, 1, {}, {}, kKey});
    run(along, 1);
    QVERIFY(along.hands().empty());
    along.apply(letGo());  // it has not come far enough for another place
  }
  QCOMPARE(effortOf(along), effortOf(pushing));
  run(along, 60);
  QCOMPARE(effortOf(along), 0.0);
  stirring.apply(still(stir));  // all round: no way is the stronger one
  run(stirring, 2);
  QVERIFY2(effortOf(stirring) > 5 && effortOf(stirring) < 31, qPrintable(QString::number(effortOf(stirring))));
}

namespace {

/// A hand that heats and stirs on its way, another one that holds, and an undo.
std::vector<Command> handsAfter(uint64_t frame) {
  api::Touch stir = hold({0.02 * static_cast<double>(frame), 0.12, 0}, 40, 0.12);
  stir.kind = api::TouchKind::Push;
  stir.spin = {0, 5, 0};
  api::Touch warm = heat(20000, 400, 0.12);
  warm.centre = stir.centre;
  if (frame == 2) return {TouchMatter{{warm, stir, warm, stir}, 2, {warm, stir}, {}, 5}};
  if (frame == 6) return {TouchMatter{{warm, stir}, 1, {warm, stir}, {}, 5}, still(hold({0.3, 0.06, 0}, 60, 0.05), 6)};
  if (frame == 12) return {letGo(5), still(hold({0.3, 0.1, 0.02}, 60, 0.05), 6)};
  if (frame == 15) return {UndoTouch{5}};
  if (frame == 18) return {letGo(6), RedoTouch{5}};
  return {};
}

}  // namespace

void TestTouch::theSameBitsEverywhere() {
  onehash::verify([this]() -> uint64_t {
    Engine engine(twoBlocks(), m_plugins);
    for (uint64_t frame = 0; frame < 22; ++frame) {
      for (const Command& command : handsAfter(frame)) engine.apply(command);
      if (engine.step().flags) return 0;
    }
    return engine.stateHash();
  });
}

/// From the states of a record, and from its file, which does without those in which a hand is at work.
void TestTouch::recordedFramesAreMadeAgain() {
  const Project project = twoBlocks();
  RunRecord record(size_t{1} << 30);
  const std::map<uint64_t, uint64_t> hashes = recordedrun::recordInto(record, project, m_plugins, 24, handsAfter);
  for (const uint64_t frame : {3, 9, 13, 15, 19, 24}) {
    const RestorePoint point = record.restorePoint(frame).value();
    QCOMPARE(point.from, frame / 4 * 4);
    QCOMPARE(replayed(point, m_plugins)->stateHash(), hashes.at(frame));
  }
  RunRecord again(size_t{1} << 30);
  recordedrun::throughFile(record, project, m_plugins, again);
  if (QTest::currentTestFailed()) return;
  for (const uint64_t frame : {1, 9, 13, 17, 24}) {
    const RestorePoint point = again.restorePoint(frame).value();
    QCOMPARE(point.from, frame < 20 ? uint64_t{0} : frame / 4 * 4);
    QCOMPARE(replayed(point, m_plugins)->stateHash(), hashes.at(frame));
  }
}

/// To a moment at which one was: what goes on from there goes on without it, and is made again so.
void TestTouch::whoGoesBackHasNoHandInMatter() {
  EngineThread engine(m_plugins, nullptr);
  const auto heaters = [&] {
    return tests::onEngine<double>(engine, [](Engine& e) { return e.solver().heatLedger().heaters; });
  };
  engine.open(twoBlocks(), false);
  engine.apply(still(heat(300, 5000)));
  for (int frame = 0; frame < 6; ++frame) engine.stepOnce();
  engine.apply(letGo());
  const double one = heaters() / 6;
  engine.continueFrom(3, false);
  QVERIFY(near(heaters(), 3 * one, one));
  for (int frame = 0; frame < 3; ++frame) engine.stepOnce();
  QVERIFY(near(heaters(), 3 * one, one));
  const uint64_t hash = tests::onEngine<uint64_t>(engine, [](Engine& e) { return e.stateHash(); });
  engine.recording().settle();
  QCOMPARE(replayed(engine.recording().restorePoint(6).value(), m_plugins)->stateHash(), hash);
  engine.apply(UndoTouch{kKey});
  QVERIFY(near(heaters(), 0, one));
}

QTEST_GUILESS_MAIN(TestTouch)
#include "tst_touch.moc"
