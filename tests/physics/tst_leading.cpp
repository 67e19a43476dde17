// SPDX-License-Identifier: Apache-2.0
// Tools that hands lead through matter: they come to where they are led, meet what is in their way at any speed, and
// tell what they feel.
#include "core/base/parallel.h"
#include "core/base/statestream.h"
#include "core/io/recording.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/commandqueue.h"
#include "core/simulation/runrecord.h"
#include "tests/physics/leadingscene.h"
#include "tests/physics/onehash.h"
#include "tests/shared/recordedrun.h"

#include <QTest>

#include <Eigen/Geometry>

#include <cmath>
#include <map>

using namespace ps;
using namespace leading;

namespace {

const RigidMove kTurned{Quaternion(Eigen::AngleAxisd(1.1, Vector3(2, -1, 2) / 3)), {0.1, 0.05, -0.08}};

/// Water a hand deep in a tray, and a plate upright in it.
Project tub() {
  Project project = scene(0.3, 1);
  project.bodies.push_back(tool({0.04, 0.2, 0.16}, {-0.2, 0.14, 0}));
  project.bodies.push_back(solid("water", "block", {0.48, 0.16, 0.56}, {0.05, 0.08, 0}, 300));
  return project;
}

/// Stirred there and back, and turned meanwhile.
void stir(Engine& engine, int frame) {
  const double fast = frame % 4 == 0 ? 0.1 : 0.015, way = (frame / 4) % 2 == 0 ? fast : -fast;
  RigidMove move{Quaternion::Identity(), {way, 0, 0}};
  if (frame % 3 == 0) {
    move = RigidMove::about(pivotOf(engine.project().bodies[0]), Quaternion(Eigen::AngleAxisd(0.6, Vector3(0, 1, 0))));
    move.shift += Vector3(way, 0, 0.002);
  }
  lead(engine, move);
}

}  // namespace

class TestLeading : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { setThreadCount(2); }
  void cleanup() {
    setThreadCount(0);
    setInstructionSet("");
  }
  void itComesToWhereItIsLed();
  void itsOwnTurnGoesOn();
  void whatIsLooseIsCarried();
  void noFasterThanAHand();
  void nothingPassesIt_data();
  void nothingPassesIt();
  void whatIsStruckStaysWhole_data();
  void whatIsStruckStaysWhole();
  void waterIsNotBlownApart_data();
  void waterIsNotBlownApart();
  void itPressesAndIsPressed();
  void whatItTouchesMeltsAndIsTold();
  void oneHash_data() { onehash::addRows(); }
  void twoHandsFeelTheirOwn();
  void oneHash();
  void aStateOnTheWayGoesOn();
  void aRecordedRunIsMadeAgain();
  void stepsThatWaitAreJoined();

 private:
  PluginRegistry m_plugins;
};

/// As if it had been put there at once, in several steps on the way, and then it stands.
void TestLeading::itComesToWhereItIsLed() {
  Project project = scene(1, 2);
  project.bodies.push_back(tool({0.2, 0.06, 0.1}, {0, 1, 0}));
  Engine led(project, m_plugins), put(project, m_plugins);
  const RigidMove half{Quaternion::Identity(), {-0.3, 0.1, 0.2}};
  const Body first = moved(project.bodies[0], half), then = moved(first, kTurned);
  put.apply(MoveBody{std::make_shared<const Body>(first), half});
  put.apply(MoveBody{std::make_shared<const Body>(then), kTurned});
  lead(led, half);
  play(led, 3);
  QVERIFY(seen(led, "tool").fastest > 1);
  QVERIFY(led.snapshot()->tools.at(0).behind > 0.02);
  lead(led, kTurned);
  QVERIFY(led.project().bodies[0].shape == then.shape);
  play(led, 40);
  QVERIFY2(farthest(seen(led, "tool"), seen(put, "tool")) < kSingle,
           qPrintable(QString::number(farthest(seen(led, "tool"), seen(put, "tool")))));
  QCOMPARE(seen(led, "tool").fastest, 0.0);
  QCOMPARE(led.snapshot()->tools.at(0).behind, 0.0);
  led.reset();
  QVERIFY(farthest(seen(led, "tool"), seen(put, "tool")) < kSingle);
  QVERIFY(led.snapshot()->tools.empty());
}

