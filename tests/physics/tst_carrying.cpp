// SPDX-License-Identifier: Apache-2.0
// A body is taken to another place while the scene runs: its matter comes along as it is, without a jolt.
#include "core/base/parallel.h"
#include "core/base/statestream.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/scene/pose.h"
#include "core/scene/solidform.h"
#include "core/simulation/engine.h"
#include "core/sketch/redraw.h"
#include "core/solver/solver.h"
#include "tests/shared/enginehands.h"
#include "tests/shared/scenes.h"

#include <QTest>

#include <cmath>
#include <map>

using namespace ps;

namespace {

constexpr double kSpacing = 0.02;
constexpr double kSingle = 1e-6;  // m, rounding of places of about 1 m in single precision, and of their differences

struct Grain {
  Vector3 place, velocity;
  double mass = 0, temperature = 0;
  bool fixed = false;
};
/// Of one body, by the particles' ids.
std::map<uint32_t, Grain> grainsOf(const Engine& engine, const std::string& body) {
  const ParticleStore& store = engine.particles();
  std::map<uint32_t, Grain> grains;
  for (size_t i = 0; i < store.size(); ++i) {
    if (engine.bodyIds()[store.body()[i]] != body) continue;
    grains[store.id()[i]] = {vectorOf(store.position()[i]), vectorOf(store.velocity()[i]), store.mass()[i],
                             store.temperature()[i], store.velocity()[i].w == 0};
  }
  return grains;
}

Vector3 meanVelocity(const std::map<uint32_t, Grain>& grains) {
  Vector3 momentum;
  double mass = 0;
  for (const auto& [id, grain] : grains) momentum += grain.mass * grain.velocity, mass += grain.mass;
  return momentum / mass;
}

/// A ball or a brick of ice in weightless space without walls, on its way and spinning; or a drop of water.
Project inSpace(const std::string& structure) {
  Project project;
  project.materials.push_back(scenes::water());
  project.environment = scenes::tray(2, 4);
  project.environment.walls.clear();
  project.environment.gravity = {0, 0, 0};
  project.environment.boundsMinimum = {-2, -2, -2};
  project.solver.parameters.values["particle_spacing"] = kSpacing;
  project.solver.thermalModel = scenes::kThermalModel;
  Body body;
  body.id = "thing";
  body.material = "water";
  SolidShape shape;
  shape.parameters.values["kind"] = std::string("block");
  const Vector3 size = structure == "rope"    ? Vector3(0.4, 0.02, 0.02)
                       : structure == "cloth" ? Vector3(0.2, 0.02, 0.2)
                                              : Vector3(0.2, 0.1, 0.1);
  const char* names[] = {"size_x", "size_y", "size_z"};
  for (int a = 0; a < 3; ++a) shape.parameters.values[names[a]] = size[a];
  shape.parameters.values["position_x"] = -0.3;
  body.shape = shape;
  body.parameters.values["temperature"] = structure == "water" ? 300.0 : 260.0;
  body.temperatureGradient = {20, 0, 0};
  body.velocity = {0.4, 0.1, 0};
  body.spin = structure == "water" ? Vector3(0, 0, 0) : Vector3(0, 0, 2);
  if (structure != "water") body.constraints.push_back({structure, {}, {}});
  project.bodies.push_back(body);
  return project;
}

Vector3 meanPlace(const std::map<uint32_t, Grain>& grains) {
  Vector3 sum;
  for (const auto& [id, grain] : grains) sum += grain.place;
  return sum / static_cast<double>(grains.size());
}

/// What a move of the body in the document does to its matter.
RigidMove carriedBy(const Body& body, const std::map<uint32_t, Grain>& grains, const RigidMove& move) {
  RigidMove carried = RigidMove::about(meanPlace(grains), move.turn);
  carried.shift += move.of(centroidOf(body)) - centroidOf(body);
  return carried;
}

const RigidMove kMove{Quaternion(Eigen::AngleAxisd(1.1, Vector3(2, -1, 2) / 3)), {0.5, -0.2, 0.3}};

Command carriedFrom(const Project& project, const RigidMove& move, size_t index = 0) {
  return MoveBody{std::make_shared<const Body>(moved(project.bodies[index], move)), move};
}

void play(Engine& engine, int frames) {
  for (int frame = 0; frame < frames; ++frame) {
    const StepReport report = engine.step();
    QVERIFY2(!(report.flags & kTakenBack) && report.faults.empty(), report.message.c_str());
  }
}

}  // namespace

class TestCarrying : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup() { setThreadCount(0); }
  void itStaysWhatItIs_data() { structures(); }
  void itStaysWhatItIs();
  void itGoesOnAsItWould_data() { structures(); }
  void itGoesOnAsItWould();
  void aStateSaysAllOfIt();
  void whatIsTiedToItGoesAlongAndPostsStay();
  void whatIsLedGoesOnFromThere();
  void intoOtherMatterItGoesWithoutHarm();
  void turnedItStandsWhereAResetMakesIt();
  void aPlaceIsAParameterToo();
  void posesAreFoundAgain();
  void aSketchIsTurned();
  void aSketchIsScaled();
  void aBlockOfLayersIsTurned();
  void goneBackItStandsWhereTheDocumentHasIt();

 private:
  static void structures() {
    QTest::addColumn<QString>("structure");
    for (const char* name : {"water", "bonds", "rigid", "clusters", "cloth", "rope"}) QTest::newRow(name) << name;
  }
  PluginRegistry m_plugins;
};

void TestCarrying::itStaysWhatItIs() {
  QFETCH(QString, structure);
  const Project project = inSpace(structure.toStdString());
  Engine engine(project, m_plugins);
  play(engine, 10);
  const auto before = grainsOf(engine, "thing");
  const FrameStats was = engine.stats();
  engine.apply(carriedFrom(project, kMove));
  const auto after = grainsOf(engine, "thing");
  const FrameStats is = engine.stats();
  QCOMPARE(after.size(), before.size());
  QVERIFY(before.size() > 15);
  const Vector3 mean = meanVelocity(before);
  const RigidMove move = carriedBy(project.bodies[0], before, kMove);
  QVERIFY((meanVelocity(after) - mean).norm() < 1e-6);
  for (const auto& [id, grain] : before) {
    const Grain& now = after.at(id);
    QCOMPARE(now.mass, grain.mass);
    QCOMPARE(now.temperature, grain.temperature);
    QVERIFY((now.place - move.of(grain.place)).norm() < kSingle);
    QVERIFY((now.velocity - mean - move.turn * (grain.velocity - mean)).norm() < 1e-5);
  }
  QVERIFY(std::abs(is.kineticEnergy - was.kineticEnergy) < 1e-5 * was.kineticEnergy);
  QCOMPARE(is.thermalEnergy, was.thermalEnergy);
  QCOMPARE(is.heat.net(), was.heat.net());
}

/// In space without a direction it does what one does that was left where it was.
void TestCarrying::itGoesOnAsItWould() {
  QFETCH(QString, structure);
  const Project project = inSpace(structure.toStdString());
  Engine left(project, m_plugins), carried(project, m_plugins);
  play(left, 10);
  play(carried, 10);
  const Vector3 mean = meanVelocity(grainsOf(left, "thing"));
  const RigidMove move = carriedBy(project.bodies[0], grainsOf(left, "thing"), kMove);
  carried.apply(carriedFrom(project, kMove));
  play(left, 1);
  play(carried, 1);
  // No jolt: the very next frame has the same energy, to what rounding of places does to stiff springs.
  const double was = left.stats().kineticEnergy;
  QVERIFY2(std::abs(carried.stats().kineticEnergy - was) < 1e-4 * was,
           qPrintable(QString::number(carried.stats().kineticEnergy / was, 'g', 12)));
  play(left, 19);
  play(carried, 19);
  const auto there = grainsOf(left, "thing"), here = grainsOf(carried, "thing");
  QVERIFY((meanVelocity(here) - meanVelocity(there)).norm() < 1e-4 * mean.norm());
  // The way of the mean does not turn with the body.
  const double seconds = 20.0 / 60;
  double farthest = 0;
  for (const auto& [id, grain] : there) {
    const Vector3 expected = move.of(grain.place - seconds * mean) + seconds * mean;
    farthest = std::max(farthest, (here.at(id).place - expected).norm());
    QVERIFY(std::abs(here.at(id).temperature - grain.temperature) < 1e-3);
  }
  QVERIFY2(farthest < 0.02 * kSpacing, qPrintable(QString::number(farthest / kSpacing)));
}