/// A whisk.
void TestLeading::itsOwnTurnGoesOn() {
  Project project = scene(1, 2);
  project.bodies.push_back(tool({0.2, 0.06, 0.1}, {0, 1, 0}));
  project.bodies[0].spin = {0, 3, 0};
  Engine led(project, m_plugins), left(project, m_plugins);
  const Vector3 way(0.2, 0.1, 0);
  lead(led, way);
  play(led, 40);
  play(left, 40);
  const Seen there = seen(left, "tool");
  for (const auto& [id, place] : seen(led, "tool").places)
    QVERIFY((place - there.places.at(id) - way).norm() < 2 * kSingle);
}

/// What is not held in place is none that meets anything on its way: it is put there.
void TestLeading::whatIsLooseIsCarried() {
  Project project = scene(1, 2);
  project.environment.gravity = {0, 0, 0};
  project.bodies.push_back(solid("tool", "block", {0.1, 0.1, 0.1}, {0, 1, 0}, 260));
  project.bodies[0].constraints.push_back({"bonds", {}, {}});
  Engine engine(project, m_plugins);
  const Seen before = seen(engine, "tool");
  lead(engine, Vector3(0.2, 0, 0));
  QVERIFY(std::abs(seen(engine, "tool").low.x() - before.low.x() - 0.2) < kSingle);
  QVERIFY(engine.snapshot()->tools.empty());
}

/// A leap of 100 spacings in a frame, which is 120 m/s, is made at 20 m/s.
void TestLeading::noFasterThanAHand() {
  Project project = scene(3, 2);
  project.bodies.push_back(tool({0.1, 0.06, 0.1}, {-2, 1, 0}));
  Engine engine(project, m_plugins);
  lead(engine, Vector3(100 * kSpacing, 0, 0));
  double fastest = 0;
  for (int frame = 0; frame < 30; ++frame) {
    play(engine, 1);
    fastest = std::max(fastest, seen(engine, "tool").fastest);
  }
  QVERIFY2(fastest > 19.9 && fastest < 20.1, qPrintable(QString::number(fastest)));
  QVERIFY(std::abs(seen(engine, "tool").high.x() + 2 - 0.04 - 100 * kSpacing) < 1e-5);
}

void TestLeading::nothingPassesIt_data() {
  QTest::addColumn<QString>("structure");
  QTest::addColumn<QString>("held");
  QTest::addColumn<double>("speed");
  for (const double speed : {1.0, 10.0, 100 * kSpacing / kDt}) {
    const QString name = QString::number(speed) + QStringLiteral(" m/s, ");
    QTest::addRow("%sa cloth held at two edges", qPrintable(name)) << "cloth"
                                                                   << "ends" << speed;
    QTest::addRow("%sa loose cloth", qPrintable(name)) << "cloth"
                                                       << "none" << speed;
    QTest::addRow("%sgrains", qPrintable(name)) << ""
                                                << "none" << speed;
  }
}

/// Down through a sheet that is one particle thick: what was below the tool stays below it.
void TestLeading::nothingPassesIt() {
  QFETCH(QString, structure);
  QFETCH(QString, held);
  QFETCH(double, speed);
  Project project = scene(1, 3);
  project.environment.gravity = {0, 0, 0};
  project.environment.boundsMinimum.y() = -2;
  project.environment.walls.clear();
  project.bodies.push_back(tool({0.16, 0.04, 0.16}, {0, 1.3, 0}));
  Body sheet = solid("sheet", "sheet", {0.4, kSpacing, 0.4}, {0, 1, 0}, 260);
  std::get<SolidShape>(sheet.shape).parameters.values["held"] = held.toStdString();
  if (!structure.isEmpty()) sheet.constraints.push_back({structure.toStdString(), {}, {}});
  project.bodies.push_back(sheet);
  Engine engine(project, m_plugins);
  const Seen start = seen(engine, "sheet");
  const double step = speed * kDt;
  double force = 0, left = 0.5;
  for (int frame = 0, still = 0; still < 4; ++frame) {  // after that a cloth that was stretched flies back around it
    lead(engine, Vector3(0, -std::clamp(left, 0.0, step), 0));
    left -= step;
    play(engine, 1);
    const ToolContact& felt = engine.snapshot()->tools.at(0);
    force = std::max(force, felt.force.norm());
    still += left <= 0 && felt.behind < 0.01;
    const Seen now = seen(engine, "sheet"), plate = seen(engine, "tool");
    for (const auto& [id, place] : now.places) {
      const Vector3& was = start.places.at(id);
      if (std::max(std::abs(was.x()), std::abs(was.z())) > 0.05) continue;
      QVERIFY2(place.y() < plate.low.y(), qPrintable(QString::number((place.y() - plate.low.y()) / kSpacing)));
    }
  }
  QVERIFY(seen(engine, "tool").low.y() < 0.85);
  QVERIFY2(force > 0.1, qPrintable(QString::number(force)));
}