void TestCarrying::aStateSaysAllOfIt() {
  const Project project = inSpace("rigid");
  std::vector<uint64_t> hashes;
  for (const size_t threads : {1, 2}) {
    setThreadCount(threads);
    Engine engine(project, m_plugins);
    play(engine, 5);
    const Command command = carriedFrom(project, kMove);
    engine.apply(command);
    StateBuffer buffer;
    saveTo(buffer, engine);
    Engine other(engine.document(), m_plugins, StateReader(buffer.bytes()));
    play(engine, 5);
    play(other, 5);
    hashes.push_back(engine.stateHash());
    hashes.push_back(other.stateHash());
    // What is made anew stands where the document has it.
    engine.reset();
    const Vector3 start = pivotOf(*std::get<MoveBody>(command).body);
    Vector3 middle;
    const auto grains = grainsOf(engine, "thing");
    for (const auto& [id, grain] : grains) middle += grain.place / static_cast<double>(grains.size());
    QVERIFY((middle - start).norm() < 0.5 * kSpacing);
  }
  for (const uint64_t hash : hashes) QCOMPARE(hash, hashes.front());
}

/// A rope between two posts: carried, a post pulls it; the rope goes without them.
void TestCarrying::whatIsTiedToItGoesAlongAndPostsStay() {
  Project project = inSpace("rope");
  project.bodies[0].velocity = project.bodies[0].spin = {0, 0, 0};
  project.bodies[0].constraints[0].parameters.values["tied_to_fixed"] = true;
  for (const double x : {-0.53, -0.07}) {
    Body post = scenes::block(x < -0.3 ? "left" : "right", 3, kSpacing, {x, 0, 0}, 300);
    post.parameters.values["fixed"] = true;
    project.bodies.push_back(post);
  }
  Engine engine(project, m_plugins);
  play(engine, 3);
  const auto rope = grainsOf(engine, "thing"), right = grainsOf(engine, "right");
  const RigidMove step{Quaternion::Identity(), {0, 0.1, 0}};
  engine.apply(carriedFrom(project, step, 2));
  for (const auto& [id, grain] : grainsOf(engine, "right")) {
    QVERIFY(grain.fixed && (grain.place - step.of(right.at(id).place)).norm() < kSingle);
  }
  for (const auto& [id, grain] : grainsOf(engine, "thing")) QCOMPARE(grain.place, rope.at(id).place);
  play(engine, 60);
  double highest = -1;
  for (const auto& [id, grain] : grainsOf(engine, "thing")) highest = std::max(highest, grain.place.y());
  QVERIFY2(highest > 0.05, qPrintable(QString::number(highest)));  // its end has followed
  const auto pulled = grainsOf(engine, "thing"), left = grainsOf(engine, "left");
  engine.apply(carriedFrom(project, step));
  for (const auto& [id, grain] : grainsOf(engine, "thing"))
    QVERIFY((grain.place - step.of(pulled.at(id).place)).norm() < kSingle);
  for (const auto& [id, grain] : grainsOf(engine, "left")) QCOMPARE(grain.place, left.at(id).place);
}

/// A wheel that turns about its axis goes on turning where it is put, and a reset has it there.
void TestCarrying::whatIsLedGoesOnFromThere() {
  Project project = inSpace("water");
  Body& wheel = project.bodies[0];
  wheel.parameters.values["fixed"] = true;
  wheel.velocity = {0, 0, 0};
  wheel.spin = {0, 0, 3};
  Engine left(project, m_plugins), carried(project, m_plugins);
  const RigidMove move{Quaternion::Identity(), {0.3, 0.2, 0}};
  play(left, 20);
  play(carried, 10);
  carried.apply(carriedFrom(project, move));
  play(carried, 10);
  const auto there = grainsOf(left, "thing");
  for (const auto& [id, grain] : grainsOf(carried, "thing"))
    QVERIFY((grain.place - move.of(there.at(id).place)).norm() < kSingle);
}

void TestCarrying::intoOtherMatterItGoesWithoutHarm() {
  Project project = inSpace("bonds");
  project.environment = scenes::tray(0.4, 1);
  Body pool = scenes::block("pool", 10, kSpacing, {0.2, 0.1, 0}, 300);
  project.bodies.push_back(pool);
  Engine engine(project, m_plugins);
  play(engine, 5);
  engine.apply(carriedFrom(project, {Quaternion::Identity(), {0.5, 0.1, 0}}));
  play(engine, 30);
  const ParticleStore& store = engine.particles();
  for (size_t i = 0; i < store.size(); ++i) {
    const Vector3 place = vectorOf(store.position()[i]);
    QVERIFY(place.allFinite() && place.cwiseAbs().maxCoeff() < 1.1);
    QVERIFY(vectorOf(store.velocity()[i]).norm() < 20);
  }
}

void TestCarrying::aPlaceIsAParameterToo() {
  const Project project = inSpace("bonds");
  Engine engine(project, m_plugins), other(project, m_plugins);
  play(engine, 4);
  play(other, 4);
  const SetParameter edits[] = {{{Owner::Shape, "thing", "position_y"}, 0.4},
                                {{Owner::Shape, "thing", "rotation_x"}, 30.0}};
  QVERIFY(engine.setParameters(edits));
  Project after = project;
  for (const SetParameter& edit : edits) findSet(after, edit.address)->values[edit.address.key] = edit.value;
  const auto move = moveBetween(project.bodies[0], after.bodies[0]);
  QVERIFY(move && std::abs(move->turn.angularDistance(Quaternion::Identity()) - 0.523598775598) < 1e-9);
  other.apply(MoveBody{std::make_shared<const Body>(after.bodies[0]), *move});
  QCOMPARE(engine.stateHash(), other.stateHash());
  QVERIFY(!engine.setParameter({Owner::Shape, "thing", "size_x"}, 0.3));  // acts at the next reset
}

/// A cone's middle is not that of its matter: turned while it stands, it is where a reset makes it.
void TestCarrying::turnedItStandsWhereAResetMakesIt() {
  Project project = inSpace("bonds");
  Body& body = project.bodies[0];
  body.velocity = body.spin = {0, 0, 0};
  std::get<SolidShape>(body.shape).parameters.values["kind"] = std::string("cone");
  Engine engine(project, m_plugins);
  engine.apply(carriedFrom(project, kMove));
  const auto live = grainsOf(engine, "thing");
  engine.reset();
  const auto made = grainsOf(engine, "thing");
  QCOMPARE(made.size(), live.size());
  for (const auto& [id, grain] : made) QVERIFY((live.at(id).place - grain.place).norm() < 0.2 * kSpacing);
}