void TestLeading::whatIsStruckStaysWhole_data() {
  QTest::addColumn<QString>("structure");
  QTest::addColumn<double>("speed");
  for (const double speed : {10.0, 100 * kSpacing / kDt})
    for (const char* name : {"bonds", "rigid", "clusters", "rope"})
      QTest::addRow("%s at %g m/s", name, speed) << name << speed;
}

/// A brick, or a rope, is taken along by the plate that strikes it, and flies on ahead of it: no faster, but for what
/// a soft one swings.
void TestLeading::whatIsStruckStaysWhole() {
  QFETCH(QString, structure);
  QFETCH(double, speed);
  Project project = scene(3, 3);
  project.environment.gravity = {0, 0, 0};
  project.bodies.push_back(tool({0.04, 0.3, 0.3}, {-1, 1, 0}));
  const double thick = structure == "rope" ? kSpacing : 0.1;
  project.bodies.push_back(solid("brick", "block", {thick, 0.2, thick}, {-0.8, 1, 0}, 260));
  project.bodies[1].constraints.push_back({structure.toStdString(), {}, {}});
  Engine engine(project, m_plugins);
  double fastest = 0, left = 1;
  for (int frame = 0; frame < 20; ++frame) {
    lead(engine, Vector3(std::clamp(left, 0.0, speed * kDt), 0, 0));
    left -= speed * kDt;
    play(engine, 1);
    const Seen brick = seen(engine, "brick");
    fastest = std::max(fastest, brick.fastest);
    QVERIFY(brick.low.x() > seen(engine, "tool").high.x());
  }
  qInfo("fastest %.2f m/s", fastest);
  QVERIFY(fastest > 0.9 * std::min(speed, 20.0) && fastest < 1.3 * std::min(speed, 20.0));
  QVERIFY(seen(engine, "brick").high.x() < 2.9);
  const Seen brick = seen(engine, "brick");
  QVERIFY((brick.high - brick.low).norm() < 1.5 * Vector3(thick, 0.2, thick).norm());
}

void TestLeading::waterIsNotBlownApart_data() {
  QTest::addColumn<double>("speed");
  for (const double speed : {1.0, 10.0, 100 * kSpacing / kDt}) QTest::addRow("%g m/s", speed) << speed;
}

/// An upright plate through water: nothing is thrown faster than a blow of an incompressible body that goes at the
/// speed of the plate may throw it, twice as fast, and what the plate gives is what is booked.
void TestLeading::waterIsNotBlownApart() {
  QFETCH(double, speed);
  Project project = tub();
  Engine engine(project, m_plugins);
  play(engine, 10);
  const size_t count = engine.particles().size();
  const double step = speed * kDt, allowed = 2 * std::min(speed, 20.0) + 2;
  double fastest = 0, worst = 0, gained = 0, left = 0.36;
  for (int frame = 0; frame < 60; ++frame) {
    if (left > 0) lead(engine, Vector3(std::min(left, step), 0, 0));
    left -= step;
    const StepReport report = engine.step();
    QVERIFY2(report.flags == 0, report.message.c_str());
    const MomentumRecord& m = report.momentum;
    const Vector3 change = vectorOf(m.end) - vectorOf(m.start);
    gained = std::max(gained, change.norm());
    worst = std::max(worst, (change - vectorOf(m.external)).norm());
    fastest = std::max(fastest, seen(engine, "water").fastest);
  }
  qInfo("fastest %.2f m/s, %.2f kg m/s in a frame, open by %.2e", fastest, gained, worst);
  QCOMPARE(engine.particles().size(), count);
  QVERIFY2(fastest < allowed, qPrintable(QString::number(fastest)));
  QVERIFY2(gained > 0.3 && worst < 1e-3 * std::max(1.0, gained), qPrintable(QString::number(worst)));
}