/// moved() and moveBetween() are each other's inverse, whatever the pose.
void TestCarrying::posesAreFoundAgain() {
  Body body = inSpace("bonds").bodies[0];
  for (int k = 0; k < 400; ++k) {
    const auto of = [k](int n) { return std::sin(12.9898 * k + 78.233 * n); };
    const Vector3 axis = Vector3(of(1), of(2), of(3)).normalized();
    // Quarter turns as well, where two of the angles are one.
    const double angle = k % 4 == 0 ? 1.5707963267948966 : 3.1 * of(4);
    const Vector3 about = k % 4 == 0 ? Vector3(Vector3::Unit(k / 4 % 3)) : axis;
    const RigidMove move{Quaternion(Eigen::AngleAxisd(angle, about)), {of(5), of(6), of(7)}};
    const Body after = moved(body, move);
    const auto found = moveBetween(body, after);
    QVERIFY(found);
    QVERIFY2(found->turn.angularDistance(move.turn) < 1e-7, qPrintable(QString::number(k)));
    QVERIFY((found->shift - move.shift).norm() < 1e-7);
    body = after;
  }
  QVERIFY(!moveBetween(body, body));
  Body larger = scaled(body, {2, 1, 1});
  QVERIFY(!moveBetween(body, larger));
}

/// A sketch, an L of two materials, is turned about any axis: its matter goes along, a reset makes it there, a file
/// keeps it, and it is turned back.
void TestCarrying::aSketchIsTurned() {
  Project project = inSpace("bonds");
  Body& sketch = project.bodies[0];
  sketch.velocity = sketch.spin = {0, 0, 0};
  VoxelShape shape;
  shape.origin = {0.03, -0.25, 0.01};
  shape.spacing = kSpacing;
  SceneMaterial iron;
  iron.id = iron.base = "iron";
  project.materials.push_back(iron);
  shape.palette = {{"water", 260}, {"iron", 260}};
  for (int y = 0; y < 8; ++y) shape.runs.push_back({-3, y, 0, y < 2 ? 6 : 2, y % 2});
  shape.strokes.emplace_back().brush = "sphere";
  shape.strokes[0].samples = {{0, 0, 0, 1, 0}};
  sketch.shape = shape;
  const RigidMove move{Quaternion(Eigen::AngleAxisd(0.7, Vector3(1, -2, 3).normalized())), {0.1, 0.3, -0.2}};
  const Body before = sketch, after = moved(before, move);
  const auto& turned = std::get<VoxelShape>(after.shape);
  QVERIFY(turned.runs == shape.runs && turned.strokes == shape.strokes);
  const auto found = moveBetween(before, after), back = moveBetween(after, before);
  QVERIFY(found && found->turn.angularDistance(move.turn) < 1e-7 && (found->shift - move.shift).norm() < 1e-7);
  QVERIFY(back && (back->of(move.of({1, 1, 1})) - Vector3(1, 1, 1)).norm() < 1e-7);
  QVERIFY((pivotOf(after) - move.of(pivotOf(before))).norm() < 1e-7);
  QVERIFY((centroidOf(after) - move.of(centroidOf(before))).norm() < 1e-7);
  QVERIFY(!moveBetween(after, after));
  const VoxelShape again = std::get<VoxelShape>(moved(after, *back).shape);
  QVERIFY(again.rotation == Vector3::Zero() && again.shift == Vector3::Zero());
  // From where it is turned to it also goes by parts of a cell, and on turning.
  const Body further = moved(after, {Quaternion::Identity(), {0.003, 0, 0}});
  QVERIFY((moveBetween(after, further)->shift - Vector3(0.003, 0, 0)).norm() < 1e-12);
  QVERIFY(!moveBetween(after, further)->turns());

  Engine engine(project, m_plugins);
  engine.apply(MoveBody{std::make_shared<const Body>(after), *found});
  const auto carried = grainsOf(engine, "thing");
  engine.reset();
  const auto made = grainsOf(engine, "thing");
  QCOMPARE(made.size(), carried.size());
  QCOMPARE(made.size(), size_t{24});
  const BodyBounds bounds = boundsOf(after);
  for (const auto& [id, grain] : made) {
    QVERIFY((carried.at(id).place - grain.place).norm() < kSingle);  // however heavy its two parts are
    const Vector3 room = Vector3::Constant(kSingle);
    QVERIFY(((grain.place - bounds.minimum + room).array() > 0).all());
    QVERIFY(((bounds.maximum - grain.place + room).array() > 0).all());
  }
  Project saved = project;
  saved.bodies[0] = after;
  const Project read = readProject(writeProject(saved), "", m_plugins).project;
  QVERIFY(std::get<VoxelShape>(read.bodies[0].shape) == turned);
  QCOMPARE(Engine(read, m_plugins).stateHash(), engine.stateHash());
}