/// A block of ice on the floor under a plate: the floor gives what the plate does, and the tool feels it.
void TestLeading::itPressesAndIsPressed() {
  Project project = scene(0.3, 1);
  project.bodies.push_back(tool({0.16, 0.04, 0.16}, {0, 0.2, 0}));
  project.bodies.push_back(solid("ice", "block", {0.1, 0.1, 0.1}, {0, 0.05, 0}, 260));
  project.bodies[1].constraints.push_back({"rigid", {}, {}});
  Engine engine(project, m_plugins);
  play(engine, 5);
  lead(engine, Vector3(0, -0.084, 0));
  Vector3 most(0, 0, 0);
  for (int frame = 0; frame < 20; ++frame) {
    play(engine, 1);
    const Vector3& force = engine.snapshot()->tools.at(0).force;
    if (force.norm() > most.norm()) most = force;
  }
  QVERIFY2(most.y() > 1 && most.y() > 0.9 * most.norm(), qPrintable(QString::number(most.y())));
  QVERIFY(engine.snapshot()->tools.at(0).touching > 10);
  QVERIFY(seen(engine, "ice").low.y() > 0);
}

/// A tool of 350 K on ice gives heat, which melts it.
void TestLeading::whatItTouchesMeltsAndIsTold() {
  Project project = scene(0.3, 1);
  SceneMaterial iron;
  iron.id = iron.base = "iron";
  project.materials.push_back(iron);
  project.bodies.push_back(tool({0.16, 0.06, 0.16}, {0, 0.2, 0}, 350));
  project.bodies[0].material = "iron";
  project.bodies.push_back(solid("ice", "block", {0.2, 0.1, 0.2}, {0, 0.05, 0}, 272));
  project.bodies[1].constraints.push_back({"bonds", {}, {}});
  project.solver.parameters.values["thermal_time_scale"] = 100.0;
  Engine engine(project, m_plugins);
  play(engine, 5);
  lead(engine, Vector3(0, -0.068, 0));
  double heat = 0, latent = 0, gradient = 0;
  for (int frame = 0; frame < 60; ++frame) {
    play(engine, 1);
    const ToolContact& felt = engine.snapshot()->tools.at(0);
    heat = std::min(heat, felt.heat), latent = std::max(latent, felt.latent);
    gradient = std::min(gradient, felt.gradient);
  }
  qInfo("heat %.1f W, latent %.1f W, gradient %.0f K/m", heat, latent, gradient);
  QVERIFY(heat < -1);
  QVERIFY(latent > 0.05 * -heat && latent < -2 * heat);
  QVERIFY(gradient < -100 && gradient > -1e4);
}

/// Each of two hands feels its own tool, and what that takes up goes on being counted while the other one moves.
void TestLeading::twoHandsFeelTheirOwn() {
  Project project = scene(0.6, 1);
  project.environment.gravity = {0, 0, 0};
  project.bodies.push_back(tool({0.16, 0.06, 0.16}, {-0.3, 0.2, 0}, 350));
  project.bodies.push_back(project.bodies[0]);
  project.bodies[1].id = "other";
  std::get<SolidShape>(project.bodies[1].shape).parameters.values["position_x"] = 0.3;
  project.bodies.push_back(solid("ice", "block", {0.2, 0.1, 0.2}, {-0.3, 0.12, 0}, 260));
  project.bodies.back().parameters.values["held"] = true;
  project.solver.parameters.values["thermal_time_scale"] = 100.0;
  Engine engine(project, m_plugins);
  const auto felt = [&](const std::string& id) {
    const std::vector<ToolContact> tools = engine.snapshot()->tools;
    const auto found = std::find_if(tools.begin(), tools.end(), [&](const ToolContact& one) { return one.body == id; });
    return found == tools.end() ? std::nullopt : std::optional(*found);
  };
  double heat = 0;
  for (int frame = 0; frame < 10; ++frame) {
    lead(engine, RigidMove{Quaternion::Identity(), {0.0005, 0, 0}});
    lead(engine, RigidMove{Quaternion::Identity(), {0, 0.0005, 0}}, "other");
    play(engine, 1);
    QVERIFY(felt("tool") && felt("other"));
    heat = std::min(heat, felt("tool")->heat);
    QCOMPARE(felt("other")->touching, 0u);
  }
  QVERIFY(felt("tool")->touching > 0);
  QVERIFY2(heat < -1, qPrintable(QString::number(heat)));
  QCOMPARE(engine.snapshot()->tools.front().body, std::string("other"));  // led last
}

void TestLeading::oneHash() {
  onehash::verify([this]() -> uint64_t {
    const Project project = tub();
    Engine engine(project, m_plugins);
    for (int frame = 0; frame < 30; ++frame) {
      stir(engine, frame);
      if (engine.step().flags) return 0;
    }
    return engine.stateHash();
  });
}

/// Left half way, in a turn, and so fast that frames have more substeps.
void TestLeading::aStateOnTheWayGoesOn() {
  const Project project = tub();
  Engine engine(project, m_plugins);
  for (int frame = 0; frame < 9; ++frame) {
    stir(engine, frame);
    play(engine, 1);
  }
  QVERIFY(engine.snapshot()->tools.at(0).behind > 0.01);
  StateBuffer buffer;
  StateWriter writer(buffer);
  engine.save(writer);
  writer.finish();
  Engine again(engine.document(), m_plugins, StateReader(buffer.bytes()));
  QCOMPARE(again.stateHash(), engine.stateHash());
  for (int frame = 9; frame < 20; ++frame) {
    for (Engine* one : {&engine, &again}) {
      stir(*one, frame);
      play(*one, 1);
    }
  }
  QCOMPARE(again.stateHash(), engine.stateHash());
}

/// From the states of a record and the steps since, and from its file.
void TestLeading::aRecordedRunIsMadeAgain() {
  const Project project = tub();
  const auto poseAt = [&](uint64_t frame) {
    const double done = static_cast<double>(frame);
    RigidMove move =
        RigidMove::about(pivotOf(project.bodies[0]), Quaternion(Eigen::AngleAxisd(0.1 * done, Vector3(0, 1, 0))));
    move.shift += Vector3(0.015 * done, 0, 0);
    return moved(project.bodies[0], move);
  };
  const auto after = [&](uint64_t frame) -> std::vector<Command> {
    const Body from = poseAt(frame), to = poseAt(frame + 1);
    const RigidMove move = moveBetween(from, to).value_or(RigidMove{});
    const Command command = MoveBody{std::make_shared<const Body>(to), move, frame % 5 != 4};
    return {command};
  };
  RunRecord record(size_t{1} << 30);
  const std::map<uint64_t, uint64_t> hashes = recordedrun::recordInto(record, project, m_plugins, 15, after);
  RunRecord again(size_t{1} << 30);
  recordedrun::throughFile(record, project, m_plugins, again);
  if (QTest::currentTestFailed()) return;
  for (const uint64_t frame : {3, 7, 10, 15}) {
    QCOMPARE(replayed(record.restorePoint(frame).value(), m_plugins)->stateHash(), hashes.at(frame));
    QCOMPARE(replayed(again.restorePoint(frame).value(), m_plugins)->stateHash(), hashes.at(frame));
  }
}

void TestLeading::stepsThatWaitAreJoined() {
  const auto body = std::make_shared<const Body>(tool({0.1, 0.1, 0.1}, {0, 1, 0}));
  const RigidMove move{Quaternion::Identity(), {0.1, 0, 0}};
  CommandQueue queue;
  for (const bool led : {true, true, false, false, true}) queue.push(MoveBody{body, move, led});
  std::vector<std::pair<bool, double>> moves;
  while (const auto entry = queue.pop()) {
    const auto& one = std::get<MoveBody>(std::get<Command>(*entry));
    moves.emplace_back(one.led, one.move.shift.x());
  }
  const std::vector<std::pair<bool, double>> wanted{{true, 0.2}, {false, 0.2}, {true, 0.1}};
  QVERIFY(moves == wanted);
}

QTEST_GUILESS_MAIN(TestLeading)
#include "tst_leading.moc"