/// A sketch becomes larger and smaller with its strokes, wherever it stands: its matter fills it at the next reset, and
/// drawn again from the strokes it is as large.
void TestCarrying::aSketchIsScaled() {
  Project project = inSpace("bonds");
  Body& sketch = project.bodies[0];
  sketch.velocity = sketch.spin = {0, 0, 0};
  const api::BrushPlugin* ball = m_plugins.brush("sphere");
  QVERIFY(ball);
  VoxelShape shape;
  shape.spacing = kSpacing;
  shape.origin = Vector3::Constant(kSpacing / 2);
  shape.palette = {{"water", 260}};
  shape.strokes.emplace_back().brush = "sphere";
  shape.strokes[0].radius = 0.1;
  shape.strokes[0].samples = {{0.05, 0.1, -0.03, 1, 0}, {0.15, 0.1, -0.03, 1, 0.1}};
  const auto drawn = [&](const VoxelShape& from) {
    const auto free = [](const SketchGrid&, const CellSet& cells) { return cells; };
    return redrawn(from, kSpacing, free, [&](const std::string&) { return ball; });
  };
  sketch.shape = shape = drawn(shape);
  const Body first = sketch;
  const Vector3 shift(0.013, 0.004, -0.02);
  for (const RigidMove& pose :
       {RigidMove{}, RigidMove::about({0.1, 0, 0.2}, Quaternion(Eigen::AngleAxisd(0.7, Vector3(0, 0, 1))))}) {
    Body before = first;
    if (!pose.isNothing()) before = moved(before, pose);
    for (const double factor : {2.0, 0.6}) {
      const Body after = scaled(before, {1, factor, 1}, shift);
      const auto& larger = std::get<VoxelShape>(after.shape);
      QCOMPARE(larger.spacing, factor * kSpacing);
      QVERIFY(larger.runs == shape.runs);
      QVERIFY((pivotOf(after) - pivotOf(before) - shift).norm() < 1e-12);
      const auto carried = moveBetween(sizedAs(before, after), after);
      QVERIFY(carried && !carried->turns() && (carried->shift - shift).norm() < 1e-12);
      // A sphere of n cells across has a surface whose cells a resampled or a redrawn one may gain or lose.
      const double count = particleCount(after, kSpacing), room = 0.06;
      project.bodies[0] = after;
      const Engine engine(project, m_plugins);
      QVERIFY(std::abs(static_cast<double>(engine.particles().size()) / count - 1) < room);
      QVERIFY(std::abs(particleCount(before, kSpacing) * factor * factor * factor / count - 1) < 1e-12);
      Body again = after;
      again.shape = drawn(larger);
      QVERIFY(std::abs(particleCount(again, kSpacing) / count - 1) < room);
      QVERIFY((centroidOf(again) - centroidOf(after)).norm() < 0.5 * kSpacing);
      QVERIFY(writeProject(readProject(writeProject(project), "", m_plugins).project) == writeProject(project));
    }
  }
  const Body least = scaled(first, {1e-6, 1e-6, 1e-6}), most = scaled(first, {1e9, 1e9, 1e9});
  QCOMPARE(std::get<VoxelShape>(least.shape).spacing, 0.0005);  // what files may say
  QCOMPARE(std::get<VoxelShape>(most.shape).spacing, 10.0);
}

/// A block of whole layers becomes a solid one as it is turned: its matter goes along, and weighs the same from the
/// next reset on. Back, it is what it was.
void TestCarrying::aBlockOfLayersIsTurned() {
  Project project = inSpace("bonds");
  Body box = scenes::block("thing", 6, kSpacing, {0.1, 0.2, 0}, 260);
  box.material = project.bodies[0].material;
  project.bodies[0] = box;
  const RigidMove move = RigidMove::about({0.3, 0, 0}, Quaternion(Eigen::AngleAxisd(0.5, Vector3(0, 0, 1))));
  const Body turnedBox = moved(box, move);
  const SolidForm form(std::get<SolidShape>(turnedBox.shape));
  const auto& layers = std::get<BoxShape>(box.shape);
  QVERIFY(form.kind() == SolidForm::Kind::Block && form.size() == layers.size);
  QVERIFY((form.middle() - move.of(layers.center)).norm() < 1e-12);
  const auto found = moveBetween(box, turnedBox), back = moveBetween(turnedBox, box);
  QVERIFY(found && found->turn.angularDistance(move.turn) < 1e-7 && (found->shift - move.shift).norm() < 1e-7);
  QVERIFY(back && (back->of(move.of({0.2, 0.1, 0})) - Vector3(0.2, 0.1, 0)).norm() < 1e-7);
  Body larger = box;
  std::get<BoxShape>(larger.shape).size *= 2;
  QVERIFY(!moveBetween(larger, turnedBox));
  Engine engine(project, m_plugins);
  play(engine, 3);
  const auto before = grainsOf(engine, "thing");
  double mass = 0;
  for (const auto& [id, grain] : before) mass += grain.mass;
  engine.apply(MoveBody{std::make_shared<const Body>(turnedBox), move});
  const auto live = grainsOf(engine, "thing");
  QCOMPARE(live.size(), before.size());
  for (const auto& [id, grain] : live) QVERIFY((grain.place - move.of(before.at(id).place)).norm() < 1e-3 * kSpacing);
  engine.reset();
  double after = 0;
  for (const auto& [id, grain] : grainsOf(engine, "thing")) after += grain.mass;
  QVERIFY(std::abs(after - mass) < 1e-5 * mass);
}

/// A run that goes back to before a body was moved has its matter moved as well, for nothing goes back in the document:
/// from there an undo brings both to where they were.
void TestCarrying::goneBackItStandsWhereTheDocumentHasIt() {
  const Project project = inSpace("bonds");
  EngineThread engine(m_plugins, nullptr);
  engine.open(project, false);
  const auto centre = [&] {
    return tests::onEngine<Vector3>(engine, [](Engine& e) { return meanPlace(grainsOf(e, "thing")); });
  };
  const auto hash = [&] { return tests::onEngine<uint64_t>(engine, [](Engine& e) { return e.stateHash(); }); };
  std::vector<Vector3> at{centre()};
  for (int frame = 1; frame <= 4; ++frame) {
    engine.stepOnce();
    at.push_back(centre());
  }
  engine.apply(carriedFrom(project, kMove));
  const Vector3 way = kMove.of(centroidOf(project.bodies[0])) - centroidOf(project.bodies[0]);
  QVERIFY((centre() - at[4] - way).norm() < kSingle);
  engine.stepOnce();
  const uint64_t after = hash();
  engine.stepOnce();
  engine.continueFrom(5, false);  // moved by then: the same bits again
  QCOMPARE(hash(), after);
  engine.continueFrom(2, false);
  QVERIFY((centre() - at[2] - way).norm() < kSingle);
  const RigidMove back = *moveBetween(moved(project.bodies[0], kMove), project.bodies[0]);
  engine.apply(MoveBody{std::make_shared<const Body>(project.bodies[0]), back});
  QVERIFY((centre() - at[2]).norm() < kSingle);
}

QTEST_GUILESS_MAIN(TestCarrying)
#include "tst_carrying.moc"
